// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "support/exact.h"
#include "support/joined.h"
#include "support/oracle.h"
#include "support/random.h"

#include <calotte/generators.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// The point sets for the tests of the laws.
namespace calotte::test {

using base_detail::Vec3;

constexpr std::int64_t unknown_sites = -2;

struct Cloud {
  std::string name;
  Points3 points;
  bool closed = true; ///< no closed hemisphere contains all
  bool ties = false;  ///< some four sites are cocircular, or nearly, so that CGAL may triangulate
                      ///< them differently
  std::int64_t sites = -1; ///< number of distinct directions; -1 for all points
};

inline Points3 columns(const std::vector<Vec3>& points) {
  Points3 out(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    out.col(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y, points[i].z;
  return out;
}

/// True if no closed hemisphere contains all sites. If one does, and the sites are not all on one
/// great circle, it can be turned until two sites that are not parallel lie on its boundary.
/// O(n^3).
inline bool is_closed(const Points3& points) {
  const Eigen::Index n = points.cols();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const Vec3 a = oracle::site(points, i), b = oracle::site(points, j);
      if (i == j || exact::same_direction(a, b) || exact::same_direction(a, -b))
        continue;
      bool left = true;
      for (Eigen::Index k = 0; k < n && left; ++k)
        left = exact_detail::orientation(a, b, oracle::site(points, k)) >= 0;
      if (left)
        return false;
    }
  return true;
}

// ---- Lattices

/// Centres of the 12 nside^2 cells of HEALPix in ring order (Gorski et al., Astrophys. J. 622,
/// 2005, Eqs. 4-9).
inline Points3 healpix_centres(int nside) {
  std::vector<Vec3> points;
  for (int ring = 1; ring < 4 * nside; ++ring) {
    const int from_pole = std::min(ring, 4 * nside - ring);
    const bool polar = from_pole < nside;
    const double height = polar ? 1 - double(from_pole) * from_pole / (3.0 * nside * nside)
                                : 4.0 / 3 - 2.0 * from_pole / (3.0 * nside);
    const double z = ring <= 2 * nside ? height : -height, radius = std::sqrt((1 - z) * (1 + z));
    const int count = 4 * (polar ? from_pole : nside);
    const double shift = polar || (from_pole - nside) % 2 == 0 ? 0.5 : 0;
    for (int j = 0; j < count; ++j) {
      const double longitude = 2 * std::numbers::pi * (j + shift) / count;
      points.push_back({radius * std::cos(longitude), radius * std::sin(longitude), z});
    }
  }
  return columns(points);
}

/// The octahedral Gaussian grid O-n: rows at the 2n Gaussian latitudes, 4 i + 16 points in the i-th
/// from a pole.
inline Points3 octahedral_gaussian(int n) {
  std::vector<Vec3> points;
  for (int row = 1; row <= 2 * n; ++row) {
    double z = std::cos(std::numbers::pi * (row - 0.25) / (2 * n + 0.5));
    for (int step = 0; step < 10; ++step) { // Newton on the Legendre polynomial of degree 2n
      double p = 1, before = 0;
      for (int k = 1; k <= 2 * n; ++k)
        before = std::exchange(p, ((2 * k - 1) * z * p - (k - 1) * before) / k);
      z -= p * (z * z - 1) / (2 * n * (z * p - before));
    }
    const int count = 4 * std::min(row, 2 * n + 1 - row) + 16;
    for (int j = 0; j < count; ++j) {
      const double longitude = 2 * std::numbers::pi * j / count, r = std::sqrt((1 - z) * (1 + z));
      points.push_back({r * std::cos(longitude), r * std::sin(longitude), z});
    }
  }
  return columns(points);
}

inline Points3 signs_of(const Vec3& p) {
  std::vector<Vec3> points;
  for (const double x : {-p.x, p.x})
    for (const double y : {-p.y, p.y})
      for (const double z : {-p.z, p.z})
        points.push_back({x, y, z});
  return columns(points);
}

inline Points3 octahedron() {
  return columns({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
}

inline Points3 dodecahedron() {
  const double phi = std::numbers::phi, psi = phi - 1;
  std::vector<Vec3> edges;
  for (const double s : {-psi, psi})
    for (const double t : {-phi, phi}) {
      edges.push_back({0, s, t});
      edges.push_back({s, t, 0});
      edges.push_back({t, 0, s});
    }
  return joined(signs_of({1, 1, 1}), columns(edges));
}

/// The integer points on the circle x^2 + y^2 = 1105^2 at height z, 108 of them, exactly
/// cocircular.
inline Points3 exact_circle(double z) {
  std::vector<Vec3> points;
  for (int x = -1105; x <= 1105; ++x) {
    const int y = static_cast<int>(std::lround(std::sqrt(1105.0 * 1105.0 - double(x) * x)));
    if (x * x + y * y != 1105 * 1105)
      continue;
    points.push_back({double(x), double(y), z});
    if (y != 0)
      points.push_back({double(x), double(-y), z});
  }
  return columns(points);
}

// ---- Random sets

inline Points3 random_in_cap(const Vec3& centre, double width, int n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  while (std::ssize(points) < n) {
    const Vec3 step{random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)};
    if (dot(step, step) < 1)
      points.push_back(centre + width * step);
  }
  return columns(points);
}

inline Points3 upper_half(int n, std::uint64_t seed) {
  Points3 points = random_sphere(n, seed);
  points.row(2) = points.row(2).cwiseAbs().cwiseMax(1e-3);
  return points;
}

inline Points3 circle_at_random(int n, double z_noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double longitude = random.real(0, 2 * std::numbers::pi);
    points.push_back({std::cos(longitude), std::sin(longitude),
                      z_noise > 0 ? random.real(-z_noise, z_noise) : 0});
  }
  return columns(points);
}

/// Spacings of 1 near a centre to 8 far from it.
inline Points3 eight_to_one(int n, std::uint64_t seed) {
  Random random(seed);
  const Vec3 centre{0.6, 0, 0.8};
  std::vector<Vec3> points;
  while (std::ssize(points) < n) {
    const Vec3 p = random.direction();
    const double spacing = 1 + 3.5 * (1 + std::tanh((norm(p - centre) - 0.6) / 0.15));
    if (random.real(0, 1) < 1 / (spacing * spacing))
      points.push_back(p);
  }
  return columns(points);
}

inline Points3 with_antipodes(const Points3& points) { return joined(points, -points); }

/// Each point and three others an ulp or two away in one coordinate.
inline Points3 with_close_companions(const Points3& points) {
  std::vector<Vec3> out;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = oracle::site(points, i);
    out.insert(out.end(), {p,
                           {std::nextafter(p.x, 2), p.y, p.z},
                           {p.x, std::nextafter(p.y, 2), p.z},
                           {p.x, p.y, std::nextafter(p.z, -2)}});
  }
  return columns(out);
}

inline Points3 with_norms(Points3 points, double exponent, std::uint64_t seed) {
  Random random(seed);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) *= std::pow(10, random.real(-exponent, exponent));
  return points;
}

