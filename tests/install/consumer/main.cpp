// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <iostream>

int main() {
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(1000));
  std::cout << mesh.triangles.cols() << " triangles\n";
  return mesh.closed() ? 0 : 1;
}
