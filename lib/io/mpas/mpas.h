// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/memory.h"
#include "io/bytes/text.h"
#include "io/cells/model_grid.h"
#include "io/cells/raw_mesh.h"
#include "io/mpas/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/io.h>
#include <calotte/limited_area.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <functional>
#include <string>

/// What the full and the minimal MPAS file have in common.
namespace calotte::io_detail {

/// A mesh as a file shall hold it. Unless it is whole before, all but its cells is computed while
/// the file is written, and places are not stored. Writing frees arrays after their last use.
struct MpasMesh {
  Voronoi& voronoi; ///< begun, or whole
  Points3 places;   ///< 3 x n: of the cells, radius times the unit vectors; 3 x 0 in a plane
  double radius;    ///< of the sphere; 1 in a plane
  std::function<void()> connect = {}; ///< voronoi; empty if that is whole
  Array<double> surplus = {};         ///< of begin_measures(), unless voronoi is whole
  DoubleVector density = {};          ///< as density_of()

  bool whole() const { return !connect; }
  const Points3& sites() const { return voronoi.on_sphere ? places : voronoi.cells; }
  std::int64_t edges() const {
    return whole() ? voronoi.cells_on_edge.cols() : voronoi.cells_on_vertex.size() / 2;
  }
};

/// One of the three kinds of places.
struct MpasKind {
  std::string name;  ///< ends the names of its variables
  std::string word;  ///< for one of it
  std::string place; ///< where it is
};
inline const MpasKind mpas_cell{"Cell", "cell", "the cells' generators"};
inline const MpasKind mpas_edge{"Edge", "edge",
                                "the edges, where those between cells and vertices cross"};
inline const MpasKind mpas_vertex{"Vertex", "vertex", "the vertices"};

/// The attributes of a variable. \param standard_name of the CF conventions, or "".
NetcdfAttributes described(const std::string& units, const std::string& long_name,
                           const std::string& standard_name = "");

/// A file with the attributes of its kind and those that tell of the mesh.
class MpasFile : public GridFile {
public:
  /// \throws Error file.
  MpasFile(const std::string& path, const MpasMesh& mesh, const WriteOptions& options);
};

/// The dimensions, and the variables that describe a mesh.
const NetcdfMeshNames& mpas_names();

/// 16 hexadecimal digits that differ where meshes do.
std::string fingerprint(const MpasMesh& mesh);

/// The same for a part of a mesh. \param kept 0-based ids of its cells. \param parent of the mesh.
std::string fingerprint(const Array<std::int32_t>& kept, const std::string& parent);

/// NAME.graph.info for NAME.nc.
std::string graph_path(const std::string& path);

/// The text of a graph.info file, as METIS reads it: the numbers of cells and of edges, then a
/// line of each cell's neighbours, 1-based. It comes in pieces.
void put_graph(const Sink& sink, const Voronoi& voronoi);
/// The same. \param cells_on_cell -1 for a missing neighbour.
void put_graph(const Sink& sink, const IdLists& cells_on_cell, std::int64_t edges);

// ---- Whole files. \throws Error invalid_argument, file.

/// The mesh is consumed: its arrays are reused, and freed after their last use.
void write_mpas(const std::string& path, Mesh mesh, const WriteOptions& options);
/// A whole tessellation, which may be open. \param places of its cells: radius times the unit
/// vectors; in a plane 3 x 0.
void write_mpas(const std::string& path, Voronoi voronoi, Points3 places,
                const WriteOptions& options);
void write_mpas_minimal(const std::string& path, Mesh mesh, const WriteOptions& options);

/// Whether an open file is of MPAS.
bool is_mpas(const NetcdfReader& file);
/// \pre it is. \throws Error parse, file.
RawMesh read_mpas(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
Points3 read_mpas_sites(const NetcdfReader& file); ///< without a look at the triangles
bool is_planar_mpas(const NetcdfReader& file);

} // namespace calotte::io_detail
