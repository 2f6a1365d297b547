// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/vtk_xml.h"

namespace calotte::io_detail {
namespace {

const VtkFlavour poly_data{
    .data_set = "PolyData",
    .cell_counts = "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"",
    .cells = "Polys",
    .types = false};

} // namespace

void put_vtp(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  put_vtk_triangles(sink, mesh, options, poly_data);
}

void put_vtp_cells(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  put_vtk_cells(sink, mesh, options, poly_data);
}

void put_vtp_cells(const Sink& sink, const Polygons& polygons, const WriteOptions& options) {
  put_vtk_cells(sink, polygons, options, poly_data);
}

} // namespace calotte::io_detail
