// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <mutex>
#include <string>

/// What whoever calls the NetCDF C library has to know.
namespace calotte::io_detail {

/// The C library keeps tables without locks: whoever calls it holds this.
std::mutex& netcdf_mutex();

/// A path as the C library expects it: it takes names like http://... for addresses, and skips
/// leading blanks.
std::string netcdf_path(const std::string& path);

} // namespace calotte::io_detail
