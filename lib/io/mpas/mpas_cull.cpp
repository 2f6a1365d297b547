// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_cull.h"
#include "io/mpas/mpas_subset.h"

#include "base/parallel.h"
#include "io/bytes/big_endian.h"
#include "io/mpas/mpas_variables.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <string>

namespace calotte::io_detail {
namespace {

std::int64_t value_bytes(const NetcdfReader& file, int variable) {
  return size_of(*file.variables()[static_cast<std::size_t>(variable)].type);
}

/// Reads rows of a variable of the source, one at a time, as new 1-based ids.
class IdRows {
public:
  IdRows(const MpasSource& source, const NetcdfSubset& subset, const std::string& variable,
         const Kept& kept)
      : file_(source.netcdf()), kept_(kept), variable_(file_.find(variable)),
        renumber_(subset.changes.at(variable).front()), width_(row_width(file_, variable_)),
        size_(value_bytes(file_, variable_)) {}

  std::int64_t width() const { return width_; }
  /// \param ids receives the row.
  void read(std::int64_t row, std::vector<std::int64_t>& ids) const {
    std::string bytes(static_cast<std::size_t>(width_ * size_), '\0');
    read_kept_rows(file_, variable_, 0, kept_, row, row + 1, bytes.data());
    renumber_(row, row + 1, bytes.data());
    ids.assign(static_cast<std::size_t>(width_), 0);
    for (std::size_t k = 0; k < ids.size(); ++k)
      for (std::size_t b = 0; b < static_cast<std::size_t>(size_); ++b)
        ids[k] = ids[k] << 8 |
                 static_cast<unsigned char>(bytes[k * static_cast<std::size_t>(size_) + b]);
  }

private:
  const NetcdfReader& file_;
  const Kept& kept_;
  int variable_;
  ChangeRows renumber_;
  std::int64_t width_, size_;
};

template <class T> T value_at(const char* bytes) {
  T value;
  swap_big_endian(bytes, 1, sizeof(T), reinterpret_cast<char*>(&value));
  return value;
}

/// Replaces a value of floats or doubles by change(value).
template <class Change> void change_value(char* bytes, std::int64_t size, const Change& change) {
  if (size == 4) {
    const auto value = static_cast<float>(change(value_at<float>(bytes)));
    to_big_endian(&value, 1, bytes);
  } else {
    const double value = change(value_at<double>(bytes));
    to_big_endian(&value, 1, bytes);
  }
}

/// Adds a change of rows of floats or doubles: change(row, bytes, size of a value).
template <class Change>
void add_row_change(const MpasSource& source, const std::string& variable, NetcdfSubset& subset,
                    const Change& change) {
  const NetcdfReader& file = source.netcdf();
  const int v = file.find(variable);
  if (v < 0)
    return;
  const std::optional<NetcdfType> type = file.variables()[static_cast<std::size_t>(v)].type;
  if (type != NetcdfType::float32 && type != NetcdfType::float64)
    file.fail("{} does not hold floating-point numbers; make the file again", variable);
  const std::int64_t size = size_of(*type), row_bytes = row_width(file, v) * size;
  subset.changes[variable].push_back([=](std::int64_t begin, std::int64_t end, char* bytes) {
    for (std::int64_t row = begin; row < end; ++row, bytes += row_bytes)
      change(row, bytes, size);
  });
}

void exchange_pairs(const MpasSource& source, const std::string& variable,
                    const ReversedEdges& reversed, NetcdfSubset& subset) {
  const int v = source.netcdf().find(variable);
  if (v < 0)
    return;
  const std::int64_t size = value_bytes(source.netcdf(), v);
  subset.changes[variable].push_back(
      [size, &reversed](std::int64_t begin, std::int64_t end, char* bytes) {
        for (std::int64_t e = begin; e < end; ++e, bytes += 2 * size)
          if (reversed[static_cast<std::size_t>(e)] != 0)
            std::swap_ranges(bytes, bytes + size, bytes + size);
      });
}

/// Exchanges pairs, and reverses what depends on the normal.
void add_reversal(const MpasSource& source, const MpasVariable& variable,
                  const ReversedEdges& reversed, NetcdfSubset& subset) {
  const auto is_reversed = [&reversed](std::int64_t e) {
    return reversed[static_cast<std::size_t>(e)] != 0;
  };
  if (variable.columns == MpasDimension::two)
    exchange_pairs(source, variable.name, reversed, subset);
  else if (variable.numbers == MpasNumbers::angle)
    add_row_change(source, variable.name, subset,
                   [=](std::int64_t e, char* bytes, std::int64_t size) {
                     if (is_reversed(e))
                       change_value(bytes, size, [](double angle) {
                         return angle > 0 ? angle - std::numbers::pi : angle + std::numbers::pi;
                       });
                   });
  else if (variable.numbers == MpasNumbers::normal)
    add_row_change(source, variable.name, subset,
                   [=](std::int64_t e, char* bytes, std::int64_t size) {
                     for (std::int64_t k = 0; is_reversed(e) && k < 3; ++k)
                       change_value(bytes + k * size, size, [](double x) { return -x; });
                   });
}

/// By kept edge: 1 if one of its cells has or may have a reversed edge.
std::vector<std::uint8_t> near_reversed(const MpasPart& part, const ReversedEdges& reversed) {
  std::vector<std::uint8_t> near(reversed.size(), 0);
  for (std::int64_t i = 0; i < part.cells.count(); ++i) {
    const std::span<const std::int32_t> edges = part.edges_on_cell[i];
    if (std::ranges::any_of(
            edges, [&](std::int32_t e) { return reversed[static_cast<std::size_t>(e)] != 0; }))
      for (const std::int32_t e : edges)
        near[static_cast<std::size_t>(e)] = 1;
  }
  for (std::size_t e = 0; e < near.size(); ++e)
    if (part.cells_at_edge[e] < 2) // the other cell is removed, but not all of its edges
      near[e] = 1;
  return near;
}

/// Reverses signs of weights. A weight relates the normal velocity of one edge to the tangential
/// velocity of another.
void add_weights(const MpasSource& source, const MpasPart& part, const ReversedEdges& reversed,
                 NetcdfSubset& subset) {
  if (source.netcdf().find(mpas::edges_on_edge) < 0 ||
      source.netcdf().find(mpas::weights_on_edge) < 0)
    return;
  const IdRows edges(source, subset, mpas::edges_on_edge, part.edges);
  add_row_change(source, mpas::weights_on_edge, subset,
                 [edges, &reversed, near = near_reversed(part, reversed)](
                     std::int64_t e, char* bytes, std::int64_t size) {
                   if (near[static_cast<std::size_t>(e)] == 0)
                     return;
                   std::vector<std::int64_t> ids;
                   edges.read(e, ids);
                   const bool own = reversed[static_cast<std::size_t>(e)] != 0;
                   for (std::size_t k = 0; k < ids.size(); ++k)
                     if (ids[k] > 0 && own != (reversed[static_cast<std::size_t>(ids[k] - 1)] != 0))
                       change_value(bytes + static_cast<std::int64_t>(k) * size, size,
                                    [](double w) { return -w; });
                 });
}

} // namespace

ReversedEdges reversed_edges(const MpasSource& source, const MpasPart& part) {
  const NetcdfReader& file = source.netcdf();
  const int v = file.find(mpas::cells_on_edge);
  if (v < 0)
    file.fail("it has no cellsOnEdge; make the file again");
  const std::vector<std::int32_t> cells = file.ints(mpas::cells_on_edge, {source.edges(), 2});
  ReversedEdges reversed(static_cast<std::size_t>(part.edges.count()));
  for_each_block(part.edges.count(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e < end; ++e) {
      const std::int32_t first = cells[static_cast<std::size_t>(2 * part.edges.old[e])];
      const bool kept = first > 0 && first <= source.cells() && part.cells.number[first - 1] > 0;
      reversed[static_cast<std::size_t>(e)] = kept ? 0 : 1;
    }
  });
  return reversed;
}

