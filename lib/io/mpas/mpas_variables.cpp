// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_variables.h"

#include "io/cells/triangle_quality.h"
#include "io/mpas/vertex_order.h"
#include "voronoi/cell_fields.h"
#include "voronoi/tangential_weights.h"

#include <algorithm>
#include <vector>

namespace calotte::io_detail {
namespace {

// ---- Values

/// Fills in of(voronoi, row) for each row.
template <auto of>
void each(const Voronoi& voronoi, std::int64_t begin, std::int64_t end, double* out) {
  for (std::int64_t i = begin; i < end; ++i)
    *out++ = static_cast<double>(of(voronoi, i));
}

std::int64_t degree(const Voronoi& voronoi, std::int64_t i) {
  return voronoi.edges_on_cell.count(i);
}
bool is_boundary(const Voronoi& voronoi, std::int64_t v) {
  return voronoi.cells_on_vertex.col(v).minCoeff() < 0;
}
double area(const Voronoi& voronoi, std::int64_t i) { return voronoi.cell_area[i]; }
std::int64_t edge_count(const Voronoi& voronoi, std::int64_t e) {
  return voronoi_detail::weight_count(voronoi, e);
}

// ---- Rows

using D = MpasDimension;
using N = MpasNumbers;
using T = MpasTurn;

void add_coordinates(const MpasKind& kind, std::vector<MpasVariable>& table) {
  table.push_back({.name = kind.latitude(),
                   .rows = kind.rows,
                   .units = "radians",
                   .long_name = "latitude of " + kind.subject,
                   .standard_name = "latitude",
                   .rule = "the latitude of x, y and z, in a plane 0"});
  table.push_back({.name = kind.longitude(),
                   .rows = kind.rows,
                   .units = "radians",
                   .long_name = "longitude of " + kind.subject,
                   .standard_name = "longitude",
                   .rule = "the longitude of x, y and z, in a plane 0"});
  constexpr const char* coordinates[] = {"x coordinate of ", "y coordinate of ",
                                         "z coordinate of "};
  for (int k = 0; k < 3; ++k)
    table.push_back({.name = kind.axis(k),
                     .rows = kind.rows,
                     .numbers = N::length,
                     .units = "m",
                     .long_name = coordinates[k] + kind.subject,
                     .rule = kind.rule});
  table.push_back({.name = kind.numbers(),
                   .rows = kind.rows,
                   .integer = true,
                   .numbers = N::own,
                   .long_name = "number of each " + kind.word + ", 1-based",
                   .rule = "numbers from 1 on"});
}

/// What ids are, with the number from which they count.
std::string ids(const std::string& what) { return what + index_base; }

/// The lists of ids.
std::vector<MpasVariable> connectivity() {
  return {
      {.name = mpas::n_edges_on_cell,
       .rows = D::cells,
       .integer = true,
       .long_name = "number of edges of each cell",
       .rule = "the number of neighbours of each cell",
       .values = each<degree>},
      {.name = mpas::edges_on_cell,
       .rows = D::cells,
       .columns = D::max_edges,
       .integer = true,
       .numbers = N::edges,
       .long_name = ids("edges of each cell, counter-clockwise"),
       .rule = "the edges of each cell, counter-clockwise, then 0"},
      {.name = mpas::vertices_on_cell,
       .rows = D::cells,
       .columns = D::max_edges,
       .integer = true,
       .numbers = N::vertices,
       .long_name = described(VertexOrder::after_edges),
       .rule = "the vertices of each cell, counter-clockwise from the start or, in all cells, from "
               "the end of its first edge on, then 0"},
      {.name = mpas::cells_on_cell,
       .rows = D::cells,
       .columns = D::max_edges,
       .integer = true,
       .numbers = N::cells,
       .long_name = ids("neighbours of each cell, across the edges of edgesOnCell"),
       .rule = "the neighbours of each cell across its edges, then 0"},
      {.name = mpas::cells_on_edge,
       .rows = D::edges,
       .columns = D::two,
       .integer = true,
       .numbers = N::cells,
       .long_name = ids("cells on both sides of each edge: its normal points from the first to the "
                        "second"),
       .rule = "pairs of neighbouring cells, each pair once"},
      {.name = mpas::vertices_on_edge,
       .rows = D::edges,
       .columns = D::two,
       .integer = true,
       .numbers = N::vertices,
       .long_name =
           ids("vertices at both ends of each edge: its tangent points from the first to the "
               "second, and is the normal turned to the left"),
       .rule = "the vertices to the right and to the left of the way from the first to the second "
               "cell of each edge"},
      {.name = mpas::cells_on_vertex,
       .rows = D::vertices,
       .columns = D::degree,
       .integer = true,
       .numbers = N::cells,
       .long_name =
           ids("cells around each vertex, counter-clockwise: cell j lies between edges j and "
               "j + 1 of edgesOnVertex"),
       .rule = "cells of a vertex, counter-clockwise"},
      {.name = mpas::edges_on_vertex,
       .rows = D::vertices,
       .columns = D::degree,
       .integer = true,
       .numbers = N::edges,
       .long_name = ids("edges at each vertex, counter-clockwise"),
       .rule = "the edges at each vertex, counter-clockwise, edge j before cell j of "
               "cellsOnVertex"},
      {.name = mpas::boundary_vertex,
       .rows = D::vertices,
       .integer = true,
       .long_name = "1 where a vertex lies on the boundary of the mesh",
       .rule = "1 at vertices that lack a cell, and 0 elsewhere",
       .values = each<is_boundary>},
      {.name = mpas::n_edges_on_edge,
       .rows = D::edges,
       .integer = true,
       .long_name = "number of other edges of the cells on each edge",
       .rule = "the number of other edges of both cells of each edge",
       .values = each<edge_count>},
      {.name = mpas::edges_on_edge,
       .rows = D::edges,
       .columns = D::max_edges2,
       .integer = true,
       .numbers = N::edges,
       .long_name = ids("other edges of the cells on each edge: those of the first cell, "
                        "counter-clockwise from the edge on, then of the second"),
       .rule = "the other edges of the first cell of each edge, counter-clockwise from it on, then "
               "of the second, then 0"},
  };
}

/// Variables that are computed from coordinates.
std::vector<MpasVariable> measures() {
  return {
      {.name = mpas::weights_on_edge,
       .rows = D::edges,
       .columns = D::max_edges2,
       .long_name = "weights of the normal velocities at edgesOnEdge in the tangential velocity at "
                    "each edge",
       .rule = "the tangential weights of each edge"},
      {.name = mpas::dc_edge,
       .rows = D::edges,
       .numbers = N::length,
       .units = "m",
       .long_name = "distance of the generators of the cells on each edge",
       .rule = "the distance of the cells on each edge"},
      {.name = mpas::dv_edge,
       .rows = D::edges,
       .numbers = N::length,
       .units = "m",
       .long_name = "distance of the vertices at the ends of each edge",
       .rule = "the distance of the vertices at the ends of each edge"},
      {.name = mpas::angle_edge,
       .rows = D::edges,
       .numbers = N::angle,
       .units = "radians",
       .long_name = "angle of the normal of each edge from east, in a plane from the x axis",
       .rule = "the angle of the normal of each edge from east, in a plane from the x axis"},
      {.name = mpas::area_triangle,
       .rows = D::vertices,
       .numbers = N::area,
       .units = "m2",
       .long_name = "area of the triangle of generators around each vertex",
       .rule = "the area of the triangle of cells around each vertex"},
      {.name = mpas::kite_areas_on_vertex,
       .rows = D::vertices,
       .columns = D::degree,
       .numbers = N::area,
       .units = "m2",
       .long_name = "signed area of the part of each triangle in each of its cells",
       .rule = "the signed areas of the parts of each triangle in its cells"},
      {.name = mpas::area_cell,
       .rows = D::cells,
       .numbers = N::area,
       .units = "m2",
       .long_name = "area of each cell",
       .standard_name = "cell_area",
       .rule = "the sum of the kites of each cell",
       .values = each<area>},
      {.name = mpas::mesh_density,
       .rows = D::cells,
       .long_name = "density that the mesh was made for, over its maximum",
       .rule = "numbers from 0 to 1"},
      {.name = mpas::nominal_min_dc,
       .numbers = N::length,
       .units = "m",
       .long_name = "nominal distance of neighbouring generators where meshDensity is 1",
       .rule = "the nominal distance of cells where meshDensity is 1, which follows from "
               "meshDensity and the areas"},
      {.name = "cellQuality",
       .rows = D::cells,
       .long_name = "shortest over longest edge of each cell",
       .rule = "the shortest over the longest edge of each cell",
       .values = each<quality_at>},
      {.name = mpas::grid_spacing,
       .rows = D::cells,
       .numbers = N::length,
       .units = "m",
       .long_name = "mean distance of each generator from its neighbours",
       .rule = "the mean distance of each cell from its neighbours",
       .values = each<spacing_at>},
      {.name = "triangleQuality",
       .rows = D::vertices,
       .long_name = "shortest over longest side of the triangle around each vertex",
       .rule = "the shortest over the longest side of each triangle",
       .values = each<side_quality>},
      {.name = mpas::triangle_angle_quality,
       .rows = D::vertices,
       .long_name = "smallest over largest angle of the triangle around each vertex",
       .rule = "the smallest over the largest angle of each triangle",
       .values = fill_angle_qualities},
      {.name = mpas::obtuse_triangle,
       .rows = D::vertices,
       .integer = true,
       .long_name = "1 where the triangle around a vertex has an obtuse angle",
       .rule = "1 where the triangle has an obtuse angle, and 0 elsewhere",
       .values = each<is_obtuse>},
  };
}

/// Variables that the initialisation of models adds.
std::vector<MpasVariable> additions() {
  return {
      {.name = "defc_a", .numbers = N::per_length, .of_models = true, .turn = T::east2},
      {.name = "defc_b", .numbers = N::per_length, .of_models = true, .turn = T::north},
      {.name = "deriv_two", .numbers = N::per_area, .of_models = true},
      {.name = "cell_gradient_coef_x",
       .numbers = N::per_length,
       .of_models = true,
       .turn = T::east},
      {.name = "cell_gradient_coef_y",
       .numbers = N::per_length,
       .of_models = true,
       .turn = T::north},
      {.name = "edgeNormalVectors", .numbers = N::normal, .of_models = true, .turn = T::vectors},
      {.name = "edgeTangentVectors", .of_models = true, .turn = T::vectors},
      {.name = "localVerticalUnitVectors", .of_models = true, .turn = T::vectors},
      {.name = "cellTangentPlane", .of_models = true, .turn = T::vectors},
      {.name = "coeffs_reconstruct", .of_models = true, .turn = T::vectors},
      {.name = "baryWeightsOnVertex", .of_models = true}, // three numbers, and no vector
      {.name = "fCell", .of_models = true, .turn = T::coriolis},
      {.name = "fEdge", .of_models = true, .turn = T::coriolis},
      {.name = "fVertex", .of_models = true, .turn = T::coriolis},
      {.name = "advCells", .integer = true, .numbers = N::lists_of_ids, .of_models = true},
      {.name = "advCellsForEdge", .integer = true, .numbers = N::lists_of_ids, .of_models = true},
  };
}

std::vector<MpasVariable> make_table() {
  std::vector<MpasVariable> table;
  add_coordinates(mpas_cell, table);
  add_coordinates(mpas_edge, table);
  add_coordinates(mpas_vertex, table);
  for (const std::vector<MpasVariable>& part : {connectivity(), measures(), additions()})
    table.insert(table.end(), part.begin(), part.end());
  return table;
}

} // namespace

const char* name_of(MpasDimension dimension) {
  switch (dimension) {
  case D::cells:
    return "nCells";
  case D::edges:
    return "nEdges";
  case D::vertices:
    return "nVertices";
  case D::max_edges:
    return "maxEdges";
  case D::max_edges2:
    return "maxEdges2";
  case D::two:
    return "TWO";
  case D::degree:
    return "vertexDegree";
  default:
    return "";
  }
}

std::span<const MpasVariable> mpas_variables() {
  static const std::vector<MpasVariable> table = make_table();
  return table;
}

const MpasVariable& mpas_variable(const std::string& name) {
  const std::span<const MpasVariable> table = mpas_variables();
  return *std::find_if(table.begin(), table.end(),
                       [&](const MpasVariable& variable) { return variable.name == name; });
}

int radius_power(const MpasVariable& variable) {
  switch (variable.numbers) {
  case N::length:
    return 1;
  case N::area:
    return 2;
  case N::per_length:
    return -1;
  case N::per_area:
    return -2;
  default:
    return 0;
  }
}

double radius_factor(const MpasVariable& variable, double radius) {
  const int power = radius_power(variable);
  const double factor = power == 0 ? 1 : power == 1 || power == -1 ? radius : radius * radius;
  return power < 0 ? 1 / factor : factor;
}

const NetcdfMeshNames& mpas_names() {
  static const NetcdfMeshNames names = [] {
    NetcdfMeshNames all{.cells = name_of(D::cells),
                        .vertices = name_of(D::vertices),
                        .variables = {},
                        .edges = name_of(D::edges)};
    for (const MpasVariable& variable : mpas_variables())
      if (!variable.of_models)
        all.variables.insert(variable.name);
      else if (variable.numbers == N::lists_of_ids)
        all.lists.insert(variable.name);
    return all;
  }();
  return names;
}

} // namespace calotte::io_detail
