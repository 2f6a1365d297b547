// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mpas/mpas_coordinates.h"

#include "base/spherical_angles.h"
#include "base/vec3.h"
#include "voronoi/geometry.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace calotte::io_detail {
namespace {

// ---- Values

/// The longitude in [0, 2 pi).
CALOTTE_INLINE double eastern_longitude(double x, double y) {
  constexpr double turn = 2 * std::numbers::pi;
  return eastern(longitude_of(x, y), turn);
}

CALOTTE_VECTOR_WIDTHS
void longitudes(const double* xyz, std::int64_t count, double* out) {
  for (std::int64_t i = 0; i < count; ++i)
    out[i] = eastern_longitude(xyz[3 * i], xyz[3 * i + 1]);
}

CALOTTE_VECTOR_WIDTHS
void latitudes(const double* xyz, std::int64_t count, double* out) {
  for (std::int64_t i = 0; i < count; ++i)
    out[i] = latitude_of(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
}

const Vec3* columns(const Points3& points, std::int64_t first) {
  return reinterpret_cast<const Vec3*>(points.data()) + first;
}

void fill_coordinates(const Vec3* points, double factor, std::int64_t count, double* const* xyz) {
  for (std::int64_t i = 0; i < count; ++i) {
    xyz[0][i] = factor * points[i].x;
    xyz[1][i] = factor * points[i].y;
    xyz[2][i] = factor * points[i].z;
  }
}

/// Fills in latitudes and longitudes of directions; zeros in a plane.
void fill_angles(const Vec3* directions, bool on_sphere, std::int64_t count,
                 double* const* latlon) {
  if (on_sphere) {
    latitudes(&directions->x, count, latlon[0]);
    longitudes(&directions->x, count, latlon[1]);
  } else {
    std::fill(latlon[0], latlon[0] + count, 0.0);
    std::fill(latlon[1], latlon[1] + count, 0.0);
  }
}

/// Fills in the first columns of a group: lat, lon, x, y and z, and the numbers from 1 on.
void fill_points(const MpasMesh& mesh, const Vec3* points, std::int64_t begin, std::int64_t end,
                 std::int32_t* const* ints, double* const* doubles) {
  fill_angles(points, mesh.voronoi.surface.is_sphere(), end - begin, doubles);
  fill_coordinates(points, mesh.radius, end - begin, doubles + 2);
  std::iota(ints[0], ints[0] + (end - begin), static_cast<std::int32_t>(begin + 1));
}

void fill_vertices(const MpasMesh& mesh, std::int64_t begin, std::int64_t end,
                   std::int32_t* const* ints, double* const* doubles) {
  Voronoi& voronoi = mesh.voronoi;
  Array<Vec3> computed;
  if (!mesh.whole()) {
    computed = Array<Vec3>(end - begin);
    measure_vertices(mesh.surplus, begin, end, voronoi, computed.begin());
  }
  fill_points(mesh, mesh.whole() ? columns(voronoi.vertices, begin) : computed.begin(), begin, end,
              ints, doubles);
  const double unit = mesh.radius * mesh.radius;
  double *area = doubles[5], *kites = doubles[6];
  for (std::int64_t v = begin; v < end; ++v) {
    *area++ = unit * (mesh.whole() ? voronoi.vertex_area[v] : vertex_area(voronoi, v));
    for (int j = 0; j < 3; ++j)
      *kites++ = unit * voronoi.kites(j, v);
  }
}

void fill_edges(const MpasMesh& mesh, std::int64_t begin, std::int64_t end,
                std::int32_t* const* ints, double* const* doubles) {
  Voronoi& voronoi = mesh.voronoi;
  double *dc = doubles[5], *dv = doubles[6], *angles = doubles[7];
  if (mesh.whole()) {
    std::copy(voronoi.angle.data() + begin, voronoi.angle.data() + end, angles);
    fill_points(mesh, columns(voronoi.edges, begin), begin, end, ints, doubles);
  } else {
    Array<Vec3> computed(end - begin);
    measure_edges(mesh.surplus, begin, end, voronoi, computed.begin(), angles);
    fill_points(mesh, computed.begin(), begin, end, ints, doubles);
  }
  for (std::int64_t e = begin; e < end; ++e) {
    *dc++ = mesh.radius * voronoi.dc[e];
    *dv++ = mesh.radius * voronoi.dv[e];
  }
}

// ---- Variables

std::vector<std::string> coordinates(const MpasKind& kind) {
  return {kind.axis(0), kind.axis(1), kind.axis(2)};
}

/// The names of the variables in the order of fill_points(), then the others.
std::vector<std::string> point_variables(const MpasKind& kind,
                                         const std::vector<std::string>& others = {}) {
  std::vector<std::string> names{kind.latitude(), kind.longitude()};
  for (const std::string& name : coordinates(kind))
    names.push_back(name);
  names.push_back(kind.numbers());
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

} // namespace

void put_coordinates(const MpasSink& sink, const MpasKind& kind, const Points3& points,
                     double factor) {
  sink(coordinates(kind), [&points, factor](std::int64_t begin, std::int64_t end,
                                            std::int32_t* const*, double* const* xyz) {
    fill_coordinates(columns(points, begin), factor, end - begin, xyz);
  });
}

void put_cells(const MpasSink& sink, const MpasMesh& mesh) {
  sink(point_variables(mpas_cell), [&mesh](std::int64_t begin, std::int64_t end,
                                           std::int32_t* const* ints, double* const* doubles) {
    fill_points(mesh, columns(mesh.voronoi.cells, begin), begin, end, ints, doubles);
    if (mesh.points.cols() > 0)
      fill_coordinates(columns(mesh.points, begin), 1, end - begin, doubles + 2);
  });
}

void put_vertices(const MpasSink& sink, const MpasMesh& mesh) {
  sink(point_variables(mpas_vertex, {mpas::area_triangle, mpas::kite_areas_on_vertex}),
       [&mesh](auto... arguments) { fill_vertices(mesh, arguments...); });
}

void put_edges(const MpasSink& sink, const MpasMesh& mesh) {
  sink(point_variables(mpas_edge, {mpas::dc_edge, mpas::dv_edge, mpas::angle_edge}),
       [&mesh](auto... arguments) { fill_edges(mesh, arguments...); });
}

} // namespace calotte::io_detail
