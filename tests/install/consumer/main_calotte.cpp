// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/read.h>

#include <iostream>

namespace {

/// Uses NetCDF, and an exception across the library's boundary.
bool misses_a_file() {
  try {
    calotte::read_cell_width("missing.nc");
  } catch (const calotte::Error& error) {
    return error.code() == calotte::ErrorCode::file;
  }
  return false;
}

} // namespace

int main() {
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(1000));
  std::cout << mesh.triangles.cols() << " triangles\n";
  return mesh.closed() && misses_a_file() ? 0 : 1;
}
