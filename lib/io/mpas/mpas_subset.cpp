// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_subset.h"
#include "io/mpas/mpas_variables.h"

#include "io/bytes/big_endian.h"
#include "io/bytes/file.h"
#include "io/mpas/mpas.h"
#include "io/mpas/vertex_order.h"

#include <calotte/error.h>
#include <calotte/version.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace calotte::io_detail {
namespace {

// ---- Ids

/// Calls work(values, count) on values in the byte order of the machine, and stores the result in
/// that of the file.
template <class T, class Work> void on_values(char* bytes, std::int64_t count, const Work& work) {
  Array<T> values(count);
  swap_big_endian(bytes, count, sizeof(T), reinterpret_cast<char*>(values.begin()));
  work(values.begin(), count);
  to_big_endian(values.begin(), count, bytes);
}

/// Whether an id is missing: 0, or as models write it, one more than the last.
template <class T> bool is_missing(T id, std::int64_t count) { return id == 0 || id == count + 1; }

template <class T>
ChangeRows renumbering(const NetcdfReader& source, int variable, const Kept& of) {
  const std::int64_t width = row_width(source, variable), count = of.number.size();
  const std::string& name = source.variables()[static_cast<std::size_t>(variable)].name;
  return [&source, &of, &name, width, count](std::int64_t begin, std::int64_t end, char* bytes) {
    on_values<T>(bytes, (end - begin) * width, [&](T* ids, std::int64_t n) {
      for (std::int64_t k = 0; k < n; ++k) {
        if (ids[k] < 0 || ids[k] > count + 1)
          source.fail("{} has the id {} in row {} (both 1-based), but there are {}; make the file "
                      "again",
                      name, ids[k], begin + k / width + 1, count);
        ids[k] = is_missing(ids[k], count) ? 0 : of.number[ids[k] - 1];
      }
    });
  };
}

/// Replaces ids by new ones.
/// \throws Error parse, for a variable that is not of integers.
ChangeRows make_renumbering(const NetcdfReader& source, int variable, const Kept& of) {
  const NetcdfVariable& ids = source.variables()[static_cast<std::size_t>(variable)];
  if (ids.type == NetcdfType::int32)
    return renumbering<std::int32_t>(source, variable, of);
  if (ids.type == NetcdfType::int64)
    return renumbering<std::int64_t>(source, variable, of);
  source.fail("{} does not hold integers of 4 or 8 bytes; make the file again", ids.name);
}

/// \throws Error parse.
void require_integers(const NetcdfReader& source, int variable) {
  const std::string& name = source.variables()[static_cast<std::size_t>(variable)].name;
  if (!source.is_integer(name))
    source.fail("{} does not hold integers; make the file again", name);
}

/// Replaces numbers by new ones from 1 on, in integers of any size.
ChangeRows make_numbers(const NetcdfReader& source, int variable) {
  require_integers(source, variable);
  const std::int64_t size = size_of(*source.variables()[static_cast<std::size_t>(variable)].type);
  return [size](std::int64_t begin, std::int64_t end, char* bytes) {
    for (std::int64_t row = begin; row < end; ++row, bytes += size)
      for (std::int64_t k = 0; k < size; ++k)
        bytes[k] = static_cast<char>((row + 1) >> 8 * (size - 1 - k));
  };
}

/// Sets flags, in integers of any size, to 1 at vertices that lack a cell.
ChangeRows make_boundary_flags(const NetcdfReader& source, int variable, const MpasPart& part) {
  require_integers(source, variable);
  const std::int64_t size = size_of(*source.variables()[static_cast<std::size_t>(variable)].type);
  return [size, &part](std::int64_t begin, std::int64_t end, char* bytes) {
    for (std::int64_t v = begin; v < end; ++v, bytes += size) {
      std::memset(bytes, 0, static_cast<std::size_t>(size));
      bytes[size - 1] = part.cells_at_vertex[static_cast<std::size_t>(v)] < 3 ? 1 : 0;
    }
  };
}

/// Sets weights of removed edges to 0. Only edges with one kept cell have such weights.
ChangeRows make_weight_change(const NetcdfReader& source, int variable, const MpasPart& part) {
  const int ids = source.find(mpas::edges_on_edge);
  const std::int64_t width = row_width(source, variable),
                     size = size_of(*source.variables()[static_cast<std::size_t>(variable)].type),
                     id_size = size_of(*source.variables()[static_cast<std::size_t>(ids)].type);
  const ChangeRows renumber = make_renumbering(source, ids, part.edges);
  return [=, &source, &part](std::int64_t begin, std::int64_t end, char* bytes) {
    std::string row(static_cast<std::size_t>(row_width(source, ids) * id_size), '\0');
    const std::string zero(static_cast<std::size_t>(id_size), '\0');
    for (std::int64_t e = begin; e < end; ++e, bytes += width * size) {
      if (part.cells_at_edge[static_cast<std::size_t>(e)] == 2)
        continue;
      read_kept_rows(source, ids, 0, part.edges, e, e + 1, row.data());
      renumber(e, e + 1, row.data());
      for (std::int64_t k = 0; k < width; ++k)
        if (row.compare(static_cast<std::size_t>(k * id_size), zero.size(), zero) == 0)
          std::memset(bytes + k * size, 0, static_cast<std::size_t>(size));
    }
  };
}

void add_change(const NetcdfReader& source, const std::string& variable, NetcdfSubset& subset,
                const std::function<ChangeRows(int)>& make) {
  if (const int v = source.find(variable); v >= 0)
    subset.changes[variable].push_back(make(v));
}

template <class T> ChangeRows scaling(std::int64_t width, double factor, double divisor) {
  return [=](std::int64_t begin, std::int64_t end, char* bytes) {
    on_values<T>(bytes, (end - begin) * width, [=](T* values, std::int64_t n) {
      for (std::int64_t k = 0; k < n; ++k)
        values[k] = static_cast<T>(values[k] * factor / divisor);
    });
  };
}

void add_scaling(const NetcdfReader& source, const std::string& variable, double factor,
                 double divisor, NetcdfSubset& subset) {
  add_change(source, variable, subset, [&](int v) -> ChangeRows {
    const NetcdfVariable& of = source.variables()[static_cast<std::size_t>(v)];
    const std::int64_t width = row_values(source, subset, v);
    if (of.type == NetcdfType::float32)
      return scaling<float>(width, factor, divisor);
    if (of.type == NetcdfType::float64)
      return scaling<double>(width, factor, divisor);
    source.fail("{} does not hold floating-point numbers; make the file again", variable);
  });
}

/// The kept items that the ids of a variable refer to; null if it has no ids.
const Kept* kept_items(MpasNumbers numbers, const MpasPart& part) {
  return numbers == MpasNumbers::cells      ? &part.cells
         : numbers == MpasNumbers::edges    ? &part.edges
         : numbers == MpasNumbers::vertices ? &part.vertices
                                            : nullptr;
}

} // namespace

