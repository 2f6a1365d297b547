// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/netcdf_fields.h"

#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/cells/field_index.h"
#include "io/netcdf/cf_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace calotte::io_detail {
namespace {

/// All dimensions of the variables that describe the mesh.
std::set<std::string> mesh_dimensions(const NetcdfReader& file, const NetcdfMeshNames& names) {
  std::set<std::string> dimensions{names.cells, names.edges, names.vertices};
  for (const std::string& name : names.variables)
    if (file.has_variable(name))
      for (std::string& dimension : file.dimensions_of(name))
        dimensions.insert(std::move(dimension));
  return dimensions;
}

std::optional<FieldLocation> find_location(const NetcdfMeshNames& names,
                                           const std::string& dimension) {
  if (dimension == names.cells)
    return FieldLocation::cells;
  if (!names.edges.empty() && dimension == names.edges)
    return FieldLocation::edges;
  if (!names.vertices.empty() && dimension == names.vertices)
    return FieldLocation::vertices;
  return std::nullopt;
}

/// A field without its values; none for a variable that is not a field.
std::optional<MeshField> make_field(const NetcdfReader& file, const NetcdfMeshNames& names,
                                    const std::set<std::string>& of_mesh, const std::string& name) {
  if (!file.is_numeric(name) || names.lists.contains(name))
    return std::nullopt;
  MeshField field{.name = name};
  bool located = false;
  for (const std::string& dimension : file.dimensions_of(name)) {
    const std::optional<FieldLocation> location = find_location(names, dimension);
    const std::int64_t size = file.dimension(dimension);
    if (location && !located) {
      field.location = *location;
      field.leading = static_cast<int>(field.dimensions.size());
      located = true;
    } else if (of_mesh.contains(dimension) || size < 1) {
      return std::nullopt;
    } else {
      field.dimensions.push_back({dimension, size});
    }
  }
  return located ? std::optional(std::move(field)) : std::nullopt;
}

/// The offsets of values that have index 0 in all other dimensions, by their index over some
/// dimensions, the slowest first.
std::vector<std::int64_t> make_offsets(const std::vector<std::int64_t>& shape,
                                       const std::vector<std::size_t>& dimensions) {
  std::vector<std::int64_t> offsets{0};
  for (const std::size_t d : dimensions) {
    const std::int64_t stride = std::accumulate(shape.begin() + static_cast<std::ptrdiff_t>(d) + 1,
                                                shape.end(), std::int64_t{1}, std::multiplies<>());
    std::vector<std::int64_t> finer;
    for (const std::int64_t offset : offsets)
      for (std::int64_t k = 0; k < shape[d]; ++k)
        finer.push_back(offset + k * stride);
    offsets = std::move(finer);
  }
  return offsets;
}

/// Reorders values of a file: all values of one cell, edge or vertex, then those of the next.
/// \param of_location as in read_values().
DoubleVector grouped_by_item(const std::vector<double>& values,
                             const std::vector<std::int64_t>& shape,
                             const std::vector<std::size_t>& of_location) {
  std::vector<std::size_t> others;
  for (std::size_t d = 0; d < shape.size(); ++d)
    if (std::find(of_location.begin(), of_location.end(), d) == of_location.end())
      others.push_back(d);
  const std::vector<std::int64_t> at = make_offsets(shape, of_location),
                                  of = make_offsets(shape, others);
  DoubleVector out(std::ssize(values));
  double* next = out.data();
  for (const std::int64_t item : at)
    for (const std::int64_t other : of)
      *next++ = values[static_cast<std::size_t>(item + other)];
  return out;
}

/// The text attributes of a field that say what its numbers are. Attributes that say where the
/// numbers are or how they are stored, and those with a member of their own, are left out.
std::vector<std::array<std::string, 2>> read_own_attributes(const NetcdfReader& file,
                                                            const std::string& name) {
  static const std::set<std::string> others{
      "long_name",     "units",     "coordinates",   "grid_mapping",        "bounds",
      "mesh",          "location",  "cell_measures", "ancillary_variables", "grid_type",
      "CDI_grid_type", "_Unsigned", "flag_meanings", "formula_terms",       "missing_value",
      "_FillValue"};
  std::vector<std::array<std::string, 2>> attributes;
  for (const NetcdfAttribute& attribute :
       file.variables()[static_cast<std::size_t>(file.find(name))].attributes)
    if (const auto* const text = std::get_if<std::string>(&attribute.value);
        text && !others.contains(attribute.name))
      attributes.push_back({attribute.name, *text});
  return attributes;
}

/// Whether all values are within the range of NetCDF's int, without its default _FillValue.
bool fit_int(const DoubleVector& values) {
  using Limits = std::numeric_limits<std::int32_t>;
  return std::all_of(values.begin(), values.end(), [](double value) {
    return std::isnan(value) || (value >= Limits::min() + 2.0 && value <= Limits::max());
  });
}

/// Reads the values of a field, see cf_values(), and its attributes. The field has a value for each
/// index of its other dimensions, in the order of the file, at each cell, edge or vertex.
/// \param of_location indices of the dimensions of its location among those of the variable, the
///        slowest first.
/// \param indices by dimension of the field; its values are those there, and it loses these
///        dimensions.
/// \param rows see FieldsOn.
/// \pre name, location, dimensions and `leading` are set.
void read_values(const NetcdfReader& file, const std::vector<std::size_t>& of_location,
                 MeshField& field, std::vector<std::optional<std::int64_t>> indices = {},
                 const decltype(FieldsOn::rows)& rows = {}) {
  std::vector<std::int64_t> count = file.shape_of(field.name), start(count.size(), 0);
  field.long_name = file.text(field.name, "long_name");
  field.units = file.text(field.name, "units");
  const std::size_t before = std::min(*std::ranges::min_element(of_location), indices.size());
  for (std::size_t d = 0; d < before; ++d)
    if (indices[d]) {
      start[d] = *indices[d];
      count[d] = field.dimensions[d].size = 1;
      indices[d] = 0;
    }
  if (rows)
    std::tie(start[of_location[0]], count[of_location[0]]) = *rows;
  field.values = grouped_by_item(cf_part(file, field.name, start, count), count, of_location);
  field = field_at_indices(std::move(field), indices);
  field.integer =
      file.is_integer(field.name) && !is_packed(file, field.name) && fit_int(field.values);
  field.single = file.is_float(field.name) && !is_packed(file, field.name);
  field.attributes = read_own_attributes(file, field.name);
  for (FieldDimension& dimension : field.dimensions)
    dimension.unlimited = file.is_unlimited(dimension.name);
  field.directed =
      field.location == FieldLocation::edges &&
      is_along_edges(field.name, field.long_name, file.text(field.name, "standard_name"));
}

/// The indices of dimensions among those of a variable; none unless it has each once.
std::optional<std::vector<std::size_t>> find_dimensions(const std::vector<std::string>& all,
                                                        const std::vector<std::string>& wanted) {
  std::vector<std::size_t> of_location;
  for (const std::string& dimension : wanted) {
    if (std::ranges::count(all, dimension) != 1 || std::ranges::count(wanted, dimension) != 1)
      return std::nullopt;
    of_location.push_back(
        static_cast<std::size_t>(std::find(all.begin(), all.end(), dimension) - all.begin()));
  }
  return of_location;
}

/// A field on some dimensions, without its values; none if another dimension has the size 0.
std::optional<MeshField> make_field_on(const NetcdfReader& file, const std::string& name,
                                       const std::vector<std::size_t>& of_location) {
  MeshField field{.name = name};
  const std::vector<std::string> all = file.dimensions_of(name);
  for (std::size_t d = 0; d < all.size(); ++d)
    if (std::find(of_location.begin(), of_location.end(), d) == of_location.end()) {
      field.dimensions.push_back({all[d], file.dimension(all[d])});
      if (field.dimensions.back().size < 1)
        return std::nullopt;
    }
  bool together = true;
  for (std::size_t k = 1; k < of_location.size(); ++k)
    together = together && of_location[k] == of_location[k - 1] + 1;
  field.leading = static_cast<int>(together ? of_location.front() : field.dimensions.size());
  return field;
}

/// The numbers for each cell that are left at chosen indices.
std::int64_t count_left(const MeshField& field,
                        const std::vector<std::optional<std::int64_t>>& indices) {
  std::int64_t left = 1;
  for (std::size_t d = 0; d < indices.size(); ++d)
    left *= indices[d] ? 1 : field.dimensions[d].size;
  return left;
}

/// Adds dimensions whose names are new.
void add_new(const std::vector<FieldDimension>& some, std::vector<FieldDimension>& all) {
  for (const FieldDimension& dimension : some)
    if (std::ranges::find(all, dimension.name, &FieldDimension::name) == all.end())
      all.push_back(dimension);
}

} // namespace

