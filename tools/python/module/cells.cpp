// SPDX-License-Identifier: GPL-3.0-or-later
#include "calls.h"
#include "members.h"
#include "module.h"

#include <calotte/check.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace calotte::python {
namespace {

void add_ranges(py::module_& module) {
  py::class_<ValueRange> range(module, "Range", "Extremes and mean of a quantity.");
  add_members(range, Member{"min", &ValueRange::min, "The least value."},
              Member{"mean", &ValueRange::mean, "The mean."},
              Member{"max", &ValueRange::max, "The greatest value."});
  py::class_<Percentiles> percentiles(
      module, "Percentiles", "Extremes of a quantity, and values that a percentage is not above.");
  add_members(percentiles, Member{"min", &Percentiles::min, "The least value."},
              Member{"p1", &Percentiles::p1, "1 percent are not above it."},
              Member{"p5", &Percentiles::p5, "5 percent are not above it."},
              Member{"p50", &Percentiles::p50, "The median."},
              Member{"p95", &Percentiles::p95, "95 percent are not above it."},
              Member{"p99", &Percentiles::p99, "99 percent are not above it."},
              Member{"max", &Percentiles::max, "The greatest value."});
}

void add_unit(py::module_& module) {
  py::class_<Unit> unit(module, "Unit", "A unit in which people read lengths and areas.");
  add_members(unit, Member{"name", &Unit::name, "Of lengths: km, degrees or radians."},
              Member{"of_radian", &Unit::of_radian, "The value of one radian."},
              Member{"area", &Unit::area, "Of areas: km^2 or steradians."},
              Member{"of_steradian", &Unit::of_steradian, "The value of one steradian."});
  module.def("unit_of",
             [](const std::optional<std::string>& units, std::optional<double> radius_km) {
               return call([&] { return unit_of(units, radius_km); });
             });
}

void add_quality(py::module_& module) {
  py::class_<Quality> quality(
      module, "Quality",
      "Measures of a mesh and its Voronoi cells, of quality().\n\n"
      "Lengths are radians and areas steradians of the unit sphere; in the plane they are in the\n"
      "unit of the points and its square. Of an open mesh, cells count where triangles surround\n"
      "them.",
      py::dynamic_attr());
  add_members(
      quality, Member{"cells", &Quality::cells, "Number of cells."},
      Member{"triangles", &Quality::triangles, "Number of triangles."},
      Member{
          "flat", &Quality::flat,
          "Number of triangles along an open boundary flatter than rounding; they do not count."},
      Member{"degrees", &Quality::degrees, "degrees[d]: number of cells with d neighbours."},
      Member{"spacing", &Quality::spacing,
             "Range of the distances between neighbours; radians, in the plane the points' unit."},
      Member{
          "sigma", &Quality::sigma,
          "Range over cells of the distance to the nearest neighbour over that to the farthest."},
      Member{"cell_quality", &Quality::cell_quality,
             "Range over cells of the shortest Voronoi edge over the longest."},
      Member{"cell_area", &Quality::cell_area,
             "Range of the cells' areas; steradians, in the plane the square of the points' unit."},
      Member{"triangle_quality", &Quality::triangle_quality,
             "Range of the triangles' quality; 1 if equilateral."},
      Member{"angles", &Quality::angles, "Range of the angles of the flat triangles, degrees."},
      Member{"obtuse", &Quality::obtuse, "Number of triangles with an angle above 90 degrees."},
      Member{"off_centring", &Quality::off_centring,
             "Range over edges of the distance between the midpoints of a Voronoi edge and of its "
             "Delaunay edge, over the length of the latter; above 1/2 they do not cross."},
      Member{"residual", &Quality::residual,
             "Root mean square distance of the sites from their cells' centroids, over the mean "
             "spacing."},
      Member{"energy", &Quality::energy,
             "Sum over the cells of the integral of density times squared distance from the site."},
      Member{"limit", &Quality::limit,
             "Energy times number of cells of a CVT of many cells (Gersho 1979)."},
      Member{"excess", &Quality::excess, "Energy times number of cells, over limit, minus 1."},
      Member{"dc_over_h", &Quality::dc_over_h,
             "Percentiles over edges of their length over the spacing that the density demands."},
      Member{"dv_over_dc", &Quality::dv_over_dc,
             "Range over edges of the length of the Voronoi edge over that of the Delaunay edge; "
             "0.577 for regular hexagons."},
      Member{"short_edges", &Quality::short_edges, "Number of edges with dv/dc below 0.18."},
      Member{"mismatched_edges", &Quality::mismatched_edges,
             "Number of edges with dc/h outside 0.75 to 1.4."},
      Member{"bad_cells", &Quality::bad_cells,
             "Number of cells with such an edge or with the centre of an obtuse triangle."},
      Member{"bad_spacing", &Quality::bad_spacing,
             "Range over these cells of the mean distance to their neighbours; unit of spacing."},
      Member{"cells_area", &Quality::cells_area,
             "Sum of the cells' areas over that of the sphere, in the plane of the domain."},
      Member{"triangles_area", &Quality::triangles_area,
             "Sum of the triangles' areas over that of the sphere; 0 in the plane."});
}

/// The ids of one list, in place.
py::object list_at(const py::object& self, std::int64_t i) {
  const auto& all = self.cast<const IdLists&>();
  const std::int64_t at = i < 0 ? i + all.size() : i;
  if (at < 0 || at >= all.size())
    throw py::index_error("there are " + std::to_string(all.size()) + " lists, and no " +
                          std::to_string(i));
  return view(all.items, self)[py::slice(all.begin[at], all.begin[at + 1], 1)];
}

void add_lists(py::module_& module) {
  py::class_<IdLists> lists(module, "IdLists",
                            "A list of ids for each cell or site: lists[i] is an array.");
  add_members(lists, Member{"ids", &IdLists::items, "All ids, list after list."},
              Member{"begin", &IdLists::begin, "(n + 1,) list i is ids[begin[i]:begin[i + 1]]."});
  lists.def("__len__", &IdLists::size).def("__getitem__", &list_at);
}

void add_voronoi(py::module_& module) {
  py::class_<Voronoi, std::shared_ptr<Voronoi>> cells(
      module, "Voronoi",
      "The Voronoi tessellation of a mesh, as a C-grid model staggers it, of voronoi().\n\n"
      "Cell i belongs to site i, vertex t is the centre of triangle t, and an edge is a pair of\n"
      "neighbours and the side between their cells. Ids are 0-based, -1 where there is none, and\n"
      "all orders are counter-clockwise. Lengths are radians and areas steradians of the unit\n"
      "sphere; in the plane they are in the unit of the points and its square, and z is 0.");
  add_members(
      cells,
      Member{"surface", &Voronoi::surface,
             "The Surface that the cells cover; in a plane its rings clip them."},
      Member{"cells", &Voronoi::cells, "(n, 3) sites; unit vectors on the sphere."},
      Member{"edges", &Voronoi::edges, "(e, 3) midpoints between neighbours."},
      Member{"vertices", &Voronoi::vertices, "(m, 3) corners of the cells."},
      Member{"edges_on_cell", &Voronoi::edges_on_cell, "Ids of edges, by cell; see begin.",
             "(n + 1,) cell i has the entries begin[i] to begin[i + 1] - 1 of edges_on_cell, "
             "vertices_on_cell and cells_on_cell."},
      Member{"vertices_on_cell", &Voronoi::vertices_on_cell,
             "Ids of vertices, by cell; see begin. Edge k lies between vertices k - 1 and k."},
      Member{"cells_on_cell", &Voronoi::cells_on_cell,
             "Ids of neighbours, by cell; see begin. Neighbour k is the cell across edge k."},
      Member{"cells_on_vertex", &Voronoi::cells_on_vertex, "(m, 3) the cells at a vertex."},
      Member{"edges_on_vertex", &Voronoi::edges_on_vertex,
             "(m, 3) the edges at a vertex; cell j lies between edges j and j + 1."},
      Member{"cells_on_edge", &Voronoi::cells_on_edge,
             "(e, 2) the lower and the higher cell; the normal points to the second."},
      Member{"vertices_on_edge", &Voronoi::vertices_on_edge,
             "(e, 2) the vertices to the right and to the left of the normal."},
      Member{"dc", &Voronoi::dc,
             "(e,) distance between the two cells; radians, in the plane the points' unit."},
      Member{"dv", &Voronoi::dv,
             "(e,) distance between the two vertices; radians, in the plane the points' unit."},
      Member{"angle", &Voronoi::angle,
             "(e,) angle of the normal from east, in the plane from x; radians."},
      Member{"cell_area", &Voronoi::cell_area,
             "(n,) areas of the cells; steradians, in the plane the square of the points' unit."},
      Member{"vertex_area", &Voronoi::vertex_area,
             "(m,) areas of the triangles; steradians, in the plane the square of the unit."},
      Member{"kites", &Voronoi::kites,
             "(m, 3) signed areas of the parts of a triangle nearest to each of its cells; "
             "steradians, in the plane the square of the points' unit."});
  module.def("voronoi", [](const Mesh& mesh) {
    return call([&] { return std::make_shared<Voronoi>(voronoi(mesh)); });
  });
}

/// The triangles alone of an open mesh of the sphere and of a channel.
Quality quality_of(const Mesh& mesh, const Density& density) {
  if (mesh.surface.is_sphere() ? mesh.closed() : std::isfinite(mesh.surface.area()))
    return quality(mesh, density);
  return count_edges(mesh).not_delaunay > 0 ? triangle_quality(mesh) : open_quality(mesh);
}

} // namespace

void add_cells(py::module_& module) {
  add_lists(module);
  add_voronoi(module);
  add_ranges(module);
  add_unit(module);
  add_quality(module);
  module.def("quality", [](const Mesh& mesh, const Density& density) {
    return call([&] { return quality_of(mesh, density); });
  });
}

} // namespace calotte::python
