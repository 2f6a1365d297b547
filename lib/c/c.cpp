// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/c.h>

#include "c/guard.h"
#include "c/mesh.h"
#include "c/recipe.h"

#include <calotte/area_weights.h>
#include <calotte/check.h>
#include <calotte/delaunay.h>
#include <calotte/locate.h>
#include <calotte/read.h>
#include <calotte/remap.h>
#include <calotte/version.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

struct calotte_cells {
  calotte::Voronoi cells;
};

struct calotte_locator {
  calotte::Locator locator;
  int rows; ///< of positions
  int64_t sites;
};

namespace calotte {
namespace c_detail {

void require_output(calotte_mesh** mesh) {
  require(mesh != nullptr, "the pointer that receives the mesh is null; give the address of one");
}

void hand_over(Mesh&& made, calotte_mesh** mesh) {
  Points2 planar;
  if (!made.surface.is_sphere())
    planar = made.points.topRows<2>();
  *mesh = new calotte_mesh{std::move(made), std::move(planar)};
}

const Mesh& mesh_of(const calotte_mesh* mesh) {
  require(mesh != nullptr, "the mesh is a null pointer; give one that a function made");
  return mesh->mesh;
}

namespace {

int rows_of(const Surface& surface) { return surface.is_sphere() ? 3 : 2; }

CheckReport run_check(const Mesh& mesh) {
  const bool part = mesh.surface.is_sphere() && mesh.surface.is_bounded();
  return part ? check_surface(mesh) : check(mesh);
}

/// Copies values unless the caller does not want them.
template <class Values> void copy(const Values& values, typename Values::Scalar* out) {
  if (out != nullptr)
    std::copy_n(values.data(), values.size(), out);
}

const calotte_locator& locator_of(const calotte_locator* locator) {
  require(locator != nullptr, "the locator is a null pointer; give that of calotte_locator_make()");
  return *locator;
}

} // namespace
} // namespace c_detail
} // namespace calotte

using namespace calotte;
using namespace calotte::c_detail;

const char* calotte_version(void) { return CALOTTE_VERSION; }

void calotte_set_threads(int count) { set_threads(count); }

void calotte_mesh_free(calotte_mesh* mesh) { delete mesh; }

calotte_status calotte_delaunay(const double* points, int64_t n, const calotte_surface* surface,
                                calotte_mesh** mesh, calotte_error* error) {
  return guarded(error, [&] {
    require_output(mesh);
    const Surface where = surface_of(surface);
    require(!where.is_sphere() || !where.is_bounded(),
            "points on the sphere are triangulated on the whole of it; leave out the rings");
    hand_over(delaunay(points_of(points, n, rows_of(where), "the points"), where), mesh);
  });
}

calotte_status calotte_mesh_view(const calotte_mesh* mesh, calotte_triangulation* view,
                                 calotte_error* error) {
  return guarded(error, [&] {
    const Mesh& made = mesh_of(mesh);
    const bool sphere = made.surface.is_sphere();
    fill(view,
         {0, rows_of(made.surface), made.points.cols(), made.triangles.cols(),
          sphere ? made.points.data() : mesh->planar_points.data(), made.triangles.data(),
          made.neighbours.data(), std::ssize(made.site_of_input), made.site_of_input.data()},
         "calotte_triangulation");
  });
}

calotte_status calotte_check(const calotte_mesh* mesh, calotte_error* error) {
  return guarded(error, [&] {
    const CheckReport result = run_check(mesh_of(mesh));
    require(result.passed(), result.failure);
  });
}

calotte_status calotte_locate(const calotte_mesh* mesh, const double* positions, int64_t n,
                              int32_t* triangles, double* weights, int32_t* nearest,
                              calotte_error* error) {
  return guarded(error, [&] {
    const Mesh& made = mesh_of(mesh);
    const auto points = points_of(positions, n, rows_of(made.surface), "the positions");
    const Locations found = locate(made, points);
    copy(found.triangle, triangles);
    copy(found.weights, weights);
    copy(found.nearest, nearest);
  });
}

void calotte_locator_free(calotte_locator* locator) { delete locator; }

calotte_status calotte_locator_make(const calotte_mesh* mesh, calotte_locator** locator,
                                    calotte_error* error) {
  return guarded(error, [&] {
    const Mesh& made = mesh_of(mesh);
    require(locator != nullptr,
            "the pointer that receives the locator is null; give the address of one");
    *locator = new calotte_locator{Locator(made), rows_of(made.surface), made.points.cols()};
  });
}

calotte_status calotte_locator_find(const calotte_locator* locator, const double* positions,
                                    int64_t n, const int32_t* hints, int32_t* triangles,
                                    double* weights, int32_t* nearest, calotte_error* error) {
  return guarded(error, [&] {
    const calotte_locator& in = locator_of(locator);
    const auto points = points_of(positions, n, in.rows, "the positions");
    const Ids near = hints == nullptr ? Ids() : Ids(Eigen::Map<const Ids>(hints, n));
    const Locations found = in.locator.find(points, near);
    copy(found.triangle, triangles);
    copy(found.weights, weights);
    copy(found.nearest, nearest);
  });
}

