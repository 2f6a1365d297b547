// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/cells/triangle_quality.h"
#include "io/cells/written_fields.h"
#include "io/mpas/mpas.h"
#include "io/mpas/mpas_places.h"

#include "base/matrix_memory.h"
#include "voronoi/cell_fields.h"
#include "voronoi/geometry.h"
#include "voronoi/spacing_fit.h"
#include "voronoi/stages.h"
#include "voronoi/tangential_weights.h"

#include <algorithm>
#include <utility>

namespace calotte::io_detail {
namespace {

struct Dimensions {
  int cells, edges, vertices, max_edges, max_edges2, two, vertex_degree;
};

Dimensions full_dimensions(NetcdfWriter& file, const MpasMesh& mesh) {
  const Voronoi& voronoi = mesh.voronoi;
  const std::int64_t most = most_corners(voronoi);
  const Dimensions dimensions{.cells = file.dimension("nCells", voronoi.cells.cols()),
                              .edges = file.dimension("nEdges", mesh.edges()),
                              .vertices =
                                  file.dimension("nVertices", voronoi.cells_on_vertex.cols()),
                              .max_edges = file.dimension("maxEdges", most),
                              .max_edges2 = file.dimension("maxEdges2", 2 * most),
                              .two = file.dimension("TWO", 2),
                              .vertex_degree = file.dimension("vertexDegree", 3)};
  file.dimension("Time", 0);
  return dimensions;
}

// ---- Connectivity

/// 1-based, padded with 0.
NetcdfWriter::Fill<std::int32_t> cell_lists(const IdLists& lists, std::int64_t width) {
  return [&lists, width](std::int64_t begin, std::int64_t end, std::int32_t* out) {
    for (std::int64_t i = begin; i < end; ++i) {
      std::int32_t* const end_of_row = out + width;
      for (const std::int32_t id : lists[i])
        *out++ = id + 1;
      out = std::fill_n(out, end_of_row - out, 0);
    }
  };
}

/// The columns of a matrix of ids, 1-based.
template <class Matrix> NetcdfWriter::Fill<std::int32_t> id_columns(const Matrix& ids) {
  return [&ids](std::int64_t begin, std::int64_t end, std::int32_t* out) {
    const std::int64_t rows = ids.rows();
    std::transform(ids.data() + rows * begin, ids.data() + rows * end, out,
                   [](std::int32_t id) { return id + 1; });
  };
}

/// That are known before the others.
void put_begun_ids(MpasFile& file, const Dimensions& dimensions, const Voronoi& voronoi) {
  file.ints("nEdgesOnCell", {dimensions.cells}, described("1", "number of edges of each cell"),
            table<std::int32_t>(1, [&voronoi](std::int64_t i, std::int64_t) {
              return static_cast<std::int32_t>(voronoi.edges_on_cell.count(i));
            }));
  file.ints("cellsOnVertex", {dimensions.vertices, dimensions.vertex_degree},
            described("1", "cells around each vertex, counter-clockwise: cell j lies between edges "
                           "j and j + 1 of edgesOnVertex"),
            id_columns(voronoi.cells_on_vertex));
  file.ints("boundaryVertex", {dimensions.vertices},
            described("1", "1 where a vertex lies on the boundary of the mesh"),
            table<std::int32_t>(1, [&voronoi](std::int64_t v, std::int64_t) {
              return voronoi.cells_on_vertex.col(v).minCoeff() < 0 ? 1 : 0;
            }));
}

void put_cell_ids(MpasFile& file, const Dimensions& dimensions, const Voronoi& voronoi) {
  const std::int64_t width = most_corners(voronoi);
  const std::vector<int> shape{dimensions.cells, dimensions.max_edges};
  file.ints("edgesOnCell", shape,
            described("1", "edges of each cell, counter-clockwise: edge k lies between vertices "
                           "k - 1 and k of verticesOnCell"),
            cell_lists(voronoi.edges_on_cell, width));
  file.ints("verticesOnCell", shape, described("1", "vertices of each cell, counter-clockwise"),
            cell_lists(voronoi.vertices_on_cell, width));
  file.ints("cellsOnCell", shape,
            described("1", "neighbours of each cell, across the edges of edgesOnCell"),
            cell_lists(voronoi.cells_on_cell, width));
}

void put_edge_ids(MpasFile& file, const Dimensions& dimensions, const Voronoi& voronoi) {
  const std::vector<int> shape{dimensions.edges, dimensions.two};
  file.ints("cellsOnEdge", shape,
            described("1", "cells on both sides of each edge: its normal points from the first to "
                           "the second"),
            id_columns(voronoi.cells_on_edge));
  file.ints("verticesOnEdge", shape,
            described("1", "vertices at both ends of each edge: its tangent points from the first "
                           "to the second, and is the normal turned to the left"),
            id_columns(voronoi.vertices_on_edge));
}

void put_vertex_ids(MpasFile& file, const Dimensions& dimensions, const Voronoi& voronoi) {
  file.ints("edgesOnVertex", {dimensions.vertices, dimensions.vertex_degree},
            described("1", "edges at each vertex, counter-clockwise"),
            id_columns(voronoi.edges_on_vertex));
}

// ---- The tangential velocity

NetcdfWriter::Fill<double> scaled(const DoubleVector& values, double factor) {
  return table<double>(
      1, [&values, factor](std::int64_t i, std::int64_t) { return factor * values[i]; });
}

void fill_weights(const Voronoi& voronoi, std::int64_t begin, std::int64_t end, std::int64_t width,
                  std::int32_t* edges, double* weights) {
  for (std::int64_t e = begin; e < end; ++e) {
    const std::int64_t count = weight_count(voronoi, e);
    set_weights(voronoi, static_cast<std::int32_t>(e), edges, weights);
    for (std::int64_t k = 0; k < count; ++k)
      ++edges[k];
    std::fill(edges + count, edges + width, 0);
    std::fill(weights + count, weights + width, 0.0);
    edges += width, weights += width;
  }
}

void put_weights(MpasFile& file, const Dimensions& dimensions, const Voronoi& voronoi) {
  const std::int64_t width = 2 * most_corners(voronoi);
  const std::vector<int> shape{dimensions.edges, dimensions.max_edges2};
  file.ints("nEdgesOnEdge", {dimensions.edges},
            described("1", "number of other edges of the cells on each edge"),
            table<std::int32_t>(1, [&voronoi](std::int64_t e, std::int64_t) {
              return static_cast<std::int32_t>(weight_count(voronoi, e));
            }));
  file.together(
      {{.name = "edgesOnEdge",
        .dimensions = shape,
        .attributes = described("1", "other edges of the cells on each edge: those of the first "
                                     "cell, counter-clockwise from the edge on, then of the "
                                     "second"),
        .integer = true},
       {"weightsOnEdge", shape,
        described("1", "weights of the normal velocities at edgesOnEdge in the tangential velocity "
                       "at each edge")}},
      [&voronoi, width](std::int64_t begin, std::int64_t end, std::int32_t* const* edges,
                        double* const* weights) {
        fill_weights(voronoi, begin, end, width, edges[0], weights[0]);
      });
}

// ---- Fields and quality

void put_density(MpasFile& file, int cells, const MpasMesh& mesh) {
  file.doubles("meshDensity", {cells},
               described("1", "density that the mesh was made for, over its maximum"),
               table<double>(1, [&mesh](std::int64_t i, std::int64_t) {
                 return mesh.density.size() == 0 ? 1 : mesh.density[i];
               }));
}

void put_fields(MpasFile& file, const Dimensions& dimensions, const MpasMesh& mesh) {
  const Voronoi& voronoi = mesh.voronoi;
  file.doubles("areaCell", {dimensions.cells}, described("m2", "area of each cell", "cell_area"),
               scaled(voronoi.cell_area, mesh.radius * mesh.radius));
  put_density(file, dimensions.cells, mesh);
  file.doubles("nominalMinDc", {},
               described("m", "nominal distance of neighbouring generators where meshDensity is 1"),
               table<double>(1, [&mesh](std::int64_t, std::int64_t) {
                 return mesh.radius * voronoi_detail::nominal_spacing(mesh.voronoi, mesh.density);
               }));
  file.doubles("cellQuality", {dimensions.cells},
               described("1", "shortest over longest edge of each cell"),
               table<double>(
                   1, [&voronoi](std::int64_t i, std::int64_t) { return quality_at(voronoi, i); }));
  file.doubles("gridSpacing", {dimensions.cells},
               described("m", "mean distance of each generator from its neighbours"),
               table<double>(1, [&mesh](std::int64_t i, std::int64_t) {
                 return mesh.radius * spacing_at(mesh.voronoi, i);
               }));
}

void put_triangle_quality(MpasFile& file, const Dimensions& dimensions, const Voronoi& voronoi) {
  file.doubles("triangleQuality", {dimensions.vertices},
               described("1", "shortest over longest side of the triangle around each vertex"),
               table<double>(1, [&voronoi](std::int64_t v, std::int64_t) {
                 return side_quality(voronoi, v);
               }));
  file.doubles("triangleAngleQuality", {dimensions.vertices},
               described("1", "smallest over largest angle of the triangle around each vertex"),
               [&voronoi](std::int64_t begin, std::int64_t end, double* out) {
                 fill_angle_qualities(voronoi, begin, end, out);
               });
  file.ints("obtuseTriangle", {dimensions.vertices},
            described("1", "1 where the triangle around a vertex has an obtuse angle"),
            table<std::int32_t>(1, [&voronoi](std::int64_t v, std::int64_t) {
              return is_obtuse(voronoi, v) ? 1 : 0;
            }));
}

// ---- Files

void announce_lists(MpasFile& file, const Dimensions& dimensions, MpasMesh& mesh) {
  file.then([&mesh] { release(mesh.places); });
  put_cell_ids(file, dimensions, mesh.voronoi);
  put_edge_ids(file, dimensions, mesh.voronoi);
  put_vertex_ids(file, dimensions, mesh.voronoi);
  file.then([&mesh] { release(mesh.voronoi.vertices_on_edge); });
}

void announce_measures(MpasFile& file, const Dimensions& dimensions, const MpasMesh& mesh) {
  put_vertices(file, dimensions.vertices, dimensions.vertex_degree, mesh);
  put_edges(file, dimensions.edges, mesh);
  file.then([&mesh] {
    if (!mesh.whole())
      measure_areas(mesh.voronoi);
  });
  put_weights(file, dimensions, mesh.voronoi);
  put_fields(file, dimensions, mesh);
  put_triangle_quality(file, dimensions, mesh.voronoi);
}

void write_full(const std::string& path, MpasMesh mesh, const WriteOptions& options) {
  OutputFile graph(graph_path(path));
  MpasFile file(path, mesh, options);
  const Dimensions dimensions = full_dimensions(file.netcdf(), mesh);
  for (const FieldDimension& added : options.dimensions)
    file.netcdf().field_dimension(added.name, added.size);
  put_cells(file, dimensions.cells, mesh);
  put_begun_ids(file, dimensions, mesh.voronoi);
  file.after([&] {
    if (!mesh.whole())
      mesh.connect();
  });
  announce_lists(file, dimensions, mesh);
  file.after([&] {
    mesh.density = density_of(mesh.voronoi, options);
    put_graph([&](std::string_view text) { graph.append(text); }, mesh.voronoi);
    if (!mesh.whole())
      mesh.surplus = begin_measures(mesh.voronoi);
  });
  announce_measures(file, dimensions, mesh);
  add_fields(
      file, options,
      {.cells = {dimensions.cells}, .edges = {dimensions.edges}, .vertices = {dimensions.vertices}},
      mpas_names());
  file.commit();
  graph.commit();
}

void write_minimal(const std::string& path, MpasMesh mesh, const WriteOptions& options) {
  const Voronoi& voronoi = mesh.voronoi;
  MpasFile file(path, mesh, options);
  NetcdfWriter& netcdf = file.netcdf();
  const int cells = netcdf.dimension("nCells", voronoi.cells.cols());
  const int vertices = netcdf.dimension("nVertices", voronoi.cells_on_vertex.cols());
  const int degree = netcdf.dimension("vertexDegree", 3);
  netcdf.dimension("Time", 0);
  put_coordinates(file, mpas_cell, cells, mesh.sites(), 1);
  file.after([&] {
    mesh.connect();
    measure(mesh.voronoi);
    mesh.density = density_of(voronoi, options);
  });
  put_coordinates(file, mpas_vertex, vertices, voronoi.vertices, mesh.radius);
  file.ints("cellsOnVertex", {vertices, degree},
            described("1", "cells around each vertex, counter-clockwise"),
            id_columns(voronoi.cells_on_vertex));
  put_density(file, cells, mesh);
  add_fields(file, options, {.cells = {cells}, .vertices = {vertices}}, mpas_names());
  file.commit();
}

using Writer = void (*)(const std::string&, MpasMesh, const WriteOptions&);

/// All is computed from the places as the file holds them, so that its mesh gives the same file.
void write_mesh(const std::string& path, Mesh mesh, const WriteOptions& options, Writer writer) {
  if (!mesh.surface.is_sphere()) {
    BegunVoronoi cells = begun(mesh);
    return writer(path, {cells.voronoi, {}, 1, [&] { connect(cells); }}, options);
  }
  mesh.points = on_sphere(std::move(mesh.points), options.sphere_radius);
  BegunVoronoi cells = begun(mesh);
  writer(path,
         {cells.voronoi, std::move(mesh.points), options.sphere_radius, [&] { connect(cells); }},
         options);
}

} // namespace

void write_mpas(const std::string& path, Mesh mesh, const WriteOptions& options) {
  write_mesh(path, std::move(mesh), options, write_full);
}

void write_mpas(const std::string& path, Voronoi voronoi, Points3 places,
                const WriteOptions& options) {
  const double radius = voronoi.on_sphere ? options.sphere_radius : 1;
  write_full(path, {voronoi, std::move(places), radius}, options);
}

void write_mpas_minimal(const std::string& path, Mesh mesh, const WriteOptions& options) {
  write_mesh(path, std::move(mesh), options, write_minimal);
}

} // namespace calotte::io_detail
