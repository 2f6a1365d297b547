// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "delaunay/delaunay.h"
#include "mutation.h"

#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>

using namespace calotte;
using calotte::fuzz::require;

namespace {

/// The same mesh for any number of regions, and one that check() proves.
template <class Triangulate> void check_laws(const Triangulate& triangulate, int regions) {
  try {
    const Mesh mesh = triangulate(1);
    require(check(mesh).passed());
    const Mesh other = triangulate(regions);
    require(mesh.triangles == other.triangles && mesh.neighbours == other.neighbours);
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
}

} // namespace

/// Triangulations of the plane and of a periodic box.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int regions = bytes.integer(2, 40);
  const bool periodic = bytes.integer(0, 1) == 1;
  const Eigen::Vector2d period(std::abs(bytes.number()), std::abs(bytes.number()));
  const Points2 places = bytes.columns(2, 300);
  check_laws(
      [&](int count) {
        const DelaunayOptions options{.decomposition = {.regions = count}};
        return periodic ? delaunay(places, Surface::periodic(period), options)
                        : delaunay(places, Surface::plane(), options);
      },
      regions);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return calotte::fuzz::mutate_points(data, size, most, seed);
}
