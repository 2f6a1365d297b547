// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/error.h>
#include <calotte/read.h>

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::tools {

/// Points with their line numbers, for messages.
struct PointFile {
  std::string name;
  Points3 points;
  std::vector<std::int64_t> lines;
};

/// Text (MPI-SCVT's SaveVertices is such), or the points of a mesh, see
/// names_of_read_meshes(), which have no lines.
/// \throws Error as read_points() and read_sites(); invalid_argument for a mesh in longitude and
/// latitude.
PointFile read_point_file(const std::string& path, bool lonlat);

/// Points of the plane, with z = 0: text, x y a line ("-" is standard input), or the points of a
/// mesh. \throws Error as read_points() and read_mesh(); invalid_argument for a mesh of the
/// sphere.
PointFile read_planar_point_file(const std::string& path);

/// Throws the error again; of one that names the column of a bad point with the line in the file
/// instead.
/// \param lines of the columns of the file `name`; empty if it has none.
[[noreturn]] void rethrow_with_line(const Error& error, const std::string& name,
                                    const std::vector<std::int64_t>& lines);

} // namespace calotte::tools
