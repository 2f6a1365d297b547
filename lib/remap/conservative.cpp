// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/remap.h>

#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "mesh/locate.h"
#include "remap/box_overlaps.h"
#include "remap/box_tiling.h"
#include "remap/polygon_overlaps.h"
#include "remap/weight_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace calotte {
namespace remap_detail {
namespace {

void require_polygons(const Polygons& polygons) {
  for (std::int64_t i = 0; i < polygons.size(); ++i)
    for (const std::int32_t corner : polygons.ids[i])
      if (corner < 0 || corner >= polygons.corners.cols())
        refuse_at(i, "polygon {} has corner {}, which is not one of {}; give ids from 0 on", corner,
                  polygons.corners.cols());
}

template <Space S> DoubleVector areas_in(const S& space, const Polygons& polygons) {
  DoubleVector areas(polygons.size());
  for_each_block(areas.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::vector<Vec3> corners;
    for (std::int64_t i = begin; i < end; ++i) {
      set_corners(space, polygons, i, corners);
      areas[i] = area_of(space, corners);
    }
  });
  return areas;
}

/// The sums of rows.
DoubleVector row_sums(const Weights& weights) {
  DoubleVector sums(weights.rows());
  for_each_block(sums.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      double sum = 0;
      for (Weights::InnerIterator entry(weights, i); entry; ++entry)
        sum += entry.value();
      sums[i] = sum;
    }
  });
  return sums;
}

DoubleVector column_sums(const Weights& weights) {
  DoubleVector sums = DoubleVector::Zero(weights.cols());
  for (Eigen::Index k = 0; k < weights.nonZeros(); ++k)
    sums[weights.innerIndexPtr()[k]] += weights.valuePtr()[k];
  return sums;
}

Weights transposed(const Weights& weights) {
  Weights out(weights.cols(), weights.rows());
  out.resizeNonZeros(weights.nonZeros());
  int* const begin = out.outerIndexPtr();
  std::fill(begin, begin + out.rows() + 1, 0);
  for (Eigen::Index k = 0; k < weights.nonZeros(); ++k)
    ++begin[weights.innerIndexPtr()[k] + 1];
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    begin[i + 1] += begin[i];
  std::vector<int> next(begin, begin + out.rows());
  for (int row = 0; row < weights.rows(); ++row)
    for (Weights::InnerIterator entry(weights, row); entry; ++entry) {
      const int k = next[static_cast<std::size_t>(entry.col())]++;
      out.innerIndexPtr()[k] = row;
      out.valuePtr()[k] = entry.value();
    }
  return out;
}

DoubleVector quotients(const DoubleVector& a, const DoubleVector& b) {
  return (b.array() > 0).select(a.array() / b.array(), 0.0);
}

/// \param shared areas, a row for each cell of the target; consumed.
GridWeights weights_of_areas(Weights& shared, DoubleVector source_area, DoubleVector target_area) {
  const DoubleVector sums = row_sums(shared);
  GridWeights out{.weights = {},
                  .source_area = std::move(source_area),
                  .target_area = std::move(target_area),
                  .source_fraction = {},
                  .target_fraction = {}};
  out.source_fraction = quotients(column_sums(shared), out.source_area);
  out.target_fraction = quotients(sums, out.target_area);
  for_each_block(shared.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      for (Weights::InnerIterator entry(shared, i); entry; ++entry)
        entry.valueRef() /= sums[i];
  });
  out.weights.swap(shared);
  return out;
}

/// The areas that polygons share with boxes, a row for each polygon, and those of the polygons.
struct SharedWithBoxes {
  Weights shared;
  DoubleVector polygons;
};

