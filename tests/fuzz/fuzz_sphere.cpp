// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "delaunay/delaunay.h"
#include "mutation.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <numeric>
#include <vector>

using namespace calotte;
using calotte::fuzz::require;

/// Triangulations of the sphere: exact, and the same for any regions and order of the points.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int regions = bytes.integer(2, 40), shift = bytes.integer(1, 200);
  const Points3 points = bytes.columns(3, 300);
  try {
    const Mesh mesh = delaunay(points, {}, {.decomposition = {.regions = 1}});
    require(check(mesh).passed());
    const Mesh other = delaunay(points, {}, {.decomposition = {.regions = regions}});
    require(mesh.triangles == other.triangles && mesh.neighbours == other.neighbours);
    Points3 turned(3, points.cols()); // the same points from another one on
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      turned.col(i) = points.col((i + shift) % points.cols());
    require(delaunay(turned).triangles.cols() == mesh.triangles.cols());
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return calotte::fuzz::mutate_points(data, size, most, seed);
}
