// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>

using namespace calotte;
using calotte::fuzz::require;

/// Regions of any rings: refused, or with an area that fits, and no direction is beyond both sides.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  Surface::Rings rings(static_cast<std::size_t>(bytes.integer(1, 3)));
  for (DoubleMatrix& ring : rings)
    ring = bytes.columns(3, bytes.integer(0, 12));
  try {
    const Surface region = Surface::sphere().within(rings);
    const double all = region.area();
    require(all > -1e-14 && all < 12.6); // it errs by about 1e-15
    const Points3 places = fibonacci_sphere(50);
    for (DoubleMatrix& ring : rings)
      ring = DoubleMatrix(ring.rowwise().reverse());
    const Surface rest = Surface::sphere().within(rings);
    for (const auto& place : places.colwise())
      require(region.contains(place) || rest.contains(place));
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
  return 0;
}
