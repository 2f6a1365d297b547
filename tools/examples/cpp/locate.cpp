// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the triangle and the Voronoi cell that hold a point, and interpolates there.
// Usage: locate [LONGITUDE LATITUDE], degrees; 11.6 48.1 by default.
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/locate.h>

#include <cstdint>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  const bool given = argc == 3;
  const double longitude = given ? std::stod(argv[1]) : 11.6,
               latitude = given ? std::stod(argv[2]) : 48.1;

  // Many positions, one a column, take one call. A Locator is for many calls on the same mesh.
  const calotte::Points3 positions = calotte::from_lonlat(Eigen::Vector2d(longitude, latitude));
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(10'000));
  const calotte::Locations at = calotte::locate(mesh, positions);

  // The nearest site is that whose Voronoi cell holds the point.
  std::cout << "the point is in cell " << at.nearest[0] << ", whose site has the longitude and "
            << "latitude " << calotte::to_lonlat(mesh.points.col(at.nearest[0])).transpose()
            << '\n';

  // A mesh of a part of the sphere has no triangle, -1, at points outside. The weights of the
  // triangle's corners interpolate values at the sites: here their third coordinate, z.
  const std::int32_t triangle = at.triangle[0];
  double z = 0;
  for (int i = 0; i < 3; ++i)
    z += at.weights(i, 0) * mesh.points(2, mesh.triangles(i, triangle));
  std::cout << "and in triangle " << triangle << ", with z = " << z << " for " << positions(2, 0)
            << '\n';
}
