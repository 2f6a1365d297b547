// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/formats.h"
#include "io/formats/room.h"

#include <calotte/voronoi.h>

/// Writes XML files of VTK with appended raw blocks, each after its length as UInt64. This is the
/// common part of PolyData (.vtp) and UnstructuredGrid (.vtu).
namespace calotte::io_detail {

/// The differences between the two.
struct VtkFlavour {
  std::string data_set; ///< the name of the data set's element
  std::string
      cell_counts;   ///< attributes of Piece that count the cells, up to the number of those here
  std::string cells; ///< the element with connectivity and offsets
  bool types;        ///< whether a UInt8 type of each cell follows
};

/// An array, as announced in the head.
struct VtkArray {
  std::string element; ///< the element that contains it and arrays next to it
  std::string type, name;
  std::int64_t tuples = 0;
  int components = 1;

  std::int64_t bytes() const;
};

/// The contents of the head of a file.
struct VtkHead {
  VtkFlavour flavour;
  std::int64_t points = 0, cells = 0;
  std::vector<VtkArray> arrays;
};

/// Writes the bytes of an array.
using VtkContent = std::function<void(Writer&)>;

/// \param contents of the head's arrays.
void put_vtk(const Sink& sink, const VtkHead& head, const std::vector<VtkContent>& contents);

/// Adds CellFields as arrays of an element, and their contents. The fields must outlive the
/// contents.
void add_field_arrays(const std::string& element, std::int64_t cells, VtkHead& head);
void add_field_contents(const CellFields& fields, std::vector<VtkContent>& contents);
/// Adds fields of one location as Float64 arrays of an element, and their contents. Fields with the
/// name of an earlier array are left out. The fields must outlive the contents.
void add_fields(const std::string& element, const std::vector<MeshField>& fields,
                FieldLocation location, VtkHead& head, std::vector<VtkContent>& contents);
/// Adds points as Float64. They must outlive the contents.
void add_points(std::int64_t points, VtkHead& head);
VtkContent make_content(const Points3& points);
/// Adds connectivity, offsets and types of cells with `corners` corners in total.
void add_cells(std::int64_t corners, VtkHead& head);

// ---- The two kinds of files, a file for each

/// Triangles, with the CellFields at the points of a closed mesh.
void put_vtk_triangles(const Sink& sink, const Mesh& mesh, const WriteOptions& options,
                       const VtkFlavour& flavour);

/// Voronoi cells as polygons with their CellFields and sites, on the sphere of the sites if these
/// stand on one; at each point, a corner of cells, the three sites of its triangle.
void put_vtk_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options,
                   const VtkFlavour& flavour);
/// Polygons with their areas and numbers of corners, on the unit sphere.
void put_vtk_cells(const Sink& sink, const Polygons& polygons, const WriteOptions& options,
                   const VtkFlavour& flavour);

} // namespace calotte::io_detail
