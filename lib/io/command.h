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
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Functions on files and formats that the command uses. The header is not installed. Tools include
/// only this header, io/toml.h and the headers of messages from lib/.
CALOTTE_API_BEGIN
namespace calotte {

/// Reads all bytes of a file of any kind.
/// \throws Error file.
std::string read_file(const std::string& path);

/// Writes bytes to a file, which is complete or absent, as with write().
/// \throws Error file.
void write_file(const std::string& path, std::string_view bytes);

/// Cell widths above it, in km, may be metres: a coarser grid of the Earth has fewer than 150
/// cells.
inline constexpr double widest_in_km = 2000;

/// The file that a word of read_region() names; empty if it names none.
std::string region_file(const std::string& word);

/// The word of read_region() whose file, if it names one, is relative to a folder.
std::string region_beside(const std::string& folder, const std::string& word);

/// The text files of MPAS-Tools' culler with option -c. Forward has a line for each cell of a
/// source: the 0-based id in the new mesh, or -1. Backward has one for each cell of the new mesh.
struct CellMapPaths {
  std::string forward, backward; ///< both empty if no folder is given
};
CellMapPaths cell_map_paths(const std::string& folder);

/// Both files. They are complete under temporary names until commit() renames them.
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

/// Names of the fields of a file with depths and an open boundary, by which a conversion finds
/// them.
inline constexpr const char *depth_field = "depth", *open_field = "open";

/// Whether a regular file starts as NetCDF files do, classic or HDF5; false for any other path.
/// \throws Error file.
bool is_netcdf_file(const std::string& path);

/// Whether a file was read from a NetCDF format. Lengths are in metres there.
bool is_netcdf(const MeshFile& file);

/// The points of a mesh's file, and where they are.
struct SitesOfFile {
  Points3 points;  ///< 3 x n, in a plane with z = 0
  Surface surface; ///< the sphere, or a plane with its period, but without its boundary
};

/// As read_sites(), of a plane, too.
SitesOfFile read_sites_and_surface(const std::string& path);

/// Throws unless write() supports meshes of a plane in the format.
/// \param path for the message.
/// \param format not by_name.
/// \throws Error invalid_argument.
void require_planar_format(const std::string& path, const Surface& plane, Format format);

/// The lines of a GeoJSON file, as read_lines() returns them. None for a path of another format,
/// and for a file without lines.
/// \throws Error parse, also for a file that mixes lines with other geometries; file.
std::vector<Points3> lines_in(const std::string& path, const Surface& surface);

/// Whether a file of cell widths contains rules: its suffix is .toml, in any case.
bool has_rules(const std::string& path);

/// Paths of the files that a file of rules names.
/// \throws Error parse; file.
std::vector<std::string> files_of_rules(const std::string& path);

// ---- Files of JIGSAW (.msh), whose lengths have one unit of any kind

/// The input geometry of a mesh.
struct JigsawGeometry {
  Surface surface;   ///< the sphere, or the part of a plane between the closed rings of its edges
  double radius = 1; ///< of the sphere
  double extent = 2; ///< mean side of the bounding box
  /// The other edges and points, which the mesh follows: directions on the sphere, x y 0 in a
  /// plane.
  std::vector<Points3> lines;
};

/// Reads the geometry of an ellipsoid-mesh, or of a euclidean-mesh of NDIMS=2.
/// \throws Error parse: radii that differ, another kind, a plane without a closed ring of edges; as
///         read_domain(); file.
JigsawGeometry read_jigsaw_geometry(const std::string& path);

/// The conversion of widths in a file: they are multiplied by a factor, then clamped to bounds.
struct JigsawSizes {
  double scale = 1;
  double least = 0, most = 0; ///< least <= most
};

/// Reads cell widths. A width of 0 is accepted if `least` is positive.
/// \throws Error as read_cell_width().
Raster read_jigsaw_widths(const std::string& path, const JigsawSizes& sizes,
                          const Surface& surface);

/// Points of a mesh of any kind, 3 x n, and whether the tag of each fixes it.
struct JigsawPoints {
  Points3 points;
  std::vector<bool> fixed;
};

/// \param plane whether the points are x y of a plane; otherwise they are directions.
/// \throws Error parse; file.
JigsawPoints read_jigsaw_points(const std::string& path, bool plane);

/// Limits the gradients of a grid's values to its SLOPE, which is one number; see limit_gradient().
/// Writes the result to the same file, with the same nodes.
/// \param radius of the sphere, if the file gives none.
/// \throws Error parse; file.
void limit_jigsaw_values(const std::string& path, double radius);

} // namespace calotte
CALOTTE_API_END
