// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

#include <calotte/export.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/raster.h>
#include <calotte/surface.h>
#include <calotte/widths.h>
#include <calotte/write.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// What the library knows of files and formats for its command. The header is not installed; of lib
/// it and io/toml.h are all that tools includes.
CALOTTE_API_BEGIN
namespace calotte {

/// Reads all bytes of a file.
/// \throws Error file.
std::string read_file(const std::string& path);

/// Writes bytes to a file, which is complete or absent, as with write().
/// \throws Error file.
void write_file(const std::string& path, std::string_view bytes);

/// The text files of MPAS-Tools' culler with option -c. Forward has a line for each cell of a
/// source: the 0-based id in the new mesh, or -1. Backward has one for each cell of the new mesh.
struct CellMapPaths {
  std::string forward, backward; ///< empty for no folder
};
CellMapPaths cell_map_paths(const std::string& folder);

/// Both, complete under temporary names until they are committed.
class CellMapFiles {
public:
  /// \throws Error file.
  CellMapFiles(const CellMapPaths& paths, const Ids& new_of_old, const Ids& old_of_new);
  ~CellMapFiles(); ///< removes what was not committed
  CellMapFiles(const CellMapFiles&) = delete;
  CellMapFiles& operator=(const CellMapFiles&) = delete;
  /// \throws Error file.
  void commit();

private:
  struct Files;
  std::unique_ptr<Files> files_;
};

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

/// The lines of a GeoJSON file, as read_lines() has them; none of another path, and of a file of
/// other geometries. \throws Error parse, also for lines beside other geometries; file.
std::vector<Points3> lines_in(const std::string& path, const Surface& surface);

/// Whether a file of cell widths holds rules, by its suffix, .toml in any case.
bool holds_rules(const std::string& path);

/// The files that a file of rules names, read by itself. \throws Error parse; file.
std::vector<std::string> files_of_rules(const std::string& path);

// ---- Files of JIGSAW (.msh), whose lengths have one unit of any kind

/// What a mesh is made of.
struct JigsawGeometry {
  Surface surface;   ///< the sphere, or the part of a plane between the closed rings of its edges
  double radius = 1; ///< of the sphere
  double extent = 2; ///< the mean side of the box around it
  /// Its other edges and points, which the mesh follows: on the sphere directions, in a plane x y
  /// 0.
  std::vector<Points3> lines;
};

/// Reads the geometry of an ellipsoid-mesh, or of a euclidean-mesh of NDIMS=2.
/// \throws Error parse: radii that differ, another kind, a plane without a closed ring of edges; as
///         read_domain(); file.
JigsawGeometry read_jigsaw_geometry(const std::string& path);

/// How widths of a file are taken: times a factor, then within bounds.
struct JigsawSizes {
  double scale = 1;
  double least = 0, most = 0; ///< least <= most
};

/// Reads cell widths, which may be 0 where the least one is not. \throws Error as
/// read_cell_width().
Raster read_jigsaw_widths(const std::string& path, const JigsawSizes& sizes,
                          const Surface& surface);

/// Points of a mesh of any kind, 3 x n, and whether the tag of each fixes it.
struct JigsawPoints {
  Points3 points;
  std::vector<bool> fixed;
};

/// \param plane whether they are x y of a plane, and not directions.
/// \throws Error parse; file.
JigsawPoints read_jigsaw_points(const std::string& path, bool plane);

/// Lowers the values of a grid to the largest ones whose gradient is at most its SLOPE, which is
/// one number, see limit_gradient(), and writes the file anew, with the same nodes. \param radius
/// of the sphere, if the file gives none. \throws Error parse; file.
void limit_jigsaw_values(const std::string& path, double radius);

} // namespace calotte
CALOTTE_API_END
