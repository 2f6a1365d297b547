// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/cells/limited_area_masks.h"
#include "io/cells/written_fields.h"
#include "io/mpas/mpas.h"
#include "io/mpas/mpas_coordinates.h"
#include "io/mpas/vertex_order.h"

#include "voronoi/geometry.h"
#include "voronoi/spacing_fit.h"
#include "voronoi/stages.h"
#include "voronoi/tangential_weights.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace calotte::io_detail {
namespace {

using D = MpasDimension;

void define_full(MpasFile& file, const MpasMesh& mesh) {
  const Voronoi& voronoi = mesh.voronoi;
  const std::int64_t most = most_corners(voronoi);
  file.define(D::cells, voronoi.cells.cols());
  file.define(D::edges, mesh.edges());
  file.define(D::vertices, voronoi.cells_on_vertex.cols());
  file.define(D::max_edges, most);
  file.define(D::max_edges2, 2 * most);
  file.define(D::two, 2);
  file.define(D::degree, 3);
  file.netcdf().dimension("Time", 0);
}

// ---- Connectivity

/// Lists of ids, 1-based and padded with 0.
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

/// The same as cell_lists() for the vertices, in the given order.
NetcdfWriter::Fill<std::int32_t> vertex_lists(const IdLists& lists, std::int64_t width,
                                              VertexOrder order) {
  const NetcdfWriter::Fill<std::int32_t> after_edges = cell_lists(lists, width);
  if (order == VertexOrder::after_edges)
    return after_edges;
  return [&lists, width, after_edges](std::int64_t begin, std::int64_t end, std::int32_t* out) {
    after_edges(begin, end, out);
    for (std::int64_t i = begin; i < end; ++i, out += width)
      put_before_edges(std::span(out, static_cast<std::size_t>(lists.count(i))));
  };
}

void put_ids(const MpasSink& sink, const Voronoi& voronoi, VertexOrder order) {
  const std::int64_t width = most_corners(voronoi);
  put(sink, mpas::edges_on_cell, cell_lists(voronoi.edges_on_cell, width));
  put(sink, mpas::vertices_on_cell, vertex_lists(voronoi.vertices_on_cell, width, order));
  put(sink, mpas::cells_on_cell, cell_lists(voronoi.cells_on_cell, width));
  put(sink, mpas::cells_on_edge, id_columns(voronoi.cells_on_edge));
  put(sink, mpas::vertices_on_edge, id_columns(voronoi.vertices_on_edge));
  put(sink, mpas::edges_on_vertex, id_columns(voronoi.edges_on_vertex));
}

// ---- The tangential velocity

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

void put_weights(const MpasSink& sink, const Voronoi& voronoi) {
  const std::int64_t width = 2 * most_corners(voronoi);
  sink({mpas::edges_on_edge, mpas::weights_on_edge},
       [&voronoi, width](std::int64_t begin, std::int64_t end, std::int32_t* const* edges,
                         double* const* weights) {
         fill_weights(voronoi, begin, end, width, edges[0], weights[0]);
       });
}

// ---- Density

void put_density(const MpasSink& sink, const MpasMesh& mesh) {
  put(sink, mpas::mesh_density, table<double>(1, [&mesh](std::int64_t i, std::int64_t) {
        return mesh.density.size() == 0 ? 1 : mesh.density[i];
      }));
}

void put_nominal_spacing(const MpasSink& sink, const MpasMesh& mesh) {
  put(sink, mpas::nominal_min_dc, table<double>(1, [&mesh](std::int64_t, std::int64_t) {
        return mesh.radius * voronoi_detail::nominal_spacing(mesh.voronoi, mesh.density);
      }));
}

// ---- Masks of a limited area

/// Declares the masks of edges and vertices, if the cells have a mask.
/// \param names receives the names of the masks: fields with these names are not written.
void announce_masks(MpasFile& file, const MpasMesh& mesh, const WriteOptions& options,
                    NetcdfMeshNames& names) {
  const Voronoi& voronoi = mesh.voronoi;
  std::optional<Ids> among = cell_mask_among(options.fields, voronoi.cells.cols());
  if (!among)
    return;
  const auto of_cells = std::make_shared<const Ids>(*std::move(among));
  const auto announce = [&](const DerivedMask& mask, D dimension, const IdLists& on_cell,
                            std::int64_t count) {
    names.variables.insert(mask.name);
    const auto values = std::make_shared<Ids>();
    file.then([of_cells, values, count, &on_cell] { // the mesh outlives the file
      *values = least_mask(on_cell, *of_cells, count);
    });
    file.ints(mask.name, {file.id_of(dimension)},
              {{"units", std::string("1")}, {"long_name", std::string(mask.meaning)}},
              [values](std::int64_t begin, std::int64_t end, std::int32_t* out) {
                std::copy(values->data() + begin, values->data() + end, out);
              });
  };
  announce(edge_mask, D::edges, voronoi.edges_on_cell, mesh.edges());
  announce(vertex_mask, D::vertices, voronoi.vertices_on_cell, voronoi.cells_on_vertex.cols());
}

// ---- Files

void announce_lists(MpasFile& file, MpasMesh& mesh) {
  file.then([&mesh] { mesh.points.resize(3, 0); });
  put_ids(file.sink(), mesh.voronoi, file.vertex_order());
  file.then([&mesh] { mesh.voronoi.vertices_on_edge = {}; });
}

void announce_measures(MpasFile& file, const MpasMesh& mesh) {
  const MpasSink sink = file.sink();
  put_vertices(sink, mesh);
  put_edges(sink, mesh);
  file.then([&mesh] {
    if (!mesh.whole())
      measure_areas(mesh.voronoi);
  });
  put_weights(sink, mesh.voronoi);
  put_density(sink, mesh);
  put_nominal_spacing(sink, mesh);
  put_values(sink, mesh);
}

void write_full(const std::string& path, MpasMesh mesh, const WriteOptions& options) {
  OutputFile graph(graph_path(path));
  MpasFile file(path, mesh, options);
  define_full(file, mesh);
  for (const FieldDimension& added : options.dimensions)
    file.netcdf().field_dimension(added.name, added.size);
  put_cells(file.sink(), mesh);
  put(file.sink(), mpas::cells_on_vertex, id_columns(mesh.voronoi.cells_on_vertex));
  file.after([&] {
    if (!mesh.whole())
      mesh.connect();
  });
  announce_lists(file, mesh);
  file.after([&] {
    mesh.density = density_at_cells(mesh.voronoi, options);
    put_graph([&](std::string_view text) { graph.append(text); }, mesh.voronoi);
    if (!mesh.whole())
      mesh.surplus = begin_measures(mesh.voronoi);
  });
  announce_measures(file, mesh);
  NetcdfMeshNames names = mpas_names();
  announce_masks(file, mesh, options, names);
  add_fields(file, options,
             {.cells = {file.id_of(D::cells)},
              .edges = {file.id_of(D::edges)},
              .vertices = {file.id_of(D::vertices)}},
             names);
  file.commit();
  graph.commit();
}

void write_minimal(const std::string& path, MpasMesh mesh, const WriteOptions& options) {
  const Voronoi& voronoi = mesh.voronoi;
  MpasFile file(path, mesh, options);
  const MpasSink sink = file.sink();
  file.define(D::cells, voronoi.cells.cols());
  file.define(D::vertices, voronoi.cells_on_vertex.cols());
  file.define(D::degree, 3);
  file.netcdf().dimension("Time", 0);
  put_coordinates(sink, mpas_cell, mesh.sites(), 1);
  file.after([&] {
    mesh.connect();
    measure(mesh.voronoi);
    mesh.density = density_at_cells(voronoi, options);
  });
  put_coordinates(sink, mpas_vertex, voronoi.vertices, mesh.radius);
  put(sink, mpas::cells_on_vertex, id_columns(voronoi.cells_on_vertex));
  put_density(sink, mesh);
  add_fields(file, options,
             {.cells = {file.id_of(D::cells)}, .vertices = {file.id_of(D::vertices)}},
             mpas_names());
  file.commit();
}

using MpasWriter = void (*)(const std::string&, MpasMesh, const WriteOptions&);

/// Computes everything from the coordinates as stored in the file, so that the mesh of the file
/// gives the same file again.
void write_mesh(const std::string& path, Mesh mesh, const WriteOptions& options,
                MpasWriter writer) {
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

void put_variables(const MpasSink& sink, const MpasMesh& mesh, VertexOrder order) {
  put_cells(sink, mesh);
  put_ids(sink, mesh.voronoi, order);
  put_vertices(sink, mesh);
  put_edges(sink, mesh);
  put_weights(sink, mesh.voronoi);
  put_values(sink, mesh);
}

void write_mpas(const std::string& path, Mesh mesh, const WriteOptions& options) {
  write_mesh(path, std::move(mesh), options, write_full);
}

void write_mpas(const std::string& path, Voronoi voronoi, Points3 points,
                const WriteOptions& options) {
  const double radius = voronoi.surface.is_sphere() ? options.sphere_radius : 1;
  write_full(path, {voronoi, std::move(points), radius}, options);
}

void write_mpas_minimal(const std::string& path, Mesh mesh, const WriteOptions& options) {
  write_mesh(path, std::move(mesh), options, write_minimal);
}

} // namespace calotte::io_detail
