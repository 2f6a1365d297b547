// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "scratch_file.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

using namespace calotte;

namespace {

template <class Read> void holds(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
}

} // namespace

/// Shapefiles: three lengths of 16 bits, then a .shp, a .shx, a .dbf and a .prj.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::array<std::uint16_t, 3> lengths{};
  if (size < sizeof lengths)
    return 0;
  std::memcpy(lengths.data(), data, sizeof lengths);
  data += sizeof lengths, size -= sizeof lengths;
  std::string path;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t part = k < 3 ? std::min<std::size_t>(lengths[k], size) : size;
    const std::string name = std::array{"a.shp", "a.shx", "a.dbf", "a.prj"}[k];
    const std::string written = fuzz::scratch_file(name, data, part);
    if (k == 0)
      path = written;
    else if (part == 0 && k > 1)
      std::filesystem::remove(written);
    data += part, size -= part;
  }
  holds([&] { fuzz::require(read_coast(path).area >= 0); });
  holds([&] { read_shapes(path); });
  holds([&] { read_region(path).area(); });
  holds([&] { read_cell_width(path, {.inside = 50, .outside = 100, .transition = 3000}); });
  return 0;
}
