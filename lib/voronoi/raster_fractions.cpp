// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "voronoi/cell_walk.h"
#include "voronoi/triangle_area.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

// Each node of the raster stands for the rectangle between the middles to its neighbours. A
// rectangle is cut into equal parts that are small against the cells; the middle of a part tells
// the cell that gets its area. Tasks take rows of the raster; their sums are added in the order of
// the rows.

namespace calotte {
namespace voronoi_detail {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double parts_across_cell = 8;
constexpr int most_parts = 256; ///< of a rectangle in each direction

bool ascends(const Eigen::VectorXd& values) {
  for (Eigen::Index i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      return false;
  return values.allFinite() && values.size() >= 2;
}

void require_raster(const LandRaster& raster) {
  const Eigen::VectorXd &lon = raster.longitudes, &lat = raster.latitudes;
  require(ascends(lon) && ascends(lat) && lon[lon.size() - 1] < lon[0] + 360 && lat[0] >= -90 &&
              lat[lat.size() - 1] <= 90,
          "the raster's longitudes and latitudes do not ascend within 360 and -90 to 90 degrees; "
          "give at least two of each");
  require(raster.land.rows() == lon.size() && raster.land.cols() == lat.size(),
          "the raster's values are not one by longitude and latitude; give longitudes x latitudes");
  const auto fraction = [](double value) { return value >= 0 && value <= 1; };
  require(std::all_of(raster.land.data(), raster.land.data() + raster.land.size(), fraction),
          "a value of the raster is no fraction of land from 0 to 1; correct it");
}

/// The n + 1 borders of the rectangles of n values, with the first and the last given.
std::vector<double> borders(const Eigen::VectorXd& values, double first, double last) {
  std::vector<double> all{first};
  for (Eigen::Index i = 1; i < values.size(); ++i)
    all.push_back(0.5 * (values[i - 1] + values[i]));
  all.push_back(last);
  return all;
}

std::vector<double> borders_of_longitudes(const Eigen::VectorXd& lon) {
  const double last = 0.5 * (lon[lon.size() - 1] + lon[0] + 360);
  return borders(lon, last - 360, last);
}

/// Areas in a cell.
struct Sum {
  std::int32_t cell;
  double land, whole;
};

/// The cells of places that are near each other.
class Finder {
public:
  explicit Finder(const Voronoi& cells)
      : cells_(cells), walk_(cells), reach_(cells.cells.cols()), size_(cells.cells.cols()) {
    for_each_block(cells.cells.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (auto i = static_cast<std::int32_t>(begin); i < end; ++i)
        measure(i);
    });
  }

  /// \param near the cell of a place near it.
  std::int32_t locate(std::int32_t near, const Vec3& place) const {
    const Vec3 way = place - column(cells_.cells, near);
    return dot(way, way) < reach_[near] ? near : walk_.locate(near, place);
  }
  double size(std::int32_t cell) const { return size_[cell]; } ///< square root of the area

private:
  /// The cell holds all places nearer to its generator than its edges, less a little for rounding.
  void measure(std::int32_t i) {
    constexpr double part = 0.99;
    const Vec3& generator = column(cells_.cells, i);
    double nearest = std::numeric_limits<double>::infinity(), area = 0;
    for (std::int64_t k = cells_.begin[i]; k < cells_.begin[i + 1]; ++k) {
      const Vec3 &from = column(cells_.vertices, walk_.start(i, k)),
                 &to = column(cells_.vertices, walk_.end(k));
      const Vec3 normal = cross(from, to - from);
      nearest = std::min(nearest, dot(normal, generator) / std::sqrt(dot(normal, normal)));
      area += triangle_area(generator, from, to);
    }
    reach_[i] = nearest > 1e-9 ? part * part * nearest * nearest : 0; // and 0 for NaN
    size_[i] = std::sqrt(std::max(area, 0.0));
  }

  const Voronoi& cells_;
  const CellWalk walk_;
  Eigen::VectorXd reach_; ///< squared
  Eigen::VectorXd size_;
};

/// A rectangle of longitudes and latitudes in degrees.
struct Rectangle {
  double west, east, south, north;

