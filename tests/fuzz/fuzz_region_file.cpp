// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <sstream>
#include <string>

using namespace calotte;

/// Regions in GeoJSON and .pts: what is read bounds a region.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"region.geojson", "region.pts"})
    try {
      std::istringstream in(text);
      const Surface region = read_region(in, name);
      Surface::sphere().within(region.rings());
      fuzz::require(region.area() > 0);
    } catch (const Error& error) {
      fuzz::require(error.code() != ErrorCode::internal);
    }
  return 0;
}