SharedWithBoxes shared_with_boxes(const Polygons& polygons, const LonLatBoxes& boxes) {
  base_detail::require(polygons.surface.is_sphere(),
                       "the cells are in a plane, and longitudes and latitudes "
                       "on the sphere; give grids of one surface");
  require_polygons(polygons);
  const BoxTiling tiling(boxes);
  struct Worker {
    BoxOverlaps overlaps;
    std::vector<Vec3> corners;
  };
  SharedWithBoxes out{{}, DoubleVector(polygons.size())};
  Weights shared = matrix_of(
      polygons.size(), boxes.size(),
      [&] {
        return Worker{BoxOverlaps(tiling), {}};
      },
      [&](Worker& worker, std::int64_t i, WeightRow& row) {
        set_corners(exact_detail::Sphere(), polygons, i, worker.corners);
        out.polygons[i] = worker.overlaps.set(worker.corners, row);
      });
  out.shared.swap(shared);
  return out;
}

template <Space S>
GridWeights weights_in(const S& space, const Polygons& source, const Polygons& target) {
  const PolygonOverlaps<S> overlaps(space, source);
  Weights shared = matrix_of(
      target.size(), source.size(), [&] { return PolygonRow<S>(overlaps); },
      [&](PolygonRow<S>& worker, std::int64_t i, WeightRow& row) { worker.set(target, i, row); });
  return weights_of_areas(shared, areas_in(space, source), areas_in(space, target));
}

// ---- Boxes with boxes

/// The length that an interval shares with another.
struct SharedLength {
  std::int32_t other;
  double length;
};

