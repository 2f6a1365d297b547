// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/vec3.h"
#include "delaunay/delaunay.h"
#include "io/formats/formats.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"
#include "mesh/adjacency.h"
#include "support/constants.h"
#include "support/files.h"
#include "support/full_disk.h"
#include "support/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <sys/resource.h>

namespace fs = std::filesystem;
using namespace calotte;
using namespace calotte::test;
using base_detail::Vec3;
using io_detail::NetcdfReader;
using io_detail::NetcdfType;
using io_detail::NetcdfWriter;

namespace {

constexpr double epsilon = 0x1p-52;

/// The laws of a file as a model reads it.
namespace mpas_laws {

// ---- A file as a model reads it

/// Rows of numbers of a variable.
template <class T> struct Table {
  std::int64_t width = 1;
  std::vector<T> values;
  T operator()(std::int64_t row, std::int64_t k = 0) const {
    return values.at(static_cast<std::size_t>(row * width + k));
  }
  std::int64_t rows() const { return std::ssize(values) / width; }
};

struct File {
  explicit File(const std::string& path) : reader(path), n(reader.dimension("nCells")) {}

  std::vector<std::int64_t> shape(const std::string& name) const { return reader.shape_of(name); }
  Table<double> doubles(const std::string& name) const {
    const auto of = shape(name);
    return {of.size() == 2 ? of[1] : 1, reader.doubles(name, of)};
  }
  Table<std::int32_t> ints(const std::string& name) const {
    const auto of = shape(name);
    return {of.size() == 2 ? of[1] : 1, reader.ints(name, of)};
  }
  std::vector<Vec3> points(const std::string& kind) const {
    const auto x = doubles("x" + kind), y = doubles("y" + kind), z = doubles("z" + kind);
    std::vector<Vec3> points;
    for (std::int64_t i = 0; i < x.rows(); ++i)
      points.push_back({x(i), y(i), z(i)});
    return points;
  }

  NetcdfReader reader;
  std::int64_t n;
};

/// The variables that the laws refer to. Ids remain 1-based: cells[id - 1].
struct Grid {
  explicit Grid(const std::string& path)
      : file(path), sphere(file.reader.text("", "on_a_sphere") == "YES"),
        radius(file.reader.number("", "sphere_radius", -1)),
        period{file.reader.number("", "x_period", -1), file.reader.number("", "y_period", -1), 0} {}

  File file;
  bool sphere;
  double radius;
  Vec3 period;
  std::vector<Vec3> cells = file.points("Cell"), edges = file.points("Edge"),
                    vertices = file.points("Vertex");
  Table<std::int32_t> cells_on_edge = file.ints("cellsOnEdge"),
                      vertices_on_edge = file.ints("verticesOnEdge"),
                      degree = file.ints("nEdgesOnCell"), edges_on_cell = file.ints("edgesOnCell"),
                      vertices_on_cell = file.ints("verticesOnCell"),
                      cells_on_cell = file.ints("cellsOnCell"),
                      cells_on_vertex = file.ints("cellsOnVertex"),
                      edges_on_vertex = file.ints("edgesOnVertex");
  Table<double> dc = file.doubles("dcEdge"), dv = file.doubles("dvEdge"),
                cell_area = file.doubles("areaCell"), vertex_area = file.doubles("areaTriangle"),
                kites = file.doubles("kiteAreasOnVertex");

  Vec3 cell(std::int32_t id) const { return cells.at(static_cast<std::size_t>(id) - 1); }
  Vec3 edge(std::int32_t id) const { return edges.at(static_cast<std::size_t>(id) - 1); }
  Vec3 vertex(std::int32_t id) const { return vertices.at(static_cast<std::size_t>(id) - 1); }

