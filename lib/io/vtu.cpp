// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk_xml.h"

namespace calotte::detail {
namespace {

const VtkFlavour unstructured_grid{.data_set = "UnstructuredGrid",
                                   .cell_counts = "NumberOfCells=\"",
                                   .cells = "Cells",
                                   .types = true};

} // namespace

void put_vtu(const Sink& sink, const Mesh& mesh) { put_vtk(sink, mesh, unstructured_grid); }

Soup get_vtu(std::istream& in, const std::string& name) {
  return get_vtk(in, name, unstructured_grid);
}

} // namespace calotte::detail