/// The shared lengths of columns, radians.
std::vector<std::vector<SharedLength>> shared_columns(const LonLatBoxes& target,
                                                      const LonLatBoxes& source) {
  constexpr double degree = std::numbers::pi / 180;
  const BoxTiling tiling(source);
  std::vector<std::vector<SharedLength>> out(static_cast<std::size_t>(target.longitudes.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double west = target.meridians[k], east = target.meridians[k + 1];
    for (std::int64_t c = tiling.column_at(west); tiling.west_of(c) < east; ++c) {
      const double length =
          std::min(east, tiling.west_of(c + 1)) - std::max(west, tiling.west_of(c));
      const std::int64_t wrapped = tiling.wrapped(c);
      if (length > 1e-12 && wrapped < source.longitudes.size())
        out[i].push_back({static_cast<std::int32_t>(wrapped), degree * length});
    }
  }
  return out;
}

/// The shared heights of rows: differences of sines.
std::vector<std::vector<SharedLength>> shared_rows(const LonLatBoxes& target,
                                                   const LonLatBoxes& source) {
  const auto bounds = [](const LonLatBoxes& boxes, Eigen::Index j) {
    const double a = boxes.parallels[j], b = boxes.parallels[j + 1];
    return std::pair(std::min(a, b), std::max(a, b));
  };
  std::vector<std::vector<SharedLength>> out(static_cast<std::size_t>(target.latitudes.size()));
  for (std::size_t j = 0; j < out.size(); ++j) {
    const auto [south, north] = bounds(target, static_cast<Eigen::Index>(j));
    for (Eigen::Index k = 0; k < source.latitudes.size(); ++k) {
      const auto [low, high] = bounds(source, k);
      const double from = std::max(south, low), to = std::min(north, high);
      if (to - from > 1e-12)
        out[j].push_back({static_cast<std::int32_t>(k), rise(height_of(from), height_of(to))});
    }
  }
  return out;
}

// ---- Positions in boxes

/// The two nodes around a longitude.
struct Bracket {
  std::int32_t first, second; ///< of the columns; the second is -1 for none
  double part;                ///< of the second, 0 to 1
};

class BoxInterpolation {
public:
  explicit BoxInterpolation(const LonLatBoxes& boxes)
      : boxes_(boxes), tiling_(boxes), columns_(boxes.longitudes.size()),
        rows_(boxes.latitudes.size()), descends_(boxes.parallels[0] > boxes.parallels[rows_]),
        closed_(boxes.meridians[columns_] - boxes.meridians[0] > 360 - 1e-9) {}

  void set_nearest(const Vec3& unit, WeightRow& row) const {
    const std::int32_t box = tiling_.box_at(unit);
    if (box >= 0)
      row.push_back({box, 1});
  }

  void set_linear(const Vec3& unit, WeightRow& row) const {
    if (tiling_.box_at(unit) < 0)
      return;
    const base_detail::LonLat at = base_detail::lonlat_of(unit);
    const Bracket along = along_longitude(at.longitude);
    const Eigen::Index southern = node(0), northern = node(rows_ - 1);
    if (at.latitude > boxes_.latitudes[northern])
      return beyond(northern, at.latitude, 90, along, row);
    if (at.latitude < boxes_.latitudes[southern])
      return beyond(southern, at.latitude, -90, along, row);
    Eigen::Index low = 0, high = rows_ - 1; // of rows from the south
    while (high - low > 1) {
      const Eigen::Index middle = (low + high) / 2;
      (boxes_.latitudes[node(middle)] <= at.latitude ? low : high) = middle;
    }
    const double from = boxes_.latitudes[node(low)], to = boxes_.latitudes[node(high)],
                 part = high > low ? (at.latitude - from) / (to - from) : 0;
    add(node(low), along, 1 - part, row);
    add(node(high), along, part, row);
    finish(row);
  }

private:
  Eigen::Index node(Eigen::Index from_south) const {
    return descends_ ? rows_ - 1 - from_south : from_south;
  }

  Bracket along_longitude(double longitude) const {
    const DoubleVector& all = boxes_.longitudes;
    const double first = all[0], last = all[columns_ - 1];
    longitude -= 360 * std::floor((longitude - boxes_.meridians[0]) / 360);
    if (longitude < first || longitude > last) {
      const auto end = static_cast<std::int32_t>(columns_ - 1);
      const double gap = first + 360 - last,
                   behind = longitude > last ? longitude - last : longitude + 360 - last;
      if (!closed_)
        return {longitude < first ? 0 : end, -1, 0};
      return {end, 0, gap > 0 ? std::min(behind / gap, 1.0) : 0};
    }
    if (columns_ == 1)
      return {0, -1, 0};
    const auto after = std::upper_bound(all.begin() + 1, all.end() - 1, longitude);
    const auto k = static_cast<std::int32_t>(after - all.begin() - 1);
    return {k, k + 1, (longitude - all[k]) / (all[k + 1] - all[k])};
  }

  /// Sets the weights of a position between the last latitude and the pole, or the edge of the
  /// raster.
  void beyond(Eigen::Index last, double latitude, double pole, const Bracket& along,
              WeightRow& row) const {
    const double edge =
        boxes_.parallels[pole > 0 ? (descends_ ? 0 : rows_) : (descends_ ? rows_ : 0)];
    const double from = boxes_.latitudes[last];
    const bool to_pole = std::abs(edge - pole) < 1e-9 && closed_ && from != pole;
    const double part = to_pole ? (latitude - from) / (pole - from) : 0;
    add(last, along, 1 - part, row);
    if (part > 0)
      for (std::int32_t i = 0; i < columns_; ++i)
        row.push_back({box(last, i), part / static_cast<double>(columns_)});
    finish(row);
  }

  std::int32_t box(Eigen::Index latitude, std::int32_t column) const {
    return static_cast<std::int32_t>(latitude * columns_) + column;
  }
  void add(Eigen::Index latitude, const Bracket& along, double weight, WeightRow& row) const {
    if (weight * (1 - along.part) > 0)
      row.push_back({box(latitude, along.first), weight * (1 - along.part)});
    if (along.second >= 0 && weight * along.part > 0)
      row.push_back({box(latitude, along.second), weight * along.part});
  }
  static void finish(WeightRow& row) {
    sort_by_column(row);
    merge_columns(row);
  }

  const LonLatBoxes& boxes_;
  BoxTiling tiling_;
  Eigen::Index columns_, rows_;
  bool descends_, closed_;
};

} // namespace
} // namespace remap_detail