  Vec3 place(double along, double up) const {
    // Turned a little, so that no place is a vertex or on an edge of the cells of a lattice.
    constexpr double aside = 1e-10;
    return from_lonlat(std::lerp(west, east, along) + 0.7 * aside,
                       std::clamp(std::lerp(south, north, up) + aside, -90.0, 90.0));
  }
  /// The longer side, radians.
  double width() const {
    const double across = std::cos(
        degree * (south <= 0 && north >= 0 ? 0 : std::min(std::abs(south), std::abs(north))));
    return degree * std::max((east - west) * across, north - south);
  }
};

/// The sums of a row of the raster, one by cell.
class RowSums {
public:
  RowSums(const LandRaster& raster, const Finder& finder, const std::vector<double>& meridians,
          const std::vector<double>& parallels, std::int64_t row)
      : finder_(finder) {
    const auto at = [](const std::vector<double>& values, std::int64_t i) {
      return values[static_cast<std::size_t>(i)];
    };
    for (std::int64_t i = 0; i < raster.longitudes.size(); ++i)
      add({at(meridians, i), at(meridians, i + 1), at(parallels, row), at(parallels, row + 1)},
          raster.land(i, row));
    merge();
  }
  const std::vector<Sum>& sums() const { return sums_; }

private:
  void add(const Rectangle& whole, double land) {
    cell_ = finder_.locate(cell_, whole.place(0.5, 0.5));
    const double parts = std::ceil(parts_across_cell * whole.width() / finder_.size(cell_));
    const int n = parts >= 1 && parts <= most_parts ? static_cast<int>(parts)
                  : parts > most_parts              ? most_parts
                                                    : 1;
    for (int p = 0; p < n; ++p) {
      const double south = std::sin(degree * std::lerp(whole.south, whole.north, double(p) / n)),
                   north = std::sin(degree * std::lerp(whole.south, whole.north, (p + 1.0) / n)),
                   area = degree * (whole.east - whole.west) / n * (north - south);
      for (int q = 0; q < n; ++q) {
        cell_ = finder_.locate(cell_, whole.place((q + 0.5) / n, (p + 0.5) / n));
        if (sums_.empty() || sums_.back().cell != cell_)
          sums_.push_back({cell_, 0, 0});
        sums_.back().land += land * area;
        sums_.back().whole += area;
      }
    }
  }

  /// One sum for each cell, of its parts in their order.
  void merge() {
    std::stable_sort(sums_.begin(), sums_.end(),
                     [](const Sum& a, const Sum& b) { return a.cell < b.cell; });
    std::size_t last = 0;
    for (std::size_t k = 1; k < sums_.size(); ++k)
      if (sums_[k].cell == sums_[last].cell) {
        sums_[last].land += sums_[k].land;
        sums_[last].whole += sums_[k].whole;
      } else {
        sums_[++last] = sums_[k];
      }
    sums_.resize(std::min(sums_.size(), last + 1));
  }

  const Finder& finder_;
  std::int32_t cell_ = 0;
  std::vector<Sum> sums_;
};

/// The value of the rectangle that contains a place.
double value_at(const LandRaster& raster, const std::vector<double>& meridians,
                const std::vector<double>& parallels, const Vec3& place) {
  const auto index_of = [](const std::vector<double>& all, double value) {
    const auto after = std::upper_bound(all.begin() + 1, all.end() - 1, value);
    return after - all.begin() - 1;
  };
  double longitude = std::atan2(place.y, place.x) / degree;
  while (longitude < meridians.front())
    longitude += 360;
  while (longitude >= meridians.back())
    longitude -= 360;
  return raster.land(index_of(meridians, longitude),
                     index_of(parallels, std::asin(std::clamp(place.z, -1.0, 1.0)) / degree));
}

} // namespace
} // namespace voronoi_detail

Eigen::VectorXd land_fractions(const Voronoi& cells, const LandRaster& raster) {
  using namespace voronoi_detail;
  require_raster(raster);
  const std::vector<double> meridians = borders_of_longitudes(raster.longitudes),
                            parallels = borders(raster.latitudes, -90, 90);
  const Finder finder(cells);
  const std::int64_t n = cells.cells.cols(), rows = raster.latitudes.size();
  Eigen::VectorXd land = Eigen::VectorXd::Zero(n), whole = Eigen::VectorXd::Zero(n);
  constexpr std::int64_t at_once = 256; // rows: bounds the memory
  for (std::int64_t first = 0; first < rows; first += at_once) {
    std::vector<std::vector<Sum>> sums(static_cast<std::size_t>(std::min(at_once, rows - first)));
    for_each_task(std::ssize(sums), [&](std::int64_t r) {
      sums[static_cast<std::size_t>(r)] =
          RowSums(raster, finder, meridians, parallels, first + r).sums();
    });
    for (const std::vector<Sum>& row : sums)
      for (const Sum& sum : row) {
        land[sum.cell] += sum.land;
        whole[sum.cell] += sum.whole;
      }
  }
  for (std::int64_t i = 0; i < n; ++i)
    land[i] = whole[i] > 0 ? std::clamp(land[i] / whole[i], 0.0, 1.0)
                           : value_at(raster, meridians, parallels, column(cells.cells, i));
  return land;
}

} // namespace calotte
