// SPDX-License-Identifier: GPL-3.0-or-later
// Triangulates random points of the sphere, and reads the triangles and their neighbours.
// Usage: triangulate [N], a million points by default.
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <cstdint>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  const std::int64_t n = argc > 1 ? std::stoll(argv[1]) : 1'000'000;

  // A column of a matrix is a point, or a triangle: the ids of its corners, counter-clockwise seen
  // from outside.
  const calotte::Points3 points = calotte::random_sphere(n);
  const calotte::Mesh mesh = calotte::delaunay(points);
  std::cout << mesh.points.cols() << " points, " << mesh.triangles.cols() << " triangles\n";

  // Entry i of a triangle's neighbours is across from its corner i; -1 would be a boundary.
  std::cout << "triangle 0 has the corners " << mesh.triangles.col(0).transpose()
            << " and the neighbours " << mesh.neighbours.col(0).transpose() << '\n';
}