GridWeights conservative_weights(const Polygons& source, const Polygons& target) {
  using namespace remap_detail;
  base_detail::require(source.surface.is_sphere() == target.surface.is_sphere() &&
                           source.surface.period() == target.surface.period(),
                       "the cells are on different surfaces, or in planes of different periods; "
                       "give grids of one surface");
  require_polygons(source);
  require_polygons(target);
  return exact_detail::in_space_of(
      source.surface, [&](const auto& space) { return weights_in(space, source, target); });
}

GridWeights conservative_weights(const Polygons& source, const LonLatBoxes& target) {
  using namespace remap_detail;
  SharedWithBoxes found = shared_with_boxes(source, target);
  Weights shared = transposed(found.shared);
  return weights_of_areas(shared, std::move(found.polygons), areas(target));
}

GridWeights conservative_weights(const LonLatBoxes& source, const Polygons& target) {
  using namespace remap_detail;
  SharedWithBoxes found = shared_with_boxes(target, source);
  return weights_of_areas(found.shared, areas(source), std::move(found.polygons));
}

GridWeights conservative_weights(const LonLatBoxes& source, const LonLatBoxes& target) {
  using namespace remap_detail;
  require_boxes(source);
  require_boxes(target);
  const std::vector<std::vector<SharedLength>> columns = shared_columns(target, source),
                                               rows = shared_rows(target, source);
  const auto wide = static_cast<std::int64_t>(columns.size());
  const auto width = static_cast<std::int32_t>(source.longitudes.size());
  Weights shared = matrix_of(target.size(), source.size(), [&](std::int64_t i, WeightRow& row) {
    for (const SharedLength& high : rows[static_cast<std::size_t>(i / wide)])
      for (const SharedLength& part : columns[static_cast<std::size_t>(i % wide)])
        row.push_back({high.other * width + part.other, high.length * part.length});
    sort_by_column(row);
    merge_columns(row);
  });
  return weights_of_areas(shared, areas(source), areas(target));
}

Ids cells_at(const Polygons& polygons, const PointsRef& positions) {
  using namespace remap_detail;
  require_polygons(polygons);
  Ids found(positions.cols());
  const auto locate_in = [&](const auto& space, const auto& position_of) {
    const PolygonOverlaps overlaps(space, polygons);
    for_each_block(found.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      PolygonRow worker(overlaps);
      for (std::int64_t i = begin; i < end; ++i)
        found[i] = worker.find_containing(position_of(i));
    });
  };
  if (polygons.surface.is_sphere()) {
    const Sphere sphere;
    const base_detail::Points3Ref directions = mesh_detail::checked_positions(sphere, positions);
    locate_in(sphere, [&](std::int64_t i) {
      return exact_detail::unit_of_any_norm(column(directions, i));
    });
  } else {
    const Plane plane(polygons.surface.period());
    const base_detail::Points2Ref points = mesh_detail::checked_positions(plane, positions);
    locate_in(plane, [&](std::int64_t i) {
      return plane.wrapped(Vec3{points(0, i), points(1, i), 0});
    });
  }
  return found;
}

Weights interpolation_weights(const LonLatBoxes& source, const PointsRef& positions,
                              Interpolation kind) {
  using namespace remap_detail;
  base_detail::require(kind == Interpolation::nearest || kind == Interpolation::linear,
                       "a raster has weights at positions of the kinds nearest and linear only; "
                       "give one of these");
  const base_detail::Points3Ref directions = mesh_detail::checked_positions(Sphere(), positions);
  const BoxInterpolation boxes(source);
  return matrix_of(positions.cols(), source.size(), [&](std::int64_t i, WeightRow& row) {
    const Vec3 unit = exact_detail::unit_of_any_norm(column(directions, i));
    if (kind == Interpolation::nearest)
      boxes.set_nearest(unit, row);
    else
      boxes.set_linear(unit, row);
  });
}

} // namespace calotte
