// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <iostream>

namespace {

/// An exception across the library's boundary.
bool refuses_a_point() {
  try {
    calotte::delaunay(calotte::Points3::Zero(3, 4));
  } catch (const calotte::Error& error) {
    return error.code() == calotte::ErrorCode::zero_vector;
  }
  return false;
}

} // namespace

int main() {
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(1000));
  const calotte::Cvt grid = calotte::make_grid({.cells = 162});
  std::cout << mesh.triangles.cols() << " triangles\n";
  return mesh.closed() && grid.report.converged && refuses_a_point() ? 0 : 1;
}