std::int64_t row_width(const NetcdfReader& source, int variable) {
  return source.product(variable, 1,
                        source.variables()[static_cast<std::size_t>(variable)].dimensions.size());
}

NetcdfSubset make_subset(const MpasSource& source, const MpasPart& part) {
  const NetcdfReader& file = source.netcdf();
  NetcdfSubset subset;
  subset.kept = {{name_of(MpasDimension::cells), &part.cells},
                 {name_of(MpasDimension::edges), &part.edges},
                 {name_of(MpasDimension::vertices), &part.vertices}};
  for (const MpasVariable& variable : mpas_variables()) {
    if (const Kept* const ids = kept_items(variable.numbers, part))
      add_change(file, variable.name, subset,
                 [&](int v) { return make_renumbering(file, v, *ids); });
    else if (variable.numbers == MpasNumbers::own)
      add_change(file, variable.name, subset, [&](int v) { return make_numbers(file, v); });
    else if (variable.numbers == MpasNumbers::lists_of_ids)
      subset.left_out.push_back(variable.name);
  }
  add_change(file, mpas::boundary_vertex, subset,
             [&](int v) { return make_boundary_flags(file, v, part); });
  if (file.find(mpas::edges_on_edge) >= 0)
    add_change(file, mpas::weights_on_edge, subset,
               [&](int v) { return make_weight_change(file, v, part); });
  return subset;
}

