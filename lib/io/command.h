// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/export.h>
#include <calotte/mesh_file.h>
#include <calotte/surface.h>
#include <calotte/write.h>

#include <string>
#include <string_view>

/// What the library knows of files and formats for its command. The header is not installed; of lib
/// it is all that tools includes.
CALOTTE_API_BEGIN
namespace calotte {

/// Reads all bytes of a file.
/// \throws Error file.
std::string read_file(const std::string& path);

/// Writes bytes to a file, which is complete or absent, as with write().
/// \throws Error file.
void write_file(const std::string& path, std::string_view bytes);

/// Whether a regular file starts as NetCDF files do, classic or HDF5; false for any other path.
/// \throws Error file.
bool is_netcdf_file(const std::string& path);

/// Whether the format of a file that was read is one of NetCDF, where lengths are in metres.
bool is_netcdf(const MeshFile& file);

/// Throws unless write() supports meshes of a plane in the format.
/// \param path for the message.
/// \param format not by_name.
/// \throws Error invalid_argument.
void require_planar_format(const std::string& path, const Surface& plane, Format format);

} // namespace calotte
CALOTTE_API_END
