// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <memory>
#include <optional>

namespace calotte::python {
namespace {

using Cells = py::class_<Voronoi, std::shared_ptr<Voronoi>>;

/// A read-only property over an array of the tessellation.
template <class Member> void add_array(Cells& cells, const char* name, Member member) {
  cells.def_property_readonly(
      name, [member](py::object self) { return view(self.cast<const Voronoi&>().*member, self); });
}

template <class... Arguments> std::shared_ptr<Voronoi> cells_of(const Arguments&... arguments) {
  return call([&] { return std::make_shared<Voronoi>(voronoi(arguments...)); });
}

void add_ranges(py::module_& module) {
  py::class_<Range>(module, "Range")
      .def_readonly("min", &Range::min)
      .def_readonly("mean", &Range::mean)
      .def_readonly("max", &Range::max)
      .def("__repr__", [](const Range& range) {
        return py::str("Range(min={}, mean={}, max={})").format(range.min, range.mean, range.max);
      });
  py::class_<Percentiles>(module, "Percentiles")
      .def_readonly("min", &Percentiles::min)
      .def_readonly("p1", &Percentiles::p1)
      .def_readonly("p5", &Percentiles::p5)
      .def_readonly("p50", &Percentiles::p50)
      .def_readonly("p95", &Percentiles::p95)
      .def_readonly("p99", &Percentiles::p99)
      .def_readonly("max", &Percentiles::max);
}

void add_quality(py::module_& module) {
  py::class_<Quality>(module, "Quality")
      .def_readonly("cells", &Quality::cells)
      .def_readonly("triangles", &Quality::triangles)
      .def_property_readonly(
          "degrees",
          [](py::object self) { return view(self.cast<const Quality&>().degrees, self); })
      .def_readonly("spacing", &Quality::spacing)
      .def_readonly("sigma", &Quality::sigma)
      .def_readonly("cell_quality", &Quality::cell_quality)
      .def_readonly("cell_area", &Quality::cell_area)
      .def_readonly("triangle_quality", &Quality::triangle_quality)
      .def_readonly("angles", &Quality::angles)
      .def_readonly("obtuse", &Quality::obtuse)
      .def_readonly("off_centring", &Quality::off_centring)
      .def_readonly("residual", &Quality::residual)
      .def_readonly("energy", &Quality::energy)
      .def_readonly("limit", &Quality::limit)
      .def_readonly("excess", &Quality::excess)
      .def_readonly("dc_over_h", &Quality::dc_over_h)
      .def_readonly("dv_over_dc", &Quality::dv_over_dc)
      .def_readonly("short_edges", &Quality::short_edges)
      .def_readonly("unfit_edges", &Quality::unfit_edges)
      .def_readonly("bad_cells", &Quality::bad_cells)
      .def_readonly("cells_area", &Quality::cells_area)
      .def_readonly("triangles_area", &Quality::triangles_area);
}

} // namespace

void add_cells(py::module_& module) {
  Cells cells(module, "Voronoi");
  cells.def_readonly("on_sphere", &Voronoi::on_sphere);
  add_array(cells, "period", &Voronoi::period);
  add_array(cells, "cells", &Voronoi::cells);
  add_array(cells, "edges", &Voronoi::edges);
  add_array(cells, "vertices", &Voronoi::vertices);
  add_array(cells, "begin", &Voronoi::begin);
  add_array(cells, "edges_on_cell", &Voronoi::edges_on_cell);
  add_array(cells, "vertices_on_cell", &Voronoi::vertices_on_cell);
  add_array(cells, "cells_on_cell", &Voronoi::cells_on_cell);
  add_array(cells, "cells_on_vertex", &Voronoi::cells_on_vertex);
  add_array(cells, "edges_on_vertex", &Voronoi::edges_on_vertex);
  add_array(cells, "cells_on_edge", &Voronoi::cells_on_edge);
  add_array(cells, "vertices_on_edge", &Voronoi::vertices_on_edge);
  add_array(cells, "dc", &Voronoi::dc);
  add_array(cells, "dv", &Voronoi::dv);
  add_array(cells, "angle", &Voronoi::angle);
  add_array(cells, "cell_area", &Voronoi::cell_area);
  add_array(cells, "vertex_area", &Voronoi::vertex_area);
  add_array(cells, "kites", &Voronoi::kites);
  module.def("voronoi", &cells_of<Mesh>);
  module.def("voronoi", &cells_of<PlanarMesh>);
  module.def("voronoi", &cells_of<PlanarMesh, PlanarDomain>);
  add_ranges(module);
  add_quality(module);
  module.def("quality", [](const Mesh& mesh, const Density& density) {
    return call([&] { return mesh.closed() ? quality(mesh, density) : open_quality(mesh); });
  });
  module.def("quality",
             [](const PlanarMesh& mesh, const PlanarDomain& domain, const Density& density) {
               return call([&] { return quality(mesh, domain, density); });
             });
}

} // namespace calotte::python
