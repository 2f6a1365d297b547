// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/export.h>
#include <calotte/mesh_file.h>
#include <calotte/progress.h>
#include <calotte/rotation.h>

#include <string>
#include <vector>

/// Files of meshes that are rotated to where they are needed.
CALOTTE_API_BEGIN
namespace calotte {

/// The names of a file's fields, by what a rotation makes of them.
struct TurnedFields {
  /// Directions, which turn with the mesh: zonal and meridional components of one vector, which
  /// their names, long_name or standard_name show (zonal, eastward; meridional, northward);
  /// Cartesian components in three fields whose names end in X, Y and Z; and what MPAS stores of
  /// directions, such as localVerticalUnitVectors. They stay where a component has no value. And
  /// components along the normals and tangents of edges, which turn with these, and so keep their
  /// values: see MeshField::directed.
  std::vector<std::string> turned;
  /// Parameters of Coriolis (fCell, fEdge, fVertex) that were 2 Omega sin(latitude) within 1e-6,
  /// and are so at the new latitudes, with the same Omega.
  std::vector<std::string> coriolis;
  /// All other fields: they have the values of where they were.
  std::vector<std::string> moved;
  /// Directions of which a component is missing, tensors, and parameters of Coriolis that are other
  /// functions, and not constant: they have the values of where they were, which are wrong there.
  std::vector<std::string> unturned;
};

/// A file after a rotation.
struct RotatedFile {
  MeshFile file;       ///< its mesh, polygons and fields; sites, cells and edges in the old order
  TurnedFields fields; ///< by what became of them
};

/// Rotates the contents of a file: the points of its mesh and polygons, and the directions among
/// its fields. All else stays. Directions at edges and at triangles turn where the mesh is closed.
/// \throws Error invalid_argument for a plane; as rotated(mesh), voronoi().
RotatedFile rotated(MeshFile file, const Rotation& rotation);

/// Options of rotate().
struct RotateOptions {
  std::string history = {}; ///< how the file was made; precedes that of the source
  /// Stage: write. A cancelled run leaves no file. Default: none.
  ProgressCallback progress = {};
};

/// The result of rotate().
struct RotateReport {
  TurnedFields fields; ///< by what became of them
  /// Variables of the source that the new file lacks: strings and user-defined types.
  std::vector<std::string> left_out;
};

/// Rotates an MPAS file of the sphere, of which it may cover a part. The new file has all variables
/// and attributes of the source. The coordinates of cells, edges and vertices, angleEdge and what
/// TurnedFields says are computed; in single precision, if the source has them so. All others keep
/// their bits: ids, connectivity, lengths, areas, weights, density, masks and scalar fields. With
/// the identity all do.
///
/// NAME.graph.info is written beside NAME.nc. Both are complete or absent.
/// \throws Error invalid_argument for a source that holds no mesh of the sphere with connectivity;
///         parse; cancelled; file.
RotateReport rotate(const std::string& source, const std::string& target, const Rotation& rotation,
                    const RotateOptions& options = {});

} // namespace calotte
CALOTTE_API_END
