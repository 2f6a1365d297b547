// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "io/bytes/text.h"
#include "io/cells/model_grid.h"
#include "io/cells/raw_mesh.h"
#include "io/mpas/mpas_variables.h"
#include "io/mpas/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/limited_area.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// Common code for full and minimal MPAS files.
namespace calotte::io_detail {

/// A mesh in the form in which it is written. If it is not whole, everything but its cells is
/// computed while the file is written, and coordinates of vertices and edges are not stored.
/// Writing frees arrays after their last use.
struct MpasMesh {
  Voronoi& voronoi; ///< with cells only, or whole
  Points3 points;   ///< 3 x n: generators, radius times unit vectors; 3 x 0 in a plane
  double radius;    ///< of the sphere; 1 in a plane
  std::function<void()> connect = {}; ///< completes voronoi; empty if that is whole
  Array<double> surplus = {};         ///< result of begin_measures(), unless voronoi is whole
  DoubleVector density = {};          ///< as from density_at_cells()

  bool whole() const { return !connect; }
  const Points3& sites() const { return voronoi.surface.is_sphere() ? points : voronoi.cells; }
  std::int64_t edges() const {
    return whole() ? voronoi.cells_on_edge.cols() : voronoi.cells_on_vertex.size() / 2;
  }
};

/// Receives variables of the table with the same number of rows, and their contents, which are
/// computed together. It writes them to a file, or compares them with a file.
using MpasSink = std::function<void(const std::vector<std::string>& names,
                                    const NetcdfWriter::GroupFill& contents)>;

inline void put(const MpasSink& sink, const std::string& name,
                const NetcdfWriter::Fill<std::int32_t>& contents) {
  sink({name}, [contents](std::int64_t begin, std::int64_t end, std::int32_t* const* ints,
                          double* const*) { contents(begin, end, ints[0]); });
}
inline void put(const MpasSink& sink, const std::string& name,
                const NetcdfWriter::Fill<double>& contents) {
  sink({name}, [contents](std::int64_t begin, std::int64_t end, std::int32_t* const*,
                          double* const* doubles) { contents(begin, end, doubles[0]); });
}

/// Puts the variables that the table has a function for. The mesh must outlive its use by the sink.
void put_values(const MpasSink& sink, const MpasMesh& mesh);

/// Puts all variables that follow from a whole mesh. The mesh must outlive its use by the sink.
/// \param order of verticesOnCell.
void put_variables(const MpasSink& sink, const MpasMesh& mesh, VertexOrder order);

/// An MPAS file with the attributes of its kind and of the mesh. Its variables are rows of the
/// table of MPAS variables.
class MpasFile : public NetcdfGridFile {
public:
  /// \throws Error file.
  MpasFile(const std::string& path, const MpasMesh& mesh, const WriteOptions& options);

  void define(MpasDimension dimension, std::int64_t size);
  int id_of(MpasDimension dimension) const { return ids_.at(dimension); }

  Announced announced(const std::string& name) const;
  /// Declares the variables that it receives. The file must outlive it.
  MpasSink sink();
  VertexOrder vertex_order() const { return vertex_order_; }

private:
  std::map<MpasDimension, int> ids_;
  VertexOrder vertex_order_;
};

/// 16 hexadecimal digits that differ between different meshes.
std::string fingerprint(const MpasMesh& mesh);

/// The same for a part of a mesh.
/// \param kept 0-based ids of its cells.
/// \param parent fingerprint of the mesh.
std::string fingerprint(const Array<std::int32_t>& kept, const std::string& parent);

/// NAME.graph.info for NAME.nc.
std::string graph_path(const std::string& path);

/// Puts the text of a graph.info file for METIS: the numbers of cells and edges, then a line for
/// each cell with its neighbours, 1-based. The text comes in pieces.
void put_graph(const Sink& sink, const Voronoi& voronoi);
/// The same.
/// \param cells_on_cell -1 for a missing neighbour.
void put_graph(const Sink& sink, const IdLists& cells_on_cell, std::int64_t edges);

// ---- Whole files. \throws Error invalid_argument, file.

/// The mesh is consumed: its arrays are reused, and freed after their last use.
void write_mpas(const std::string& path, Mesh mesh, const WriteOptions& options);
/// Writes a whole tessellation, which may be open.
/// \param points generators: radius times unit vectors; 3 x 0 in a plane.
void write_mpas(const std::string& path, Voronoi voronoi, Points3 points,
                const WriteOptions& options);
void write_mpas_minimal(const std::string& path, Mesh mesh, const WriteOptions& options);

/// Whether an open file is an MPAS file.
bool is_mpas(const NetcdfReader& file);
/// \pre is_mpas(file). \throws Error parse, file.
RawMesh read_mpas(const NetcdfReader& file, FieldChoice choice = FieldChoice::all);
Points3 read_mpas_sites(const NetcdfReader& file); ///< does not read the triangles
bool is_planar_mpas(const NetcdfReader& file);

} // namespace calotte::io_detail