/// Repeats columns, as they are and scaled by 2 and by a half.
inline Points3 with_duplicates(const Points3& points, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> out;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    out.push_back(oracle::site(points, i));
  const std::vector<Vec3> once = out;
  for (std::size_t i = 0; i < once.size(); i += 2) {
    out.push_back(once[i]);
    out.push_back((i % 4 == 0 ? 2 : 0.5) * once[i]);
  }
  random.shuffle(out);
  return columns(out);
}

/// A cluster that surrounds `centre`: five fixed sites and n random ones.
inline Points3 surrounding_cluster(const Vec3& centre, double width, int n, std::uint64_t seed) {
  const Vec3 u = exact_detail::normalised(cross(centre, {0.3, -0.5, 0.2})), v = cross(centre, u);
  return joined(columns({centre, centre + width * u, centre - width * u, centre + width * v,
                         centre - width * v}),
                random_in_cap(centre, width, n, seed));
}

/// The distinct longitudes and latitudes of the fixture of weather stations, as directions.
inline Points3 weather_stations(const std::string& fixtures) {
  std::ifstream in(fixtures + "/weather-stations.csv");
  std::vector<Vec3> points;
  for (std::string line; std::getline(in, line);) {
    std::istringstream text(line);
    double longitude, latitude;
    char comma;
    if (!(text >> longitude >> comma >> latitude))
      continue;
    const double radians = std::numbers::pi / 180, r = std::cos(latitude * radians);
    points.push_back({r * std::cos(longitude * radians), r * std::sin(longitude * radians),
                      std::sin(latitude * radians)});
  }
  return columns(points);
}

