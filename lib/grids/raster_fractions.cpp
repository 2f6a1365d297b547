// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/spherical_triangle.h"
#include "density/raster_field.h"
#include "grids/room.h"
#include "voronoi/cell_walk.h"
#include "voronoi/connectivity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

// Each node of the raster stands for the rectangle between the middles to its neighbours. A
// rectangle is cut into equal parts that are small against the cells; the middle of a part tells
// the cell that gets its area. Tasks take rows of the raster; their sums are added in the order of
// the rows.

namespace calotte {
namespace grids_detail {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double parts_across_cell = 4;
constexpr int most_parts = 256; ///< of a rectangle in each direction

/// The n + 1 borders of the rectangles of n values, with the first and the last given.
std::vector<double> borders(const DoubleVector& values, double first, double last) {
  std::vector<double> all{first};
  for (Eigen::Index i = 1; i < values.size(); ++i)
    all.push_back(0.5 * (values[i - 1] + values[i]));
  all.push_back(last);
  return all;
}

std::vector<double> borders_of_longitudes(const DoubleVector& lon) {
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
    const std::span<const std::int32_t> vertices = cells_.vertices_on_cell[i];
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const Vec3 &from = column(cells_.vertices, voronoi_detail::start_of(cells_, i, k)),
                 &to = column(cells_.vertices, vertices[k]);
      const Vec3 normal = cross(from, to - from);
      nearest = std::min(nearest, dot(normal, generator) / std::sqrt(dot(normal, normal)));
      area += triangle_area(generator, from, to);
    }
    reach_[i] = nearest > 1e-9 ? part * part * nearest * nearest : 0; // and 0 for NaN
    size_[i] = std::sqrt(std::max(area, 0.0));
  }

  const Voronoi& cells_;
  const CellWalk walk_;
  DoubleVector reach_; ///< squared
  DoubleVector size_;
};

/// The n + 1 sines, of latitudes or longitudes, of the borders of n equal parts, and the directions
/// of their middles in the plane of the meridian or the equator.
struct BoxParts {
  std::vector<double> sines;
  std::vector<Vec3> middles;
};

// Places are turned a little, so that none is a vertex or on an edge of the cells of a lattice.
constexpr double aside = 1e-10;

BoxParts parts_of_latitudes(double south, double north, int n) {
  BoxParts parts;
  for (int p = 0; p <= n; ++p)
    parts.sines.push_back(from_lonlat(0, std::lerp(south, north, double(p) / n)).z);
  for (int p = 0; p < n; ++p)
    parts.middles.push_back(
        from_lonlat(0, std::min(std::lerp(south, north, (p + 0.5) / n) + aside, 90.0)));
  return parts;
}

Vec3 middle_of_longitudes(double west, double east, int q, int n) {
  return from_lonlat(std::lerp(west, east, (q + 0.5) / n) + 0.7 * aside, 0);
}

/// The borders of the rectangles, in degrees, and the middles of these.
struct Grid {
  std::vector<double> meridians, parallels;
  std::vector<Vec3> middles; ///< of columns, on the equator

  explicit Grid(const Raster& raster)
      : meridians(borders_of_longitudes(raster.x)), parallels(borders(raster.y, -90, 90)) {
    for (std::size_t i = 0; i + 1 < meridians.size(); ++i)
      middles.push_back(middle_of_longitudes(meridians[i], meridians[i + 1], 0, 1));
  }
};

