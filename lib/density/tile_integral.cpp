// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/tile_integral.h"

#include "base/lonlat.h"
#include "base/parallel.h"
#include "domain/near_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

namespace calotte::density_detail {
namespace {

double area_of(const CoordinateBox& box, bool of_plane) {
  if (of_plane)
    return box.dx * box.dy;
  const auto sine = [](double latitude) { return base_detail::from_lonlat(0, latitude).z; };
  return box.dx * (std::numbers::pi / 180) * (sine(box.south + box.dy) - sine(box.south));
}

/// Integrates over a tile by boxes, which are halved down to a number in each direction.
class TileIntegral {
public:
  /// \param columns, rows at least those of the tile: powers of two.
  TileIntegral(const WidthTiles& tiles, std::int64_t tile, std::int64_t columns, std::int64_t rows,
               const Surface& surface)
      : tile_(tiles[tile]), box_(tiles.box().tile(tile)), of_plane_(tiles.of_plane()),
        columns_(columns), rows_(rows), surface_(surface) {}

  double operator()() const { return sum(0, 0, columns_, rows_, true); }

private:
  /// \param crossed whether the boundary may cross the boxes from (i, j) on.
  double sum(std::int64_t i, std::int64_t j, std::int64_t columns, std::int64_t rows,
             bool crossed) const {
    const double dx = box_.dx / static_cast<double>(columns_),
                 dy = box_.dy / static_cast<double>(rows_);
    const CoordinateBox box{
        box_.west + static_cast<double>(i) * dx, static_cast<double>(columns) * dx,
        box_.south + static_cast<double>(j) * dy, static_cast<double>(rows) * dy};
    if (crossed) {
      const Extent extent = extent_of(box, of_plane_);
      const bool one = columns == 1 && rows == 1;
      crossed = !one && domain_detail::is_near_boundary(surface_, extent.middle, extent.reach);
      if (!crossed && !contains(extent.middle))
        return 0;
    }
    const bool fine = columns <= columns_ / tile_.x().intervals() &&
                      rows <= rows_ / tile_.y().intervals(); // within a box between nodes
    if (!crossed && fine) {
      const double h = width_at(static_cast<double>(i) + static_cast<double>(columns) / 2,
                                static_cast<double>(j) + static_cast<double>(rows) / 2);
      return area_of(box, of_plane_) / (h * h);
    }
    const std::int64_t west = std::max<std::int64_t>(columns / 2, 1),
                       south = std::max<std::int64_t>(rows / 2, 1);
    double all = 0;
    for (std::int64_t y = 0; y < rows; y += south)
      for (std::int64_t x = 0; x < columns; x += west)
        all += sum(i + x, j + y, west, south, crossed);
    return all;
  }

  bool contains(const Vec3& p) const {
    return !surface_.is_bounded() || surface_.contains({p.x, p.y, p.z});
  }
  /// \param x, y in boxes.
  double width_at(double x, double y) const {
    const double u = x * static_cast<double>(tile_.x().intervals()) / static_cast<double>(columns_),
                 v = y * static_cast<double>(tile_.y().intervals()) / static_cast<double>(rows_);
    const auto i = static_cast<std::int64_t>(u), j = static_cast<std::int64_t>(v);
    const auto along = [&](std::int64_t row) {
      const double west = tile_.value(i, row);
      return west + (u - static_cast<double>(i)) * (tile_.value(i + 1, row) - west);
    };
    const double low = along(j);
    return low + (v - static_cast<double>(j)) * (along(j + 1) - low);
  }

  WidthTiles::Tile tile_;
  CoordinateBox box_;
  bool of_plane_;
  std::int64_t columns_, rows_;
  const Surface& surface_;
};

} // namespace

double integral_in(const WidthTiles& tiles, const Surface& surface) {
  constexpr double boxes_across = 512; // of the surface, where its boundary is
  const double tile_area = area_of(tiles.box().tile(tiles.size() / 2), tiles.of_plane()),
               across = std::sqrt(surface.area() / tile_area);
  std::int64_t least = 1;
  while (static_cast<double>(least) * across < boxes_across && least < boxes_across)
    least *= 2;
  std::vector<double> sums(static_cast<std::size_t>(tiles.size()));
  base_detail::for_each_task(tiles.size(), [&](std::int64_t k) {
    const WidthTiles::Tile tile = tiles[k];
    const TileIntegral integral(tiles, k, std::max(least, tile.x().intervals()),
                                std::max(least, tile.y().intervals()), surface);
    sums[static_cast<std::size_t>(k)] = integral();
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

} // namespace calotte::density_detail