void add_reversals(const MpasSource& source, const MpasPart& part, const ReversedEdges& reversed,
                   NetcdfSubset& subset) {
  for (const MpasVariable& variable : mpas_variables())
    add_reversal(source, variable, reversed, subset);
  add_weights(source, part, reversed, subset);
}

void add_kites(const MpasSource& source, const MpasPart& part, NetcdfSubset& subset) {
  const NetcdfReader& file = source.netcdf();
  const int kites = file.find(mpas::kite_areas_on_vertex);
  if (file.find(mpas::cells_on_vertex) < 0 || kites < 0)
    return;
  const IdRows cells(source, subset, mpas::cells_on_vertex, part.vertices);
  const auto is_complete = [&part](std::int64_t v) {
    return part.cells_at_vertex[static_cast<std::size_t>(v)] >= 3;
  };
  add_row_change(source, mpas::kite_areas_on_vertex, subset,
                 [=](std::int64_t v, char* bytes, std::int64_t size) {
                   if (is_complete(v))
                     return;
                   std::vector<std::int64_t> ids;
                   cells.read(v, ids);
                   for (std::size_t j = 0; j < ids.size(); ++j)
                     if (ids[j] == 0)
                       std::memset(bytes + static_cast<std::int64_t>(j) * size, 0,
                                   static_cast<std::size_t>(size));
                 });
  const std::int64_t kite_bytes = value_bytes(file, kites);
  add_row_change(source, mpas::area_triangle, subset,
                 [=, &file, &part](std::int64_t v, char* bytes, std::int64_t size) {
                   if (is_complete(v))
                     return;
                   std::vector<std::int64_t> ids;
                   cells.read(v, ids);
                   std::string row(ids.size() * static_cast<std::size_t>(kite_bytes), '\0');
                   read_kept_rows(file, kites, 0, part.vertices, v, v + 1, row.data());
                   double sum = 0;
                   for (std::size_t j = 0; j < ids.size(); ++j) {
                     const char* const kite = row.data() + j * static_cast<std::size_t>(kite_bytes);
                     if (ids[j] > 0)
                       sum += kite_bytes == 4 ? value_at<float>(kite) : value_at<double>(kite);
                   }
                   change_value(bytes, size, [sum](double) { return sum; });
                 });
}

} // namespace calotte::io_detail