/// The sums of a row of the raster, one by cell.
class RowSums {
public:
  RowSums(const Raster& raster, const Finder& finder, const Grid& grid, std::int64_t row)
      : finder_(finder), grid_(grid), south_(grid.parallels[static_cast<std::size_t>(row)]),
        north_(grid.parallels[static_cast<std::size_t>(row) + 1]),
        widest_(south_ <= 0 && north_ >= 0
                    ? 1
                    : from_lonlat(0, std::min(std::abs(south_), std::abs(north_))).x) {
    for (std::int64_t i = 0; i < raster.x.size(); ++i)
      add(static_cast<std::size_t>(i), raster.values(i, row));
    merge();
  }
  const std::vector<Sum>& sums() const { return sums_; }

private:
  void add(std::size_t column, double land) {
    const double west = grid_.meridians[column], east = grid_.meridians[column + 1];
    const double part = degree * (east - west);
    const BoxParts& whole = parts(1);
    cell_ = finder_.locate(cell_, place(grid_.middles[column], whole.middles[0]));
    const int n = count(part);
    if (n == 1)
      return add(land, part * (whole.sines[1] - whole.sines[0]));
    std::vector<Vec3> along;
    for (int q = 0; q < n; ++q)
      along.push_back(middle_of_longitudes(west, east, q, n));
    const BoxParts& up = parts(n);
    for (std::size_t p = 0; p < up.middles.size(); ++p)
      for (const Vec3& middle : along) {
        cell_ = finder_.locate(cell_, place(middle, up.middles[p]));
        add(land, part / n * (up.sines[p + 1] - up.sines[p]));
      }
  }
  void add(double land, double area) {
    if (sums_.empty() || sums_.back().cell != cell_)
      sums_.push_back({cell_, 0, 0});
    sums_.back().land += land * area;
    sums_.back().whole += area;
  }

  static Vec3 place(const Vec3& along, const Vec3& up) {
    return {up.x * along.x, up.x * along.y, up.z};
  }

  /// The parts of a rectangle in each direction, by the cell at its middle.
  int count(double width) const {
    const double longest = std::max(width * widest_, degree * (north_ - south_)),
                 parts = std::ceil(parts_across_cell * longest / finder_.size(cell_));
    return parts <= most_parts ? std::max(1, static_cast<int>(parts)) : most_parts;
  }

  const BoxParts& parts(int n) {
    std::optional<BoxParts>& known = parts_[static_cast<std::size_t>(n - 1)];
    if (!known)
      known = parts_of_latitudes(south_, north_, n);
    return *known;
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
  const Grid& grid_;
  double south_, north_;
  double widest_; ///< cosine of the latitude nearest to the equator
  std::array<std::optional<BoxParts>, most_parts> parts_;
  std::int32_t cell_ = 0;
  std::vector<Sum> sums_;
};

/// The value of the rectangle that contains a place.
double value_at(const Raster& raster, const Grid& grid, const Vec3& place) {
  const auto index_of = [](const std::vector<double>& all, double value) {
    const auto after = std::upper_bound(all.begin() + 1, all.end() - 1, value);
    return after - all.begin() - 1;
  };
  auto [longitude, latitude] = lonlat_of(place);
  while (longitude < grid.meridians.front())
    longitude += 360;
  while (longitude >= grid.meridians.back())
    longitude -= 360;
  return raster.values(index_of(grid.meridians, longitude), index_of(grid.parallels, latitude));
}

} // namespace
} // namespace grids_detail

DoubleVector land_fractions(const Voronoi& cells, const Raster& raster) {
  using namespace grids_detail;
  require(!raster.of_plane, "the raster of land is one of a plane; give longitudes and latitudes");
  density_detail::require_values(raster, "land", density_detail::a_fraction);
  const Grid grid(raster);
  const Finder finder(cells);
  const std::int64_t n = cells.cells.cols(), rows = raster.y.size();
  DoubleVector land = DoubleVector::Zero(n), whole = DoubleVector::Zero(n);
  constexpr std::int64_t at_once = 256; // rows: bounds the memory
  for (std::int64_t first = 0; first < rows; first += at_once) {
    std::vector<std::vector<Sum>> sums(static_cast<std::size_t>(std::min(at_once, rows - first)));
    for_each_task(std::ssize(sums), [&](std::int64_t r) {
      sums[static_cast<std::size_t>(r)] = RowSums(raster, finder, grid, first + r).sums();
    });
    for (const std::vector<Sum>& row : sums)
      for (const Sum& sum : row) {
        land[sum.cell] += sum.land;
        whole[sum.cell] += sum.whole;
      }
  }
  for (std::int64_t i = 0; i < n; ++i)
    land[i] = whole[i] > 0 ? std::clamp(land[i] / whole[i], 0.0, 1.0)
                           : value_at(raster, grid, column(cells.cells, i));
  return land;
}

} // namespace calotte
