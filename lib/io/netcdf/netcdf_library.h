// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/room.h"

#include <mutex>
#include <string>

/// Requirements for calls of the NetCDF C library.
namespace calotte::io_detail {

/// The C library has tables without locks; a caller must hold this lock.
std::mutex& netcdf_mutex();

/// A path in the form that the C library expects: it interprets names like http://... as addresses,
/// and skips leading blanks.
std::string netcdf_path(const std::string& path);

/// Returns if a result code of the C library says that the file is damaged, or none.
/// \throws Error file for an error of the system; std::bad_alloc without memory.
void require_system(const std::string& path, int code);

} // namespace calotte::io_detail