void set_sphere(const MpasSource& source, double radius, NetcdfSubset& subset) {
  subset.attributes["on_a_sphere"] = {"on_a_sphere", std::string("YES")};
  subset.attributes["sphere_radius"] = {"sphere_radius", radius};
  if (radius != 1) // sphere_radius is the planet's
    subset.attributes_left_out.emplace_back(planet_attribute);
  else if (source.radius() != 1)
    subset.attributes[planet_attribute] = {planet_attribute, source.radius()};
}

void add_radius(const MpasSource& source, double radius, NetcdfSubset& subset) {
  const double from = source.radius();
  if (from == radius)
    return;
  for (const MpasVariable& variable : mpas_variables())
    if (const int power = radius_power(variable); power != 0)
      add_scaling(source.netcdf(), variable.name,
                  std::pow(power > 0 ? radius : from, std::abs(power)),
                  std::pow(power > 0 ? from : radius, std::abs(power)), subset);
}

void add_vertex_order(const MpasSource& source, const MpasPart& part, VertexOrder order,
                      NetcdfSubset& subset) {
  if (order == source.vertex_order())
    return;
  const NetcdfReader& file = source.netcdf();
  add_change(file, mpas::vertices_on_cell, subset, [&](int v) -> ChangeRows {
    const std::int64_t size = size_of(*file.variables()[static_cast<std::size_t>(v)].type),
                       width = row_values(file, subset, v) * size;
    return [=, &source, &part](std::int64_t begin, std::int64_t end, char* bytes) {
      for (std::int64_t i = begin; i < end; ++i, bytes += width) {
        const std::int64_t used = source.edge_count(part.cells.old[i]) * size;
        char* const middle =
            order == VertexOrder::before_edges ? bytes + used - size : bytes + size;
        if (used > 0)
          std::rotate(bytes, middle, bytes + used);
      }
    };
  });
  subset.long_names[mpas::edges_on_cell] = mpas_variable(mpas::edges_on_cell).long_name;
  subset.long_names[mpas::vertices_on_cell] = described(order);
}

void add_division(const MpasSource& source, const std::string& variable, double divisor,
                  NetcdfSubset& subset) {
  if (divisor != 1)
    add_scaling(source.netcdf(), variable, 1, divisor, subset);
}

void add_history(const MpasSource& source, const MpasPart& part, const std::string& history,
                 NetcdfSubset& subset) {
  const NetcdfReader& file = source.netcdf();
  const auto set = [&](const std::string& name, const std::string& value) {
    subset.attributes[name] = {name, value};
  };
  const auto before = [&](const std::string& name, const std::string& value) {
    const std::string old = file.text("", name);
    return value.empty() || old.empty() ? value + old : value + "\n" + old;
  };
  if (const std::string all = before("history", history); !all.empty())
    set("history", all);
  const std::string parent = file.text("", "file_id");
  set("file_id", fingerprint(part.cells.old, parent));
  set("parent_id", before("parent_id", parent));
  set("source", "calotte " CALOTTE_VERSION);
}

std::vector<std::string> write_part(const MpasSource& source, const MpasPart& part,
                                    const NetcdfSubset& subset, const std::string& path,
                                    const ProgressCallback& progress,
                                    const std::function<void()>& commit_others) {
  OutputFile graph(graph_path(path));
  NetcdfWriter file(path, progress);
  const std::int64_t inner = (part.cells_on_cell.items.array() >= 0).count() / 2;
  put_graph([&](std::string_view text) { graph.append(text); }, part.cells_on_cell, inner);
  std::vector<std::string> refused = put_subset(source.netcdf(), subset, file);
  file.finish();
  graph.finish();
  if (commit_others)
    commit_others();
  graph.commit();
  file.commit();
  for (const std::string& name : subset.left_out)
    if (mpas_names().lists.contains(name) && source.netcdf().find(name) >= 0)
      refused.push_back(name);
  return refused;
}

} // namespace calotte::io_detail
