// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/vtk_xml.h"

namespace calotte::io_detail {
namespace {

const VtkFlavour unstructured_grid{.data_set = "UnstructuredGrid",
                                   .cell_counts = "NumberOfCells=\"",
                                   .cells = "Cells",
                                   .types = true};

} // namespace

void put_vtu(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  put_vtk_triangles(sink, mesh, options, unstructured_grid);
}

void put_vtu_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  put_vtk_cells(sink, mesh, options, unstructured_grid);
}

void put_vtu_cells(const Sink& sink, const Polygons& polygons, const WriteOptions& options) {
  put_vtk_cells(sink, polygons, options, unstructured_grid);
}

} // namespace calotte::io_detail
