// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "support/planes.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

using namespace calotte;
using calotte::fuzz::require;

/// Regions of any rings: refused, or with an area and sides that fit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  Region region;
  const int rings = bytes.integer(1, 3);
  for (int k = 0; k < rings; ++k)
    region.rings.push_back(bytes.columns(3, bytes.integer(0, 12)));
  try {
    require_region(region);
    const double all = area(region);
    require(all > -1e-14 && all < 12.6); // it errs by about 1e-15
    const Points3 places = fibonacci_sphere(50);
    const auto inside = containing(region);
    for (Eigen::Index i = 0; i < places.cols(); ++i)
      require(inside(places.col(i)) == contains(region, Eigen::Vector3d(places.col(i))));
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
  return 0;
}
