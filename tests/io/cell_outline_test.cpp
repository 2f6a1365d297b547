// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "delaunay/delaunay.h"
#include "io/cells/cell_outline.h"
#include "io/cells/polygons.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/voronoi.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

// The rings of cells on a map: corners that cells share have the same bits in each.

using namespace calotte;
using base_detail::LonLat;
using base_detail::Vec3;

namespace {

std::pair<std::uint64_t, std::uint64_t> bits_of(const LonLat& point) {
  return {std::bit_cast<std::uint64_t>(point.longitude),
          std::bit_cast<std::uint64_t>(point.latitude)};
}

/// Twice the area of a ring on the map, positive for counter-clockwise.
double twice_area(const std::vector<LonLat>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const LonLat &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += a.longitude * b.latitude - b.longitude * a.latitude;
  }
  return sum;
}

} // namespace

TEST_CASE("a corner has the bits of its longitude and latitude in the ring of each cell") {
  const std::vector<Points3> sets{random_sphere(2000, 5), random_sphere(50, 6),
                                  fibonacci_sphere(3000), lat_lon_sphere(10, 20, true),
                                  bisected_icosahedron(3)};
  for (std::size_t s = 0; s < sets.size(); ++s) {
    CAPTURE(s);
    const Points3& sites = sets[s];
    Voronoi voronoi = calotte::voronoi(delaunay(sites));
    const Eigen::VectorXd areas = voronoi.cell_area; // lattices have corners an ulp apart
    const Polygons cells = io_detail::with_merged_corners(polygons_of(std::move(voronoi)), areas);
    std::set<std::pair<std::uint64_t, std::uint64_t>> of_corners;
    for (Eigen::Index v = 0; v < cells.corners.cols(); ++v)
      of_corners.insert(bits_of(base_detail::lonlat_of(base_detail::column(cells.corners, v))));
    double whole = 0;
    for (Eigen::Index i = 0; i < cells.size(); ++i) {
      std::vector<Vec3> corners;
      for (const std::int32_t corner : cells.ids[i])
        corners.push_back(base_detail::column(cells.corners, corner));
      for (const std::vector<LonLat>& ring : io_detail::cell_outline(corners)) {
        whole += twice_area(ring) / 2;
        std::set<std::pair<std::uint64_t, std::uint64_t>> points;
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const LonLat &point = ring[k], &next = ring[(k + 1) % ring.size()];
          const bool added = std::abs(point.longitude) == 180 || std::abs(point.latitude) == 90;
          CHECK((added || of_corners.contains(bits_of(point))));
          CHECK(points.insert(bits_of(point)).second); // no point is repeated
          CHECK(std::hypot(point.longitude - next.longitude, point.latitude - next.latitude) >
                1e-12); // nor an ulp apart
        }
      }
    }
    CHECK(whole == doctest::Approx(360.0 * 180).epsilon(1e-9)); // the map is covered once
  }
}