calotte_status calotte_locator_nearest(const calotte_locator* locator, const double* positions,
                                       int64_t n, int64_t k, int32_t* sites, calotte_error* error) {
  return guarded(error, [&] {
    const calotte_locator& in = locator_of(locator);
    const auto points = points_of(positions, n, in.rows, "the positions");
    require(sites != nullptr || n == 0,
            "the array that receives the sites is a null pointer; give one of n k");
    require(k <= in.sites, "k is {}, and the mesh has {} sites; give at most as many", k, in.sites);
    copy(in.locator.nearest_few(points, k).items, sites);
  });
}

calotte_status calotte_locator_within(const calotte_locator* locator, const double* positions,
                                      int64_t n, double distance, int64_t* begin, int32_t* sites,
                                      calotte_error* error) {
  return guarded(error, [&] {
    const calotte_locator& in = locator_of(locator);
    const auto points = points_of(positions, n, in.rows, "the positions");
    require(begin != nullptr,
            "the array that receives the starts of the lists is a null pointer; give one of n + 1");
    const IdLists found = in.locator.within(points, distance);
    copy(found.begin, begin);
    copy(found.items, sites);
  });
}

calotte_status calotte_area_weights(const double* points, int64_t n, const calotte_surface* surface,
                                    int64_t edge, double reach, double* weights,
                                    calotte_error* error) {
  return guarded(error, [&] {
    const Surface where = surface_of(surface);
    const auto given = points_of(points, n, rows_of(where), "the points");
    require(weights != nullptr, "the array that receives the weights is a null pointer; give one");
    require(edge >= CALOTTE_EDGE_USUAL && edge <= CALOTTE_EDGE_REACH, "edge is {}; give 0 to {}",
            edge, static_cast<int>(CALOTTE_EDGE_REACH));
    AreaWeightOptions options{.reach = reach};
    if (edge != CALOTTE_EDGE_USUAL)
      options.edge = static_cast<EdgeCells>(edge - 1);
    copy(area_weights(given, where, options), weights);
  });
}

calotte_status calotte_interpolate(const calotte_mesh* mesh, const double* values,
                                   const double* positions, int64_t n, int natural, double* out,
                                   calotte_error* error) {
  return guarded(error, [&] {
    const Mesh& made = mesh_of(mesh);
    require(values != nullptr && (out != nullptr || n == 0),
            "the values, or the array that receives others, are a null pointer; give both");
    require(natural == 0 || natural == 1, "natural is {}; give 0 or 1", natural);
    const auto points = points_of(positions, n, rows_of(made.surface), "the positions");
    const Interpolation kind =
        natural == 1 ? Interpolation::natural_neighbours : Interpolation::linear;
    const Eigen::Map<const DoubleVector> of_sites(values, made.points.cols());
    copy(interpolate(interpolation_weights(made, points, kind), of_sites), out);
  });
}

void calotte_cells_free(calotte_cells* cells) { delete cells; }

calotte_status calotte_voronoi(const calotte_mesh* mesh, calotte_cells** cells,
                               calotte_error* error) {
  return guarded(error, [&] {
    require(cells != nullptr,
            "the pointer that receives the cells is null; give the address of one");
    *cells = new calotte_cells{voronoi(mesh_of(mesh))};
  });
}

calotte_status calotte_cells_view(const calotte_cells* cells, calotte_tessellation* view,
                                  calotte_error* error) {
  return guarded(error, [&] {
    require(cells != nullptr, "the cells are a null pointer; give those of calotte_voronoi()");
    const Voronoi& v = cells->cells;
    fill(view,
         {0, v.cells.cols(), v.edges.cols(), v.vertices.cols(), v.edges.data(), v.vertices.data(),
          v.edges_on_cell.begin.data(), v.edges_on_cell.items.data(),
          v.vertices_on_cell.items.data(), v.cells_on_cell.items.data(), v.cells_on_vertex.data(),
          v.cells_on_edge.data(), v.vertices_on_edge.data(), v.dc.data(), v.dv.data(),
          v.cell_area.data(), v.vertex_area.data()},
         "calotte_tessellation");
  });
}

calotte_status calotte_read(const char* path, calotte_mesh** mesh, calotte_error* error) {
  return guarded(error, [&] {
    require_output(mesh);
    require(path != nullptr, "the path is a null pointer; give the name of a file");
    hand_over(read_mesh(path), mesh);
  });
}

calotte_status calotte_write(const char* path, const calotte_mesh* mesh, double sphere_radius,
                             calotte_error* error) {
  return guarded(error, [&] {
    require(path != nullptr, "the path is a null pointer; give the name of a file");
    WriteOptions options;
    options.sphere_radius = sphere_radius;
    write(path, mesh_of(mesh), options);
  });
}