bool is_along_edges(const std::string& name, const std::string& long_name,
                    const std::string& standard_name) {
  constexpr std::array<std::string_view, 3> velocities{"u", "v", "ru"}; // of MPAS-Atmosphere
  if (std::find(velocities.begin(), velocities.end(), name) != velocities.end())
    return true;
  std::string words = name + " " + long_name + " " + standard_name;
  std::transform(words.begin(), words.end(), words.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return words.find("normal") != std::string::npos || words.find("tangent") != std::string::npos;
}

void read_fields_on(const NetcdfReader& file, const FieldsOn& on, std::vector<MeshField>& fields,
                    std::vector<std::string>& ignored, std::vector<MeshField>* not_scalars) {
  if (on.choice == FieldChoice::none)
    return;
  std::vector<FieldDimension> all; // of all fields
  std::vector<FieldIndex> unused = on.choices;
  for (const std::string& name : file.variable_names()) {
    if (on.no_fields.contains(name))
      continue;
    const auto of_location = file.is_numeric(name)
                                 ? find_dimensions(file.dimensions_of(name), on.dimensions)
                                 : std::nullopt;
    std::optional<MeshField> field =
        of_location ? make_field_on(file, name, *of_location) : std::nullopt;
    const auto indices = field ? find_indices(field->dimensions, on.choices)
                               : std::vector<std::optional<std::int64_t>>();
    if (field) {
      add_new(field->dimensions, all);
      std::erase_if(unused,
                    [&](const FieldIndex& index) { return belongs(index, field->dimensions); });
    }
    if (field && on.only && std::ranges::find(*on.only, name) == on.only->end())
      continue;
    const bool left_out =
        field && on.choice == FieldChoice::scalars && count_left(*field, indices) > 1;
    if (left_out && not_scalars != nullptr) {
      not_scalars->push_back(*std::move(field));
      continue;
    }
    if (!field || left_out) {
      ignored.push_back(name);
      continue;
    }
    read_values(file, *of_location, *field, indices, on.rows);
    fields.push_back(*std::move(field));
  }
  if (!unused.empty())
    refuse_path(file.path(), "no field has a dimension {}; {}", unused.front().dimension,
                all.empty() ? "leave it out" : "there are " + in_words(all));
}

MeshField read_field_at(const NetcdfReader& file, const std::string& name, std::size_t of_cells,
                        const std::vector<FieldIndex>& choices) {
  std::optional<MeshField> field = make_field_on(file, name, {of_cells});
  if (!field)
    file.fail("{} has a dimension of the size 0; give a file with records", name);
  const std::vector<std::int64_t> indices =
      named(file.path(), [&] { return find_all_indices(name, field->dimensions, choices); });
  read_values(file, {of_cells}, *field, {indices.begin(), indices.end()});
  return *std::move(field);
}

void read_fields(const NetcdfReader& file, const NetcdfMeshNames& names, FieldChoice choice,
                 RawMesh& raw) {
  if (choice == FieldChoice::none)
    return;
  const std::set<std::string> of_mesh = mesh_dimensions(file, names);
  for (const std::string& name : file.variable_names()) {
    if (names.variables.contains(name))
      continue;
    std::optional<MeshField> field = make_field(file, names, of_mesh, name);
    if (!field || (choice == FieldChoice::scalars && field->count() > 1)) {
      raw.ignored.push_back(name);
      continue;
    }
    read_values(file, {static_cast<std::size_t>(field->leading)}, *field);
    raw.fields.push_back(*std::move(field));
  }
}

} // namespace calotte::io_detail
