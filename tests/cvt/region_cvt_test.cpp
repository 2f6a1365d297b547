// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check.h>
#include <calotte/cvt.h>
#include <calotte/generators.h>
#include <calotte/region.h>
#include <calotte/write.h>

#include "cvt/region_cells.h"
#include "domain/spherical_outline.h"
#include "integrals/region_moments.h"

#include <Eigen/Geometry>
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace calotte;

namespace {

constexpr double degree = std::numbers::pi / 180;

Eigen::Vector3d at(double lon, double lat) {
  return {std::cos(lat * degree) * std::cos(lon * degree),
          std::cos(lat * degree) * std::sin(lon * degree), std::sin(lat * degree)};
}

/// A regular polygon around a place, of a radius in degrees; counter-clockwise.
Region cap(double lon, double lat, double radius, int corners = 64) {
  const Eigen::Vector3d c = at(lon, lat), e = Eigen::Vector3d(0, 0, 1).cross(c).normalized(),
                        n = c.cross(e);
  Points3 ring(3, corners);
  for (int k = 0; k < corners; ++k) {
    const double a = 2 * std::numbers::pi * k / corners;
    ring.col(k) = std::cos(radius * degree) * c +
                  std::sin(radius * degree) * (std::cos(a) * e + std::sin(a) * n);
  }
  return {{ring}};
}

Region polygon(const std::vector<std::pair<double, double>>& corners) {
  Points3 ring(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k)
    ring.col(static_cast<Eigen::Index>(k)) = at(corners[k].first, corners[k].second);
  return {{ring}};
}

double sum_of_cells(const Region& region, const Points3& points) {
  const domain_detail::SphericalOutline outline(region);
  cvt_detail::RegionCells cells(region);
  cells.move(points);
  const mesh_detail::Connectivity mesh = cells.signs().triangulate();
  std::vector<std::vector<base_detail::Vec3>> around(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v)
      if (mesh.triangles(v, t) < points.cols())
        around[static_cast<std::size_t>(mesh.triangles(v, t))].push_back(
            cells.place(mesh.triangles((v + 1) % 3, t)));
  double sum = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    sum += integrals_detail::clipped_area(outline, base_detail::column(points, i),
                                          around[static_cast<std::size_t>(i)]);
  return sum;
}

} // namespace

TEST_CASE("region: the cells' areas sum to the region's") {
  const std::vector<std::pair<const char*, Region>> regions = {
      {"hemisphere", cap(10, 20, 90)},
      {"1 degree", cap(10, 20, 1)},
      {"170 degrees", cap(10, 20, 170)},
      {"pole", polygon({{0, 60}, {90, 60}, {180, 60}, {-90, 60}})},
      {"date line", polygon({{170, -10}, {-170, -12}, {-165, 15}, {172, 11}})},
      {"bay", polygon({{0, 0}, {40, 0}, {40, 30}, {21, 30}, {20, 3}, {19, 30}, {0, 30}})}};
  for (const auto& [name, region] : regions) {
    CAPTURE(name);
    const Points3 start = random_sphere(400, region);
    const double whole = domain_detail::SphericalOutline(region).area();
    CHECK(std::abs(sum_of_cells(region, start) / whole - 1) < 1e-12);
    CvtOptions options;
    options.tolerance = 1e-5;
    const Cvt grid = spherical_cvt(start, region, options);
    CHECK(grid.report.converged);
    MESSAGE(name << " iterations " << grid.report.iterations.size() << " E n/A^2 "
                 << grid.report.iterations.back().energy * 400 / whole / whole);
    CHECK(std::abs(sum_of_cells(region, grid.mesh.points) / whole - 1) < 1e-12);
    CHECK(check_surface(grid.mesh).failure == "");
    const domain_detail::SphericalOutline outline(region);
    for (Eigen::Index i = 0; i < grid.mesh.points.cols(); ++i)
      CHECK(outline.side(base_detail::column(grid.mesh.points, i)) == domain_detail::Side::inside);
  }
}

TEST_CASE("scratch") {
  const Region region = cap(270, 30, 12);
  const Density density = tanh_bump(at(270, 30), 0.07, 0.06, 1.0 / 4096);
  const std::int64_t n = 20000;
  CvtOptions options;
  options.density = density;
  options.insertion_rounds = 1;
  options.cells = n;
  options.well_centred = true;
  options.tolerance = 3e-4;
  const Continuation from = multilevel(n, region, density);
  options.bisections = from.bisections;
  const Cvt grid = spherical_cvt(from.start, region, options);
  MESSAGE(grid.report.converged << grid.report.well_centred << " it "
                                << grid.report.iterations.size() << " s " << grid.report.seconds
                                << " n " << grid.mesh.points.cols() << " mis "
                                << grid.report.iterations.back().misshapen);
  int rebuilt = 0;
  double mom = 0, rep = 0, all = 0, sol = 0;
  for (const auto& i : grid.report.iterations) {
    rebuilt += i.rebuilt;
    mom += i.seconds_moments;
    rep += i.seconds_repair;
    all += i.seconds;
    sol += i.seconds_solver;
  }
  MESSAGE("rebuilt " << rebuilt << " mom " << mom << " rep " << rep << " all " << all << " sol "
                     << sol);
  write("/tmp/w/region.vtp", grid.mesh);
}
