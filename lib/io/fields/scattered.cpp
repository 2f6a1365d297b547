// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "io/fields/centres.h"
#include "mesh/locate.h"

#include <calotte/delaunay.h>
#include <calotte/field_grid.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::require;
using Rows = std::vector<std::int32_t>; ///< numbers of positions of the source

/// A position, so that rows can be sorted in memory.
struct Row {
  base_detail::Vec3 at;
  std::int32_t row;

  bool is_at(const base_detail::Vec3& other) const {
    return at.x == other.x && at.y == other.y && at.z == other.z;
  }
};

bool operator<(const Row& a, const Row& b) {
  if (a.at.x != b.at.x)
    return a.at.x < b.at.x;
  if (a.at.y != b.at.y)
    return a.at.y < b.at.y;
  return a.at.z != b.at.z ? a.at.z < b.at.z : a.row < b.row;
}

/// The positions in an order that does not depend on theirs, but for equal ones: sorted by their
/// coordinates.
std::vector<Row> sorted_rows(const Points3& points) {
  std::vector<Row> rows(static_cast<std::size_t>(points.cols()));
  const auto n = std::ssize(rows);
  const std::int64_t block = std::max<std::int64_t>(n / 16 + 1, 1 << 12);
  const auto at = [&](std::int64_t i) { return rows.begin() + std::min(i, n); };
  base_detail::for_each_task((n + block - 1) / block, [&](std::int64_t k) {
    for (std::int64_t i = k * block; i < std::min((k + 1) * block, n); ++i)
      rows[static_cast<std::size_t>(i)] = {base_detail::column(points, i),
                                           static_cast<std::int32_t>(i)};
    std::sort(at(k * block), at((k + 1) * block));
  });
  for (std::int64_t size = block; size < n; size *= 2)
    base_detail::for_each_task((n + 2 * size - 1) / (2 * size), [&](std::int64_t k) {
      std::inplace_merge(at(2 * k * size), at(2 * k * size + size), at(2 * (k + 1) * size));
    });
  return rows;
}

bool same_positions(const MeshField& a, const MeshField& b) {
  return base_detail::holds_for_blocks(a.values.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      if (std::isnan(a.values[i]) != std::isnan(b.values[i]))
        return false;
    return true;
  });
}

/// Numbers of fields, those with values at the same positions together.
std::vector<std::vector<std::size_t>> groups_of(const std::vector<MeshField>& fields) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const auto found = std::ranges::find_if(groups, [&](const std::vector<std::size_t>& group) {
      return same_positions(fields[group.front()], fields[k]);
    });
    if (found == groups.end())
      groups.push_back({k});
    else
      found->push_back(k);
  }
  return groups;
}

/// The distinct positions that have values, and their rows.
struct Distinct {
  Points3 points;
  Rows rows; ///< all, sorted by their positions
  Ids site;  ///< of each of the rows
};

Distinct distinct_of(const std::vector<Row>& sorted, const MeshField& field) {
  Distinct out;
  std::vector<base_detail::Vec3> points;
  std::vector<std::int32_t> site;
  for (const Row& row : sorted) {
    if (std::isnan(field.values[row.row]))
      continue;
    if (points.empty() || !row.is_at(points.back()))
      points.push_back(row.at);
    out.rows.push_back(row.row);
    site.push_back(static_cast<std::int32_t>(points.size()) - 1);
  }
  out.points.resize(3, std::ssize(points));
  for (std::int64_t i = 0; i < std::ssize(points); ++i)
    base_detail::set_column(out.points, i, points[static_cast<std::size_t>(i)]);
  out.site = Eigen::Map<const Ids>(site.data(), std::ssize(site));
  return out;
}

/// Triangulates positions, with the name of a field in errors. Some are one site, if their
/// directions are equal and their norms are not.
Mesh triangulated(Distinct& distinct, const FieldGrid& source, const MeshField& field) {
  try {
    Mesh mesh = renumbered(delaunay(distinct.points, source.positions->surface), Numbering::curve);
    for (std::int32_t& site : distinct.site)
      site = mesh.site_of_input[static_cast<std::size_t>(site)];
    return mesh;
  } catch (const Error& error) {
    const bool few = error.code() == ErrorCode::too_few_sites && distinct.points.cols() < 3;
    if (!few && error.code() != ErrorCode::degenerate)
      throw;
    const std::string rows = base_detail::counted(std::ssize(distinct.rows), "row");
    const char* const line = source.positions->surface.is_sphere() ? "great circle" : "line";
    throw Error(
        error.code(),
        few ? base_detail::message("{}: the {} with {} have fewer than 3 distinct positions; "
                                   "give more",
                                   source.name, rows, field.name)
            : base_detail::message("{}: the {} with {} are all on one {}; give positions "
                                   "beside it, too",
                                   source.name, rows, field.name, line));
  }
}

