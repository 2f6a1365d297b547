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
  Points3 points;                       ///< in a plane with z = 0
  std::vector<std::int64_t> lines = {}; ///< of text
  Surface surface = {}; ///< of text by its columns, of a mesh its own, without a boundary
};

/// Text (MPI-SCVT's SaveVertices is such; "-" is standard input), or the points of a mesh, see
/// names_of_read_meshes(), which knows itself where they are.
/// \param columns of text.
/// \throws Error as read_points() and read_sites(); invalid_argument for a mesh in longitude and
///         latitude, and for one of the sphere where x and y are asked for.
PointFile read_point_file(const std::string& path, Columns columns);

/// The columns of --plane and --lonlat.
inline Columns columns_of(bool plane, bool lonlat) {
  return plane ? Columns::xy : lonlat ? Columns::lonlat : Columns::xyz;
}

/// Throws the error again; of one that names the column of a bad point with the line in the file
/// instead.
/// \param lines of the columns of the file `name`; empty if it has none.
[[noreturn]] void rethrow_with_line(const Error& error, const std::string& name,
                                    const std::vector<std::int64_t>& lines);

} // namespace calotte::tools