// ---- All sets

/// Small sets, whose triangulation the definition itself gives in reasonable time (oracle.h).
inline std::vector<Cloud> small_clouds() {
  std::vector<Cloud> out;
  const auto add = [&](std::string name, Points3 points, bool ties, std::int64_t sites = -1) {
    const bool closed = is_closed(points);
    out.push_back({std::move(name), std::move(points), closed, ties, sites});
  };
  for (const int n : {4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 17, 20, 25, 32, 40, 50})
    for (const std::uint64_t seed : {1, 2, 3})
      add("random " + std::to_string(n) + ", seed " + std::to_string(seed), random_sphere(n, seed),
          false);
  add("tetrahedron", columns({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}), false);
  add("cube", signs_of({1, 1, 1}), true);
  add("octahedron", octahedron(), true);
  add("icosahedron", bisected_icosahedron(0), false);
  add("dodecahedron", dodecahedron(), true);
  add("box 1 x 2 x 3", signs_of({1, 2, 3}), true);
  add("cube and octahedron", joined(signs_of({1, 1, 1}), octahedron()), true);
  add("tetrahedron in an octant", columns({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}), false);
  add("four in a small cap", columns({{0, 0, 1}, {1e-9, 0, 1}, {0, 1e-9, 1}, {1e-9, 1e-9, 1}}),
      true);
  add("octant, scaled duplicates",
      columns({{1, 1, 1},
               {2, 2, 2},
               {1, 0, 0},
               {0, 1, 0},
               {0, 0, 1},
               {3, 3, 3},
               {7, 0, 0},
               {-1, -1, -1}}),
      true, 5);
  add("the axes and neighbours an ulp away",
      joined(octahedron(), columns({{1, 1e-16, 0},
                                    {1, 0, 1e-16},
                                    {1, 1e-300, 0},
                                    {1e-300, 0, 1},
                                    {-1, -1e-200, 1e-200}})),
      true);
  add("great circle and a pole",
      joined(columns({{1, 0, 0}, {3, 4, 0}, {-3, 4, 0}, {-4, -3, 0}, {3, -4, 0}}),
             columns({{0, 0, 1}})),
      true);
  add("great circle and both poles",
      joined(columns({{1, 0, 0}, {3, 4, 0}, {-3, 4, 0}, {-4, -3, 0}, {3, -4, 0}}),
             columns({{0, 0, 1}, {0, 0, -1}})),
      true);
  add("half a great circle and a pole",
      columns({{1, 0, 0}, {3, 4, 0}, {0, 1, 0}, {-3, 4, 0}, {-1, 0, 0}, {0, 0, 1}}), true);
  add("antipodes on the boundary, inner sites on one side",
      columns({{1, 0, 0}, {-1, 0, 0}, {0, 1, 1}, {0, 1, 2}, {1, 2, 2}}), true);
  add("antipodes with one great circle between them",
      columns({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), true);
  add("near-great-circle 30", circle_at_random(30, 1e-14, 5), true);
  add("random 20 and antipodes", with_antipodes(random_sphere(20, 8)), true);
  add("five in companies of four", with_close_companions(random_sphere(5, 9)), true);
  add("random 30, norms 1e-200 to 1e200", with_norms(random_sphere(30, 10), 199, 11), false);
  add("lat-lon 3 x 4 and poles", lat_lon_sphere(3, 4, true), true);
  add("lat-lon 4 x 6", lat_lon_sphere(4, 6), true);
  add("cubed sphere 2", cubed_sphere(2), true);
  add("HEALPix 1", healpix_centres(1), true);
  add("HEALPix 2", healpix_centres(2), true);
  return out;
}

/// Sets of some hundred to some thousand sites.
inline std::vector<Cloud> large_clouds() {
  const Vec3 place = exact_detail::normalised({0.4, -0.7, 0.5});
  std::vector<Cloud> out{
      {"random 300", random_sphere(300, 21)},
      {"random 2000", random_sphere(2000, 22)},
      {"random 5000", random_sphere(5000, 23)},
      {"fibonacci 1000", fibonacci_sphere(1000)},
      {"spiral 1000", spiral_sphere(1000)},
      {"8:1, 3000", eight_to_one(3000, 24)},
      {"random 1000, norms 1e-200 to 1e200", with_norms(random_sphere(1000, 25), 199, 26)},
      {"random 500 and antipodes", with_antipodes(random_sphere(500, 27)), true, true},
      {"random 200 and companions an ulp away", with_close_companions(random_sphere(200, 28)), true,
       true},
      {"random 500 and the axes", joined(random_sphere(500, 29), octahedron())},
      {"random 400, doubled and tripled", with_duplicates(random_sphere(400, 30), 31), true, false,
       400},
      {"clusters at antipodes",
       joined(surrounding_cluster(place, 1e-3, 400, 32),
              surrounding_cluster(-place, 1e-3, 400, 33)),
       true, true},
      {"hemisphere", upper_half(1000, 34), false},
      {"closed hemisphere", joined(upper_half(500, 35), circle_at_random(100, 0, 36)), false},
      {"closed hemisphere, exact boundary", joined(upper_half(300, 37), exact_circle(0)), false,
       true},
      {"cap 1e-3 wide", random_in_cap(place, 1e-3, 1000, 38), false},
      {"cap 1e-12 wide", random_in_cap(place, 1e-12, 500, 39), false, true},
      {"small circle", exact_circle(700), false, true},
      {"small circle and its axis", joined(exact_circle(700), columns({{0, 0, 1}})), false, true},
      {"small circle and the other pole", joined(exact_circle(700), columns({{0, 0, -1}})), true,
       true},
      {"two parallel circles", joined(exact_circle(700), exact_circle(-300)), true, true},
      {"great circle and one site", joined(exact_circle(0), columns({{0.3, 0.4, 0.5}})), false,
       true},
      {"great circle and a site 1e-10 off", joined(exact_circle(0), columns({{3, 4, 1e-10}})),
       false, true},
      {"great circle and two sites", joined(exact_circle(0), columns({{0, 0, 1}, {1, 1, -1}})),
       true, true},
      {"near-great-circle 200",
       joined(circle_at_random(200, 1e-15, 40), columns({{1, 0.5, -1e-15}})), true, true},
      {"lat-lon 18 x 36", lat_lon_sphere(18, 36), true, true},
      {"lat-lon 17 x 32 and poles", lat_lon_sphere(17, 32, true), true, true},
      {"lat-lon 9 x 200", lat_lon_sphere(9, 200), true, true},
      {"cubed sphere 12", cubed_sphere(12), true, true},
      {"HEALPix 8", healpix_centres(8), true, true},
      {"octahedral Gaussian 8", octahedral_gaussian(8), true, true}};
  for (int level = 1; level <= 4; ++level)
    out.push_back({"icosahedral level " + std::to_string(level), bisected_icosahedron(level), true,
                   level > 3});
  return out;
}

/// Sets for the slow tests.
inline std::vector<Cloud> slow_clouds(const std::string& fixtures) {
  const Vec3 place = exact_detail::normalised({0.4, -0.7, 0.5});
  return {{"icosahedral level 5", bisected_icosahedron(5), true, true},
          {"icosahedral level 6", bisected_icosahedron(6), true, true},
          {"4000 within 1e-6 and 6 elsewhere",
           joined(random_in_cap(place, 1e-6, 4000, 51), octahedron()), true, true},
          {"4000 within 1e-6 and 3 around",
           joined(random_in_cap({0, 0, 1}, 1e-6, 4000, 52),
                  columns({{1, 0, -0.5}, {-1, 1, -0.5}, {-1, -1, -0.5}})),
           true, true},
          {"lat-lon 60 x 120 and poles", lat_lon_sphere(60, 120, true), true, true},
          {"cubed sphere 40", cubed_sphere(40), true, true},
          {"HEALPix 32", healpix_centres(32), true, true},
          {"octahedral Gaussian 32", octahedral_gaussian(32), true, true},
          {"8:1, 20000", eight_to_one(20000, 53)},
          {"random 40000", random_sphere(40000, 54)},
          {"weather stations", weather_stations(fixtures), true, true, unknown_sites}};
}

} // namespace calotte::test