/// The rows of each site: `begin` has where they start, and one more.
struct RowsOfSites {
  std::vector<std::int64_t> begin;
  Rows rows;
};

RowsOfSites rows_of_sites(const Distinct& distinct, std::int64_t sites) {
  RowsOfSites out;
  out.begin.assign(static_cast<std::size_t>(sites) + 1, 0);
  out.rows.resize(distinct.rows.size());
  for (const std::int32_t site : distinct.site)
    ++out.begin[static_cast<std::size_t>(site)];
  base_detail::exclusive_scan(std::span(out.begin));
  std::vector<std::int64_t> next = out.begin;
  for (std::size_t i = 0; i < distinct.rows.size(); ++i) {
    const std::int32_t site = distinct.site[static_cast<Eigen::Index>(i)];
    out.rows[static_cast<std::size_t>(next[static_cast<std::size_t>(site)]++)] = distinct.rows[i];
  }
  return out;
}

/// The mean, which has the same bits for any order of the values and is exact for equal ones.
double mean_of(std::vector<double>& values) {
  std::ranges::sort(values);
  const double least = values.front();
  double above = 0;
  for (const double value : values)
    above += value - least;
  return least + above / static_cast<double>(values.size());
}

DoubleVector means_of(const RowsOfSites& of, const DoubleVector& values) {
  DoubleVector means(std::ssize(of.begin) - 1);
  base_detail::for_each_block(means.size(),
                              [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                                std::vector<double> several;
                                for (std::int64_t i = begin; i < end; ++i) {
                                  const auto first = of.begin[static_cast<std::size_t>(i)],
                                             last = of.begin[static_cast<std::size_t>(i) + 1];
                                  several.clear();
                                  for (std::int64_t k = first; k < last; ++k)
                                    several.push_back(values[of.rows[static_cast<std::size_t>(k)]]);
                                  means[i] = several.size() == 1 ? several[0] : mean_of(several);
                                }
                              });
  return means;
}

void require_scattered(const FieldGrid& source, Interpolation kind) {
  require(source.positions.has_value(),
          "{} has cells, which are not scattered; use interpolation_weights()", source.name);
  require(kind != Interpolation::conservative,
          "{} has positions without cells; give linear, nearest or natural as the method",
          source.name);
  for (const MeshField& field : source.fields) {
    require(field.values.size() == source.size(),
            "the field {} has {} values for {} positions; give one for each", field.name,
            field.values.size(), source.size());
    require(!field.values.array().isNaN().all(), "{}: {} has no values; leave it out", source.name,
            field.name);
    for (Eigen::Index i = 0; i < field.values.size(); ++i)
      if (std::isinf(field.values[i]))
        base_detail::refuse_at(i, "value {} of {} is infinite; give a number, or NaN for none",
                               field.name);
  }
  mesh_detail::require_positions_of(source.positions->surface, source.positions->points);
}

} // namespace
} // namespace io_detail

ScatteredFields interpolate_scattered(const FieldGrid& source, const FieldGrid& target,
                                      Interpolation kind) {
  using namespace io_detail;
  require_one_surface(source, target);
  require_scattered(source, kind);
  const std::vector<Row> sorted = sorted_rows(source.positions->points);
  const Points3 centres = centres_of(target);
  const auto at_target = [&](const Weights& weights, const DoubleVector& means) {
    DoubleVector values = interpolate(weights, means);
    for (Eigen::Index i = 0; i < target.mask.size(); ++i)
      if (target.mask[i] == 0)
        values[i] = std::numeric_limits<double>::quiet_NaN();
    return values;
  };
  std::vector<bool> merged(sorted.size());
  ScatteredFields out;
  out.fields = source.fields;
  for (const std::vector<std::size_t>& group : groups_of(source.fields)) {
    const MeshField& first = source.fields[group.front()];
    Distinct distinct = distinct_of(sorted, first);
    const Mesh mesh = triangulated(distinct, source, first);
    const RowsOfSites rows = rows_of_sites(distinct, mesh.points.cols());
    for (std::size_t site = 0; site + 1 < rows.begin.size(); ++site)
      for (std::int64_t k = rows.begin[site] + 1; k < rows.begin[site + 1]; ++k)
        merged[static_cast<std::size_t>(rows.rows[static_cast<std::size_t>(k)])] = true;
    const Weights weights = interpolation_weights(mesh, centres, kind);
    for (const std::size_t k : group)
      out.fields[k].values = at_target(weights, means_of(rows, source.fields[k].values));
  }
  out.merged = std::ranges::count(merged, true);
  return out;
}

} // namespace calotte
