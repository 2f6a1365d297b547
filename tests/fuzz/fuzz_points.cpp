// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <sstream>
#include <string>
#include <vector>

using namespace calotte;

/// Points in text: as many as lines that count, all finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const Columns columns : {Columns::xyz, Columns::lonlat, Columns::xy})
    try {
      std::istringstream in(text);
      const PointLines read = read_point_lines(in, "points", columns);
      fuzz::require(read.points.cols() == std::ssize(read.lines) && read.points.allFinite());
    } catch (const Error& error) {
      fuzz::require(error.code() != ErrorCode::internal);
    }
  return 0;
}
