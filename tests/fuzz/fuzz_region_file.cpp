// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <sstream>
#include <string>

using namespace calotte;

namespace {

/// What is read bounds a region.
template <class Read> void require_region(const Read& read) {
  try {
    const Surface region = read();
    Surface::sphere().within(region.rings());
    fuzz::require(region.area() > 0);
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
}

} // namespace

/// Regions in GeoJSON and .pts, and shapes by words.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"region.geojson", "region.pts"})
    require_region([&] {
      std::istringstream in(text);
      return read_region(in, name);
    });
  for (const char* shape : {"circle=", "ellipse=", "box=", "channel="})
    require_region([&] { return read_region(shape + text); });
  return 0;
}
