// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <cstdint>
#include <string>
#include <vector>

/// The position of a variable's values in the classic formats, which the C library does not
/// provide.
namespace calotte::io_detail {

/// A classic file's variable: value 0 stands at byte `begin`, the last one ends before byte `end`.
struct NetcdfExtent {
  std::int64_t begin = 0, end = 0;
  std::int64_t stride = 0; ///< bytes from a record to the next; 0 without records
};

struct NetcdfLayout {
  std::int64_t header = 0; ///< bytes
  std::vector<NetcdfExtent> variables;
};

/// Reads the header of an open classic file (CDF-1, -2 or -5). The lengths that the library returns
/// lead to the offsets in the header (NetCDF Classic Format Specification, Unidata).
/// \pre the format is classic, the header is on the disk, and no other thread calls the library.
NetcdfLayout classic_layout(int id, const std::string& path);

/// Whether one of the variables, of so many bytes each, is too large for the 64-bit offset format.
bool needs_cdf5(const std::vector<std::int64_t>& variable_bytes);

} // namespace calotte::io_detail
