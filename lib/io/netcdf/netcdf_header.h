// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/room.h"

#include <cstdint>
#include <string>
#include <vector>

/// The headers of the classic formats: whether they are sound, and the positions of the variables'
/// values, which the C library does not provide.
namespace calotte::io_detail {

/// A classic file's variable: value 0 stands at byte `begin`, the last one ends before byte `end`.
struct NetcdfExtent {
  std::string name = {};
  std::int64_t begin = 0, end = 0;
  std::int64_t stride = 0; ///< bytes from a record to the next; 0 without records
};

struct NetcdfLayout {
  std::int64_t header = 0; ///< bytes
  std::vector<NetcdfExtent> variables;
};

/// Whether a file begins as CDF-1, -2 or -5 does. \throws Error file.
bool is_classic_netcdf(const std::string& path);

/// Reads the header of a classic file (NetCDF Classic Format Specification, Unidata). The C library
/// can crash on a damaged header, and must open only files that pass here.
/// \pre is_classic_netcdf().
/// \throws Error parse for a header that is cut short or damaged, with its byte;
/// file.
NetcdfLayout classic_layout(const std::string& path);

/// Whether one of the variables, of so many bytes each, is too large for the 64-bit offset format.
bool needs_cdf5(const std::vector<std::int64_t>& variable_bytes);

} // namespace calotte::io_detail