  /// From a to the nearest copy of b.
  Vec3 step(const Vec3& a, const Vec3& b) const {
    const Vec3 d = b - a;
    if (sphere)
      return d;
    return {d.x - period.x * std::round(d.x / period.x),
            d.y - period.y * std::round(d.y / period.y), 0};
  }
  /// Away from the surface, of length 1.
  Vec3 up(const Vec3& a) const { return sphere ? (1 / norm(a)) * a : Vec3{0, 0, 1}; }
  /// The size of coordinates, of which they are rounded.
  double scale() const { return sphere ? radius : std::max(period.x, period.y); }
  double distance(const Vec3& a, const Vec3& b) const {
    return sphere ? 2 * radius * std::asin(std::min(1.0, norm(b - a) / (2 * radius)))
                  : norm(step(a, b));
  }
  /// Signed, positive when counter-clockwise (van Oosterom and Strackee, 1983).
  double area(const Vec3& a, const Vec3& b, const Vec3& c) const {
    if (!sphere)
      return 0.5 * dot(cross(step(a, b), step(a, c)), up(a));
    const Vec3 p = up(a), q = up(b), r = up(c);
    return radius * radius * 2 *
           std::atan2(dot(p, cross(q - p, r - p)), 1 + dot(p, q) + dot(q, r) + dot(r, p));
  }
  /// How far a triangle's circumcentre may be off: thin triangles have it badly.
  double centre_error(std::int64_t v) const {
    const Vec3 a = cell(cells_on_vertex(v, 0)), b = cell(cells_on_vertex(v, 1)),
               c = cell(cells_on_vertex(v, 2));
    const Vec3 ab = step(a, b), ac = step(a, c);
    return 32 * epsilon * scale() * std::max(1.0, norm(ab) * norm(ac) / norm(cross(ab, ac)));
  }
};

/// A law that holds for each i; the first that breaks it ends the test.
void law(bool holds, const char* what, std::int64_t i) {
  if (!holds)
    FAIL(std::string(what) << " at " << i << " (0-based)");
}

template <class T> bool near(T a, T b, double tolerance) { return std::abs(a - b) <= tolerance; }

// ---- The laws, each by the words of the MPAS mesh specification

void check_dimensions(const Grid& grid) {
  const NetcdfReader& file = grid.file.reader;
  const std::int64_t n = grid.file.n;
  const std::int64_t vertices = grid.sphere ? 2 * n - 4 : 2 * n, edges = vertices + vertices / 2;
  CHECK(file.dimension("nVertices") == vertices);
  CHECK(file.dimension("nEdges") == edges);
  CHECK(file.dimension("TWO") == 2);
  CHECK(file.dimension("vertexDegree") == 3);
  CHECK(file.dimension("Time") == 0);
  const auto most = *std::max_element(grid.degree.values.begin(), grid.degree.values.end());
  CHECK(file.dimension("maxEdges") == most);
  CHECK(file.dimension("maxEdges2") == 2 * most);
  CHECK(std::ssize(grid.cells) == n);
  CHECK(std::ssize(grid.edges) == edges);
  CHECK(std::ssize(grid.vertices) == vertices);

  const std::map<std::string, std::vector<std::string>> shapes{
      {"nEdgesOnCell", {"nCells"}},
      {"edgesOnCell", {"nCells", "maxEdges"}},
      {"verticesOnCell", {"nCells", "maxEdges"}},
      {"cellsOnCell", {"nCells", "maxEdges"}},
      {"cellsOnEdge", {"nEdges", "TWO"}},
      {"verticesOnEdge", {"nEdges", "TWO"}},
      {"nEdgesOnEdge", {"nEdges"}},
      {"edgesOnEdge", {"nEdges", "maxEdges2"}},
      {"weightsOnEdge", {"nEdges", "maxEdges2"}},
      {"cellsOnVertex", {"nVertices", "vertexDegree"}},
      {"edgesOnVertex", {"nVertices", "vertexDegree"}},
      {"kiteAreasOnVertex", {"nVertices", "vertexDegree"}},
      {"nominalMinDc", {}}};
  for (const auto& [name, dimensions] : shapes)
    CHECK(file.dimensions_of(name) == dimensions);
}

void check_attributes(const Grid& grid, const WriteOptions& options) {
  const NetcdfReader& file = grid.file.reader;
  CHECK(file.text("", "on_a_sphere") == (grid.sphere ? "YES" : "NO"));
  CHECK(file.text("", "is_periodic") == (grid.sphere ? "NO" : "YES"));
  CHECK(grid.radius == (grid.sphere ? options.sphere_radius : 0));
  CHECK(file.text("", "mesh_spec") == "1.0");
  CHECK(file.text("", "Conventions") == "CF-1.8 MPAS");
  CHECK(file.text("", "history") == options.history);
  CHECK(file.text("", "source").starts_with("calotte "));
  CHECK(file.text("", "file_id").size() == 16);
  for (const std::string& name : file.variable_names()) {
    CAPTURE(name);
    CHECK(!file.text(name, "units").empty());
    CHECK(!file.text(name, "long_name").empty());
  }
}

void check_coordinates(const Grid& grid) {
  for (const std::string kind : {"Cell", "Edge", "Vertex"}) {
    CAPTURE(kind);
    const auto points = grid.file.points(kind);
    const auto latitude = grid.file.doubles("lat" + kind),
               longitude = grid.file.doubles("lon" + kind);
    const auto number = grid.file.ints("indexTo" + kind + "ID");
    for (std::int64_t i = 0; i < std::ssize(points); ++i) {
      const Vec3 p = points[static_cast<std::size_t>(i)];
      law(number(i) == i + 1, "its number", i);
      if (!grid.sphere) {
        law(latitude(i) == 0 && longitude(i) == 0 && p.z == 0, "flat", i);
        law(p.x >= 0 && p.x < grid.period.x && p.y >= 0 && p.y < grid.period.y, "in the box", i);
        continue;
      }
      const double across = std::hypot(p.x, p.y);
      law(near(norm(p), grid.radius, 8 * epsilon * grid.radius), "on the sphere", i);
      law(near(latitude(i), std::atan2(p.z, across), 1e-15 * 4), "its latitude", i);
      law(std::abs(latitude(i)) <= pi / 2, "latitudes between the poles", i);
      law(longitude(i) >= 0 && longitude(i) < 2 * pi && !std::signbit(longitude(i)),
          "longitudes from 0 to below 2 pi", i);
      law(near(across * std::cos(longitude(i)), p.x, 1e-15 * 8 * grid.radius) &&
              near(across * std::sin(longitude(i)), p.y, 1e-15 * 8 * grid.radius),
          "its longitude", i);
    }
  }
}

void check_edges(const Grid& grid) {
  for (std::int64_t e = 0; e < std::ssize(grid.edges); ++e) {
    const std::int32_t c1 = grid.cells_on_edge(e, 0), c2 = grid.cells_on_edge(e, 1),
                       v1 = grid.vertices_on_edge(e, 0), v2 = grid.vertices_on_edge(e, 1);
    law(1 <= c1 && c1 <= grid.file.n && 1 <= c2 && c2 <= grid.file.n && c1 != c2,
        "cellsOnEdge in range", e);
    law(1 <= v1 && v1 <= grid.vertex_area.rows() && 1 <= v2 && v2 <= grid.vertex_area.rows() &&
            v1 != v2,
        "verticesOnEdge in range", e);
    const Vec3 a = grid.cell(c1), p = grid.vertex(v1);
    const Vec3 normal = grid.step(a, grid.cell(c2)), along = grid.step(p, grid.vertex(v2));
    const double error = grid.centre_error(v1 - 1) + grid.centre_error(v2 - 1);
    law(dot(cross(normal, along), grid.up(a)) > -error * norm(normal),
        "the tangent lies to the left of the normal", e);
    if (grid.dv(e) > error) {
      law(dot(cross(normal, along), grid.up(a)) > 0, "the tangent's sign", e);
    }
    law(std::abs(dot(normal, along)) <= 2 * error * norm(normal),
        "an edge is perpendicular to the line between its cells", e);

    const Vec3 middle = grid.edge(static_cast<std::int32_t>(e) + 1);
    const Vec3 half = a + 0.5 * normal;
    const Vec3 point = grid.sphere ? (grid.radius / norm(half)) * half : half;
    law(norm(grid.step(point, middle)) <= 8 * epsilon * norm(half), "xEdge is the midpoint", e);
    law(near(grid.dc(e), grid.distance(a, grid.cell(c2)), 16 * epsilon * grid.scale()),
        "dcEdge is the distance of the cells", e);
    law(grid.dv(e) >= 0 && near(grid.dv(e), grid.distance(p, grid.vertex(v2)), error),
        "dvEdge is the distance of the vertices", e);
  }
}

void check_angles(const Grid& grid) {
  const auto angle = grid.file.doubles("angleEdge");
  for (std::int64_t e = 0; e < std::ssize(grid.edges); ++e) {
    const Vec3 at = grid.edges[static_cast<std::size_t>(e)];
    const Vec3 normal =
        grid.step(grid.cell(grid.cells_on_edge(e, 0)), grid.cell(grid.cells_on_edge(e, 1)));
    const double across = std::hypot(at.x, at.y) / (grid.sphere ? grid.radius : 1);
    Vec3 east{1, 0, 0}, north{0, 1, 0};
    if (grid.sphere) {
      east = (1 / std::hypot(at.x, at.y)) * Vec3{-at.y, at.x, 0};
      north = cross(grid.up(at), east);
    } else {
      law(angle(e) >= 0 && angle(e) < 2 * pi, "angles from 0 to below 2 pi", e);
    }
    const double error =
        16 * epsilon *
        (grid.sphere ? 1 / across + grid.radius / norm(normal) : grid.period.x / norm(normal));
    law(near(norm(normal) * std::cos(angle(e)), dot(normal, east), error * norm(normal)) &&
            near(norm(normal) * std::sin(angle(e)), dot(normal, north), error * norm(normal)),
        "angleEdge is the normal's from east", e);
  }
}

/// Whether an edge joins two vertices, or separates two cells, in any order.
bool has_both(const Table<std::int32_t>& pairs, std::int32_t e, std::int32_t a, std::int32_t b) {
  return (pairs(e - 1, 0) == a && pairs(e - 1, 1) == b) ||
         (pairs(e - 1, 0) == b && pairs(e - 1, 1) == a);
}

void check_cells(const Grid& grid) {
  const std::int64_t edges = std::ssize(grid.edges), vertices = std::ssize(grid.vertices);
  std::vector<int> seen_edges(static_cast<std::size_t>(edges)),
      seen_vertices(static_cast<std::size_t>(vertices));
  for (std::int64_t i = 0; i < grid.file.n; ++i) {
    const auto id = static_cast<std::int32_t>(i + 1);
    const int degree = grid.degree(i);
    law(degree >= 3 && degree <= grid.edges_on_cell.width, "nEdgesOnCell in range", i);
    for (int k = 0; k < grid.edges_on_cell.width; ++k) {
      const std::int32_t e = grid.edges_on_cell(i, k), v = grid.vertices_on_cell(i, k),
                         c = grid.cells_on_cell(i, k);
      if (k >= degree) {
        law(e == 0 && v == 0 && c == 0, "padding is 0", i);
        continue;
      }
      law(1 <= e && e <= edges && 1 <= v && v <= vertices && 1 <= c && c <= grid.file.n,
          "ids in range", i);
      ++seen_edges[static_cast<std::size_t>(e) - 1];
      ++seen_vertices[static_cast<std::size_t>(v) - 1];
      const std::int32_t before = grid.vertices_on_cell(i, (k + degree - 1) % degree);
      law(has_both(grid.vertices_on_edge, e, before, v),
          "edgesOnCell[k] lies between verticesOnCell[k-1] and [k]", i);
      law(has_both(grid.cells_on_edge, e, id, c), "cellsOnCell[k] is across edgesOnCell[k]", i);
      const std::int32_t next = grid.cells_on_cell(i, (k + 1) % degree);
      law(grid.area(grid.cell(id), grid.cell(c), grid.cell(next)) > 0,
          "neighbours run counter-clockwise", i);
    }
  }
  CHECK(std::all_of(seen_edges.begin(), seen_edges.end(), [](int times) { return times == 2; }));
  CHECK(std::all_of(seen_vertices.begin(), seen_vertices.end(),
                    [](int times) { return times == 3; }));
}

void check_vertices(const Grid& grid) {
  const auto boundary = grid.file.ints("boundaryVertex");
  for (std::int64_t v = 0; v < std::ssize(grid.vertices); ++v) {
    const auto id = static_cast<std::int32_t>(v + 1);
    const Vec3 centre = grid.vertex(id);
    law(boundary(v) == 0, "no boundary", v);
    std::array<Vec3, 3> corners{};
    for (int j = 0; j < 3; ++j) {
      const std::int32_t cell = grid.cells_on_vertex(v, j), e = grid.edges_on_vertex(v, j),
                         next = grid.edges_on_vertex(v, (j + 1) % 3);
      law(1 <= cell && cell <= grid.file.n && 1 <= e && e <= std::ssize(grid.edges), "ids in range",
          v);
      corners[static_cast<std::size_t>(j)] = grid.cell(cell);
      law(grid.vertices_on_edge(e - 1, 0) == id || grid.vertices_on_edge(e - 1, 1) == id,
          "edgesOnVertex end there", v);
      law(has_both(grid.cells_on_edge, next, cell, grid.cells_on_vertex(v, (j + 1) % 3)) &&
              has_both(grid.cells_on_edge, e, cell, grid.cells_on_vertex(v, (j + 2) % 3)),
          "cellsOnVertex[j] lies between edgesOnVertex[j] and [j+1]", v);
    }
    law(grid.area(corners[0], corners[1], corners[2]) > 0, "counter-clockwise", v);
    for (int j = 0; j < 3; ++j) {
      const Vec3 a = corners[static_cast<std::size_t>(j)],
                 b = corners[static_cast<std::size_t>((j + 1) % 3)];
      const Vec3 side = grid.step(a, b);
      law(std::abs(dot(grid.step(a, centre), side) - 0.5 * dot(side, side)) <=
              grid.centre_error(v) * norm(side),
          "a vertex is as far from all its cells", v);
    }
  }
}

void check_areas(const Grid& grid) {
  const double whole =
      grid.sphere ? 4 * pi * grid.radius * grid.radius : grid.period.x * grid.period.y;
  double cells = 0, triangles = 0;
  for (const double area : grid.cell_area.values)
    cells += area;
  std::vector<double> of_cell(static_cast<std::size_t>(grid.file.n));
  for (std::int64_t v = 0; v < std::ssize(grid.vertices); ++v) {
    triangles += grid.vertex_area(v);
    const Vec3 centre = grid.vertex(static_cast<std::int32_t>(v) + 1);
    double sum = 0, magnitude = 0;
    for (int j = 0; j < 3; ++j) {
      const std::int32_t id = grid.cells_on_vertex(v, j);
      const Vec3 cell = grid.cell(id), edge = grid.edge(grid.edges_on_vertex(v, j)),
                 next = grid.edge(grid.edges_on_vertex(v, (j + 1) % 3));
      const double kite = grid.kites(v, j);
      const double size = grid.distance(cell, centre) + grid.scale() * epsilon;
      law(near(kite, grid.area(centre, edge, cell) + grid.area(centre, cell, next),
               4 * grid.centre_error(v) * size),
          "a kite is the signed area of vertex, edge j, cell j, edge j + 1", v);
      of_cell[static_cast<std::size_t>(id) - 1] += kite;
      sum += kite;
      magnitude += std::abs(kite);
    }
    law(near(grid.vertex_area(v), sum, 4 * epsilon * magnitude),
        "areaTriangle is the sum of its kites", v);
    law(near(sum,
             grid.area(grid.cell(grid.cells_on_vertex(v, 0)), grid.cell(grid.cells_on_vertex(v, 1)),
                       grid.cell(grid.cells_on_vertex(v, 2))),
             64 * epsilon * grid.scale() *
                 (std::sqrt(magnitude) + grid.dc(grid.edges_on_vertex(v, 0) - 1) +
                  grid.dc(grid.edges_on_vertex(v, 1) - 1))),
        "areaTriangle is the triangle's area", v);
  }
  CHECK(near(cells, whole, 1e-12 * whole));
  CHECK(near(triangles, whole, 1e-12 * whole));
  for (std::int64_t i = 0; i < grid.file.n; ++i) {
    const double area = of_cell[static_cast<std::size_t>(i)];
    law(near(grid.cell_area(i), area, 1e-13 * area), "areaCell is the sum of its kites", i);
  }
}

/// The edges of a cell after one of them, counter-clockwise, and the cell's kites passed on the way
/// from it to each.
struct Round {
  std::vector<std::int32_t> edges;
  std::vector<double> kites; ///< sums
};

Round round_of(const Grid& grid, std::int32_t cell, std::int32_t e) {
  const std::int64_t i = cell - 1;
  const int degree = grid.degree(i);
  int start = 0;
  while (grid.edges_on_cell(i, start) != e)
    ++start;
  Round round;
  double sum = 0;
  for (int k = 1; k < degree; ++k) {
    const std::int32_t v = grid.vertices_on_cell(i, (start + k - 1) % degree);
    for (int j = 0; j < 3; ++j)
      if (grid.cells_on_vertex(v - 1, j) == cell)
        sum += grid.kites(v - 1, j);
    round.edges.push_back(grid.edges_on_cell(i, (start + k) % degree));
    round.kites.push_back(sum);
  }
  return round;
}

void check_weights(const Grid& grid) {
  const auto count = grid.file.ints("nEdgesOnEdge"), edges = grid.file.ints("edgesOnEdge");
  const auto weights = grid.file.doubles("weightsOnEdge");
  std::map<std::pair<std::int64_t, std::int64_t>, double> energy;
  for (std::int64_t e = 0; e < std::ssize(grid.edges); ++e) {
    std::int64_t k = 0;
    for (int side = 0; side < 2; ++side) {
      const std::int32_t cell = grid.cells_on_edge(e, side);
      const Round round = round_of(grid, cell, static_cast<std::int32_t>(e) + 1);
      for (std::size_t m = 0; m < round.edges.size(); ++m, ++k) {
        const std::int32_t other = round.edges[m];
        law(k < edges.width && edges(e, k) == other,
            "edgesOnEdge: those of c1 counter-clockwise after e, then of c2", e);
        const int outward = grid.cells_on_edge(other - 1, 0) == cell ? 1 : -1;
        const double sign = side == 0 ? outward : -outward;
        const double expected = sign * (0.5 - round.kites[m] / grid.cell_area(cell - 1)) *
                                grid.dv(other - 1) / grid.dc(e);
        law(near(weights(e, k), expected, 1e-13 * (1 + grid.dv(other - 1) / grid.dc(e))),
            "weightsOnEdge by its formula", e);
        energy[{e, other - 1}] = weights(e, k) * grid.dc(e) * grid.dv(e);
      }
    }
    law(count(e) == k, "nEdgesOnEdge", e);
    for (; k < edges.width; ++k)
      law(edges(e, k) == 0 && weights(e, k) == 0, "padding is 0", e);
  }
  // weight dc_e / dv_e' is antisymmetric, here times dv_e dv_e', which may be 0.
  for (const auto& [pair, value] : energy) {
    const auto mirrored = energy.find({pair.second, pair.first});
    law(mirrored != energy.end(), "edges on edges are mutual", pair.first);
    law(near(value, -mirrored->second, 4e-13 * grid.dv(pair.first) * grid.dv(pair.second)),
        "tangential weights keep energy", pair.first);
  }
}

/// The smallest and the largest angle of a flat triangle, by the law of cosines.
std::pair<double, double> angles(double a, double b, double c) {
  const auto angle = [](double x, double y, double across) {
    return std::acos(std::clamp((x * x + y * y - across * across) / (2 * x * y), -1.0, 1.0));
  };
  return std::minmax({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

void check_triangle_quality(const Grid& grid) {
  const auto quality = grid.file.doubles("triangleQuality"),
             angle_quality = grid.file.doubles("triangleAngleQuality");
  const auto obtuse = grid.file.ints("obtuseTriangle");
  for (std::int64_t v = 0; v < std::ssize(grid.vertices); ++v) {
    const double a = grid.dc(grid.edges_on_vertex(v, 0) - 1),
                 b = grid.dc(grid.edges_on_vertex(v, 1) - 1),
                 c = grid.dc(grid.edges_on_vertex(v, 2) - 1);
    const auto [shortest, longest] = std::minmax({a, b, c});
    law(near(quality(v), shortest / longest, 2 * epsilon), "triangleQuality", v);
    const auto [least, greatest] = angles(a, b, c);
    law(near(angle_quality(v), least / greatest, 1e-6), "triangleAngleQuality", v);
    const Vec3 p = grid.cell(grid.cells_on_vertex(v, 0));
    const Vec3 q = grid.step(p, grid.cell(grid.cells_on_vertex(v, 1))),
               r = grid.step(p, grid.cell(grid.cells_on_vertex(v, 2)));
    const double flat = angles(norm(q), norm(r), norm(r - q)).second;
    if (std::abs(flat - pi / 2) > 1e-8) {
      law((obtuse(v) == 1) == (flat > pi / 2), "obtuseTriangle", v);
    }
    law(obtuse(v) == 0 || obtuse(v) == 1, "a mask", v);
  }
}

void check_fields(const Grid& grid, const Density& density) {
  const std::int64_t n = grid.file.n;
  Points3 units(3, n);
  for (std::int64_t i = 0; i < n; ++i) {
    const Vec3 p = grid.up(grid.cells[static_cast<std::size_t>(i)]);
    units.col(i) << p.x, p.y, p.z;
  }
  Eigen::VectorXd rho = evaluate(density, units);
  rho /= rho.maxCoeff();
  const auto shown = grid.file.doubles("meshDensity"), quality = grid.file.doubles("cellQuality"),
             spacing = grid.file.doubles("gridSpacing");
  double sum = 0, most = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    law(near(shown(i), rho[i], 1e-12), "meshDensity", i);
    most = std::max(most, shown(i));
    sum += grid.cell_area(i) * std::sqrt(rho[i]);
    double total = 0, shortest = 1e300, longest = 0;
    for (int k = 0; k < grid.degree(i); ++k) {
      const std::int32_t e = grid.edges_on_cell(i, k) - 1;
      total += grid.dc(e);
      shortest = std::min(shortest, grid.dv(e));
      longest = std::max(longest, grid.dv(e));
    }
    law(near(spacing(i), total / grid.degree(i), 1e-14 * total), "gridSpacing is the mean dc", i);
    law(near(quality(i), shortest / longest, 1e-14), "cellQuality is min dv over max dv", i);
  }
  CHECK(most == 1);
  // n hexagons of area sqrt(3)/2 h^2, h^2 as rho^(-1/2), cover all.
  const double nominal = std::sqrt(sum / static_cast<double>(n) * 2 / std::sqrt(3.0));
  CHECK(near(grid.file.doubles("nominalMinDc")(0), nominal, 1e-12 * nominal));
}

void check_graph(const Grid& grid, const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  CHECK(line == std::to_string(grid.file.n) + " " + std::to_string(grid.edges.size()));
  for (std::int64_t i = 0; i < grid.file.n; ++i) {
    std::getline(in, line);
    std::istringstream numbers(line);
    std::vector<std::int32_t> found, expected;
    for (std::int32_t id; numbers >> id;)
      found.push_back(id);
    for (int k = 0; k < grid.degree(i); ++k)
      expected.push_back(grid.cells_on_cell(i, k));
    law(found == expected, "graph.info lists the neighbours", i);
  }
  CHECK(in.good());
  CHECK(!std::getline(in, line));
}

/// All of formats' laws of a file that was written with these options.
void check_file(const std::string& path, const WriteOptions& options) {
  const Grid grid(path);
  check_dimensions(grid);
  check_attributes(grid, options);
  check_coordinates(grid);
  check_edges(grid);
  check_angles(grid);
  check_cells(grid);
  check_vertices(grid);
  check_areas(grid);
  check_weights(grid);
  check_triangle_quality(grid);
  check_fields(grid, options.density);
  check_graph(grid, fs::path(path).replace_extension(".graph.info"));
}

} // namespace mpas_laws

// ---- Meshes

Density oblique_x8() { return tanh_bump({0.3, -0.5, 0.8}, pi / 6, 0.2, 1.0 / 4096); }

Mesh x8_mesh(std::int64_t cells, int bisections, int iterations) {
  return make_grid({.resolution = oblique_x8(),
                    .start = {.points = random_sphere(cells, site_density(oblique_x8()), 5),
                              .bisections = bisections},
                    .stop = {.max_iterations = iterations}})
      .mesh;
}

struct Case {
  std::string name;
  Mesh mesh;
  WriteOptions options;
};

std::vector<Case> cases() {
  const auto options = [](double radius, Density density, std::string history) {
    WriteOptions of;
    of.sphere_radius = radius;
    of.density = std::move(density);
    of.history = std::move(history);
    return of;
  };
  return {{"icosahedral", delaunay(bisected_icosahedron(4)), options(1, {}, "seed 1\ntwo lines")},
          {"icosahedral, of the Earth", delaunay(bisected_icosahedron(3)),
           options(6371229, {}, "Earth")},
          {"x8", x8_mesh(2562, 0, 12), options(6371229, oblique_x8(), "x8")},
          {"random", delaunay(random_sphere(1500, 7)), options(1, {}, "random")},
          {"longitudes and latitudes", delaunay(lat_lon_sphere(19, 40, true)),
           options(1, {}, "lat-lon")},
          {"octahedron, of any norm", delaunay(5 * lat_lon_sphere(1, 4, true)),
           options(0.1, {}, "six cells")}};
}

Mesh read_back(const std::string& path, const Mesh& like) {
  const NetcdfReader file(path);
  CHECK(io_detail::is_mpas(file));
  io_detail::RawMesh raw = io_detail::read_mpas(file);
  Mesh mesh{std::move(raw.points), std::move(raw.triangles), {}, like.site_of_input};
  mesh.neighbours = mesh_detail::neighbours_of(mesh.triangles, mesh.points.cols());
  return mesh;
}

} // namespace

TEST_CASE("the full file obeys every rule of an MPAS mesh") {
  const Scratch scratch;
  for (const Case& of : cases()) {
    CAPTURE(of.name);
    io_detail::write_mpas(scratch / "a.nc", of.mesh, of.options);
    mpas_laws::check_file(scratch / "a.nc", of.options);
  }
}

TEST_CASE("so does that of a periodic plane") {
  const Scratch scratch;
  WriteOptions options;
  options.history = "hexagons";
  const Mesh mesh = hexagonal_box(7, 10, 1000);
  io_detail::write_mpas(scratch / "a.nc", mesh, options);
  mpas_laws::check_file(scratch / "a.nc", options);

  // A uniform wind's tangential velocities come back from its normal ones.
  const mpas_laws::Grid grid(scratch / "a.nc");
  const auto angle = grid.file.doubles("angleEdge"), weights = grid.file.doubles("weightsOnEdge");
  const auto count = grid.file.ints("nEdgesOnEdge"), edges = grid.file.ints("edgesOnEdge");
  for (std::int64_t e = 0; e < std::ssize(grid.edges); ++e) {
    double tangential = 0;
    for (std::int64_t k = 0; k < count(e); ++k)
      tangential += weights(e, k) * std::cos(angle(edges(e, k) - 1) - 0.7);
    mpas_laws::law(mpas_laws::near(tangential, -std::sin(angle(e) - 0.7), 1e-12),
                   "the tangential velocity", e);
  }
}

// Slow: a descent on 40 962 cells, and each rule for each cell.
TEST_CASE("the full file of 40 962 cells, x8, obeys every rule [slow]") {
  const Scratch scratch;
  WriteOptions options;
  options.sphere_radius = 6371229;
  options.density = oblique_x8();
  options.history = "x8";
  const Mesh mesh = x8_mesh(2562, 2, 10);
  REQUIRE(mesh.points.cols() == 40'962);
  io_detail::write_mpas(scratch / "a.nc", mesh, options);
  mpas_laws::check_file(scratch / "a.nc", options);
}

TEST_CASE("a minimal file holds the same cells and vertices") {
  const Scratch scratch;
  for (const Case& of : cases()) {
    CAPTURE(of.name);
    io_detail::write_mpas(scratch / "full.nc", of.mesh, of.options);
    io_detail::write_mpas_minimal(scratch / "grid.nc", of.mesh, of.options);
    CHECK(!fs::exists(scratch / "grid.graph.info"));
    const mpas_laws::File full(scratch / "full.nc"), minimal(scratch / "grid.nc");
    const std::vector<std::string> expected{"xCell",   "yCell",   "zCell",         "xVertex",
                                            "yVertex", "zVertex", "cellsOnVertex", "meshDensity"};
    CHECK(minimal.reader.variable_names() == expected);
    for (const std::string& name : expected) {
      CHECK(minimal.doubles(name).values == full.doubles(name).values);
      CHECK(minimal.reader.dimensions_of(name) == full.reader.dimensions_of(name));
      CHECK(minimal.reader.text(name, "units") == full.reader.text(name, "units"));
    }
    for (const std::string name :
         {"on_a_sphere", "is_periodic", "mesh_spec", "Conventions", "history", "file_id", "source"})
      CHECK(minimal.reader.text("", name) == full.reader.text("", name));
    CHECK(minimal.reader.number("", "sphere_radius", 0) == of.options.sphere_radius);
  }
}

TEST_CASE("a mesh keeps its bits in a round trip, and so does its file") {
  const Scratch scratch;
  for (const Case& of : cases())
    for (const auto write : {static_cast<void (*)(const std::string&, Mesh, const WriteOptions&)>(
                                 io_detail::write_mpas),
                             static_cast<void (*)(const std::string&, Mesh, const WriteOptions&)>(
                                 io_detail::write_mpas_minimal)}) {
      CAPTURE(of.name);
      write(scratch / "a.nc", of.mesh, of.options);
      const Mesh back = read_back(scratch / "a.nc", of.mesh);
      CHECK(back.triangles == of.mesh.triangles);
      CHECK(back.neighbours == of.mesh.neighbours);
      if (of.options.sphere_radius == 1)
        CHECK(back.points == of.mesh.points);
      else
        CHECK((back.points / of.options.sphere_radius -
               of.mesh.points.colwise().normalized().matrix())
                  .cwiseAbs()
                  .maxCoeff() <= 4 * epsilon);
      write(scratch / "b.nc", back, of.options);
      CHECK(test::read_file(scratch / "b.nc") == test::read_file(scratch / "a.nc"));
    }
}

TEST_CASE("a periodic plane keeps its bits in a round trip, and so does its file") {
  const Scratch scratch;
  const Mesh mesh = hexagonal_box(5, 6, 0.3);
  for (const bool full : {true, false}) {
    const auto write = [&](const std::string& name, const Mesh& of) {
      full ? io_detail::write_mpas(scratch / name, of, {})
           : io_detail::write_mpas_minimal(scratch / name, of, {});
    };
    write("a.nc", mesh);
    const Mesh back = read_mesh(scratch / "a.nc");
    CHECK(back.points == mesh.points);
    CHECK(back.triangles == mesh.triangles);
    CHECK(back.neighbours == mesh.neighbours);
    CHECK(back.surface == mesh.surface);
    write("b.nc", back);
    CHECK(test::read_file(scratch / "b.nc") == test::read_file(scratch / "a.nc"));
  }
}

TEST_CASE("the same bytes for any number of threads, another file_id for another mesh") {
  const Scratch scratch;
  const Mesh mesh = delaunay(random_sphere(20'000, 3));
  for (const int threads : {1, 3})
    tbb::task_arena(threads).execute(
        [&] { io_detail::write_mpas(scratch / (std::to_string(threads) + ".nc"), mesh, {}); });
  for (const std::string suffix : {".nc", ".graph.info"})
    CHECK(test::read_file(scratch / ("3" + suffix)) == test::read_file(scratch / ("1" + suffix)));

  std::set<std::string> ids;
  for (int seed = 0; seed < 4; ++seed) {
    io_detail::write_mpas_minimal(scratch / "a.nc", delaunay(random_sphere(20, seed)), {});
    ids.insert(NetcdfReader(scratch / "a.nc").text("", "file_id"));
  }
  CHECK(ids.size() == 4);
}

TEST_CASE("a full disk leaves the old mesh and its graph") {
  const Scratch scratch;
  const Mesh mesh = delaunay(bisected_icosahedron(3));
  io_detail::write_mpas(scratch / "a.nc", delaunay(bisected_icosahedron(1)), {});
  const std::string before = test::read_file(scratch / "a.nc"),
                    graph = test::read_file(scratch / "a.graph.info");
  for (const rlim_t bytes : {rlim_t{1'000}, rlim_t{30'000}, rlim_t{400'000}}) {
    std::string message;
    {
      const FullDisk disk(bytes);
      try {
        io_detail::write_mpas(scratch / "a.nc", mesh, {});
      } catch (const Error& error) {
        message = error.what();
      }
    }
    CHECK(message.ends_with(": File too large; make room or write elsewhere"));
    CHECK(scratch.files() == 2);
    CHECK(test::read_file(scratch / "a.nc") == before);
    CHECK(test::read_file(scratch / "a.graph.info") == graph);
  }
}

TEST_CASE("an error while a file is written leaves the old mesh and its graph") {
  const Scratch scratch;
  const Mesh mesh = delaunay(bisected_icosahedron(5)); // of several blocks
  io_detail::write_mpas(scratch / "a.nc", delaunay(bisected_icosahedron(1)), {});
  const std::string before = test::read_file(scratch / "a.nc"),
                    graph = test::read_file(scratch / "a.graph.info");
  WriteOptions options;
  options.density.kind = Density::Kind::callable;
  options.density.callable = [](const auto&, Eigen::Ref<Eigen::VectorXd> rho) { rho.setZero(); };
  using Write = void (*)(const std::string&, Mesh, const WriteOptions&);
  for (const Write write : {Write{io_detail::write_mpas}, Write{io_detail::write_mpas_minimal}}) {
    CHECK_THROWS_WITH_AS(write(scratch / "a.nc", mesh, options),
                         doctest::Contains("zero at every cell"), Error);
    CHECK(scratch.files() == 2);
    CHECK(test::read_file(scratch / "a.nc") == before);
    CHECK(test::read_file(scratch / "a.graph.info") == graph);
  }
}

TEST_CASE("meshes that make no such file are refused") {
  const Scratch scratch;
  Points3 half = random_sphere(50, 1);
  half.row(2) = half.row(2).cwiseAbs().array() + 0.01;
  CHECK(code_of([&] { io_detail::write_mpas(scratch / "a.nc", delaunay(half), {}); }) ==
        ErrorCode::invalid_argument);
  CHECK(scratch.files() == 0);
}

namespace {

/// A file of the icosahedron's cells whose parts the test selects.
struct Forged {
  std::int64_t x_cells = 12, y_cells = 12, degree = 3;
  std::string kind = "YES", ids = "cellsOnVertex";
  double period = 0;
  std::int32_t id = 1; ///< of the first cell at vertex 7

  void write(const std::string& path) const {
    NetcdfWriter file(path);
    const int x = file.dimension("nCells", x_cells), y = file.dimension("nCells2", y_cells),
              vertices = file.dimension("nVertices", 20), three = file.dimension("degree", degree);
    file.attribute({"on_a_sphere", kind});
    file.attribute({"x_period", period});
    file.attribute({"y_period", period});
    std::vector<int> coordinates;
    for (const std::string name : {"xCell", "yCell", "zCell"})
      coordinates.push_back(file.variable(name, NetcdfType::float64, {name == "yCell" ? y : x}));
    const int v = file.variable(ids, NetcdfType::int32, {vertices, three});
    file.begin();
    for (const int variable : coordinates)
      file.put(variable, NetcdfWriter::Fill<double>([](auto begin, auto end, auto* out) {
                 std::fill(out, out + (end - begin), 0.5);
               }));
    file.put(v, NetcdfWriter::Fill<std::int32_t>([this](auto begin, auto end, auto* out) {
               for (auto i = degree * begin; i < degree * end; ++i)
                 *out++ = i == 6 * degree ? id : static_cast<std::int32_t>(i % 12 + 1);
             }));
    file.commit();
  }
};

} // namespace

TEST_CASE("files that are not as they should be end in one line") {
  const Scratch scratch;
  const std::string path = scratch / "a.nc";
  const auto message = [&](const Forged& forged, ErrorCode code = ErrorCode::parse) {
    forged.write(path);
    const Error error = error_of([&] {
      const NetcdfReader file(path);
      forged.period == -1 ? void(io_detail::read_mpas_sites(file))
                          : void(io_detail::read_mpas(file));
    });
    CHECK(error.code() == code);
    return std::string(error.what());
  };
  CHECK(message({.y_cells = 11}) ==
        path + ": yCell has the shape (11) instead of (12); make the file again");
  CHECK(message({.degree = 4}) ==
        path + ": cellsOnVertex has the shape (20, 4) instead of (any, 3); make the file again");
  CHECK(message({.ids = "other"}) ==
        path + ": it has no variable cellsOnVertex; give a file that has");
  Forged{.id = 0}.write(path); // the mesh is open there
  CHECK(io_detail::read_mpas(NetcdfReader(path)).triangles.cols() == 19);
  CHECK(message({.id = 13}) == path + ": cellsOnVertex has cell 13 at vertex 7 (both 1-based), but "
                                      "there are 12; make the file again");
  CHECK(has(message({.id = -1}), "cell -1 at vertex 7"));
  CHECK(message({.kind = "NO", .period = -1}, ErrorCode::invalid_argument) ==
        path + " holds a mesh of the plane, not of the sphere; read it with read_mesh()");
  CHECK(message({.kind = "NO"}) ==
        path +
            ": neither x_period nor y_period is positive, or one is negative; a plane has a period "
            "in one direction or two, or the attribute is_periodic \"NO\"");
}

TEST_CASE("a file cut short anywhere is refused") {
  const Scratch scratch;
  io_detail::write_mpas(scratch / "a.nc", delaunay(bisected_icosahedron(1)), {});
  const std::string whole = test::read_file(scratch / "a.nc");
  for (std::size_t length = 0; length < whole.size(); length += 197) {
    CAPTURE(length);
    std::ofstream(scratch / "cut.nc", std::ios::binary) << whole.substr(0, length);
    CHECK(code_of([&] { io_detail::read_mpas(NetcdfReader(scratch / "cut.nc")); }) ==
          ErrorCode::parse);
  }
  write_file(scratch / "text.nc", "netcdf mesh {\n}\n");
  CHECK(code_of([&] { NetcdfReader reader(scratch / "text.nc"); }) == ErrorCode::parse);
}
