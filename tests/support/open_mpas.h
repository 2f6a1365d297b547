// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "delaunay/delaunay.h"
#include "support/files.h"
#include "support/spoilt_files.h"

#include <calotte/delaunay.h>
#include <calotte/write.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// An open MPAS file, as the tools of MPAS cut it from a closed one: some cells are left out, their
/// ids are 0, and what depends on them is computed anew, here by the words of the definitions.
namespace calotte::test::open_mpas {

using base_detail::Vec3;

constexpr double pi = std::numbers::pi;
constexpr double radius = 6371229;

inline Vec3 unit(const Vec3& a) { return (1 / norm(a)) * a; }

inline double triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(dot(a, cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// A file from which cells, edges or vertices are left out.
struct Cut : Mpas {
  using Mpas::Mpas;

  std::size_t count(const std::string& dimension) {
    return rows(dimension == "nCells"   ? "latCell"
                : dimension == "nEdges" ? "latEdge"
                                        : "latVertex");
  }
  Vec3 place(const std::string& kind, std::size_t i) {
    return unit({at("x" + kind, i), at("y" + kind, i), at("z" + kind, i)});
  }
  void set_place(const std::string& kind, std::size_t i, const Vec3& p) {
    at("x" + kind, i) = radius * p.x, at("y" + kind, i) = radius * p.y;
    at("z" + kind, i) = radius * p.z;
    at("lat" + kind, i) = std::asin(p.z);
    at("lon" + kind, i) = std::atan2(p.y, p.x) + (p.y < 0 ? 2 * pi : 0);
  }

  /// Leaves out rows of a dimension, and sets the ids in lists of it.
  void keep(const std::string& dimension, const std::vector<bool>& kept,
            const std::set<std::string>& lists, const std::string& numbers) {
    std::vector<double> new_id(kept.size(), 0);
    double next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
      new_id[i] = kept[i] ? ++next : 0;
    for (auto& [name, variable] : variables) {
      if (lists.contains(name))
        for (double& id : variable.values)
          id = id > 0 ? new_id[static_cast<std::size_t>(id) - 1] : 0;
      if (!variable.dimensions.empty() && variable.dimensions[0] == dimension)
        keep_rows(variable, kept);
    }
    for (std::size_t i = 0; i < rows(numbers); ++i)
      at(numbers, i) = static_cast<double>(i) + 1;
  }
  static void keep_rows(Variable& variable, const std::vector<bool>& kept) {
    std::vector<double> values;
    for (std::size_t i = 0; i < kept.size(); ++i)
      for (std::size_t k = 0; kept[i] && k < variable.width(); ++k)
        values.push_back(variable.values[i * variable.width() + k]);
    variable.shape[0] = values.size() / variable.width();
    variable.values = values;
  }
  bool has_any(const std::string& name, std::size_t row) {
    bool any = false;
    for (std::size_t k = 0; k < variables.at(name).width(); ++k)
      any = any || at(name, row, k) > 0;
    return any;
  }
  bool has_all(const std::string& name, std::size_t row) {
    bool all = true;
    for (std::size_t k = 0; k < variables.at(name).width(); ++k)
      all = all && at(name, row, k) > 0;
    return all;
  }
};

inline void cut_cells(Cut& file, double lowest) {
  std::vector<bool> cells, edges, vertices;
  for (std::size_t i = 0; i < file.count("nCells"); ++i)
    cells.push_back(file.at("zCell", i) > lowest * radius);
  file.keep("nCells", cells, {"cellsOnCell", "cellsOnEdge", "cellsOnVertex"}, "indexToCellID");
  for (std::size_t e = 0; e < file.count("nEdges"); ++e)
    edges.push_back(file.has_any("cellsOnEdge", e));
  file.keep("nEdges", edges, {"edgesOnCell", "edgesOnVertex", "edgesOnEdge"}, "indexToEdgeID");
  for (std::size_t v = 0; v < file.count("nVertices"); ++v)
    vertices.push_back(file.has_any("cellsOnVertex", v));
  file.keep("nVertices", vertices, {"verticesOnCell", "verticesOnEdge"}, "indexToVertexID");
}

/// The first cell of an edge is there; the edge lies in the middle of its vertices.
inline void set_boundary(Cut& file) {
  for (std::size_t e = 0; e < file.count("nEdges"); ++e) {
    if (file.has_all("cellsOnEdge", e))
      continue;
    if (file.at("cellsOnEdge", e, 0) == 0)
      for (const char* name : {"cellsOnEdge", "verticesOnEdge"})
        std::swap(file.at(name, e, 0), file.at(name, e, 1));
    const Vec3 right = file.place("Vertex", file.id("verticesOnEdge", e, 0)),
               left = file.place("Vertex", file.id("verticesOnEdge", e, 1));
    const Vec3 middle = unit(right + left), normal = cross(left - right, middle);
    file.set_place("Edge", e, middle);
    file.at("dcEdge", e) = std::sqrt(3) * file.at("dvEdge", e);
    const Vec3 east = unit({-middle.y, middle.x, 0}), north = cross(middle, east);
    file.at("angleEdge", e) = std::atan2(dot(normal, north), dot(normal, east));
  }
  for (std::size_t v = 0; v < file.count("nVertices"); ++v)
    file.at("boundaryVertex", v) = file.has_all("cellsOnVertex", v) ? 0 : 1;
}

inline void set_kites(Cut& file) {
  for (std::size_t v = 0; v < file.count("nVertices"); ++v) {
    file.at("areaTriangle", v) = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      double& kite = file.at("kiteAreasOnVertex", v, j);
      kite = 0;
      if (file.at("cellsOnVertex", v, j) == 0)
        continue;
      const Vec3 p = file.place("Vertex", v),
                 c = file.place("Cell", file.id("cellsOnVertex", v, j)),
                 a = file.place("Edge", file.id("edgesOnVertex", v, j)),
                 b = file.place("Edge", file.id("edgesOnVertex", v, (j + 1) % 3));
      kite = radius * radius * (triangle(p, a, c) + triangle(p, c, b));
      file.at("areaTriangle", v) += kite;
    }
  }
}

/// The kite of a cell at a vertex.
inline double kite_of(Cut& file, std::size_t v, std::size_t cell) {
  for (std::size_t j = 0; j < 3; ++j)
    if (file.at("cellsOnVertex", v, j) == static_cast<double>(cell) + 1)
      return file.at("kiteAreasOnVertex", v, j);
  return 0;
}

/// The weights of an edge's cell from entry `next` on.
inline void set_weights(Cut& file, std::size_t e, std::size_t cell, double sign,
                        std::size_t& next) {
  const auto count = static_cast<std::size_t>(file.at("nEdgesOnCell", cell));
  std::size_t k = 0;
  while (file.id("edgesOnCell", cell, k) != e)
    ++k;
  double sum = 0;
  for (std::size_t step = 1; step < count; ++step) {
    sum += kite_of(file, file.id("verticesOnCell", cell, (k + step - 1) % count), cell) /
           file.at("areaCell", cell);
    const std::size_t other = file.id("edgesOnCell", cell, (k + step) % count);
    const double out = file.id("cellsOnEdge", other, 0) == cell ? sign : -sign;
    file.at("edgesOnEdge", e, next) = static_cast<double>(other) + 1;
    file.at("weightsOnEdge", e, next++) =
        out * (0.5 - sum) * file.at("dvEdge", other) / file.at("dcEdge", e);
  }
}

inline void set_all_weights(Cut& file) {
  for (std::size_t e = 0; e < file.count("nEdges"); ++e) {
    for (std::size_t k = 0; k < file["weightsOnEdge"].width(); ++k)
      file.at("edgesOnEdge", e, k) = file.at("weightsOnEdge", e, k) = 0;
    std::size_t next = 0;
    for (std::size_t j = 0; j < 2; ++j)
      if (file.at("cellsOnEdge", e, j) > 0)
        set_weights(file, e, file.id("cellsOnEdge", e, j), j == 0 ? 1 : -1, next);
    file.at("nEdgesOnEdge", e) = static_cast<double>(next);
  }
}

inline void set_spacings(Cut& file) {
  for (std::size_t i = 0; i < file.count("nCells"); ++i) {
    const auto count = static_cast<std::size_t>(file.at("nEdgesOnCell", i));
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k)
      sum += file.at("dcEdge", file.id("edgesOnCell", i, k));
    file.at("gridSpacing", i) = sum / static_cast<double>(count);
  }
}

inline void put_attributes(int id) {
  require(nc_put_att_text(id, NC_GLOBAL, "on_a_sphere", 3, "YES"));
  require(nc_put_att_double(id, NC_GLOBAL, "sphere_radius", NC_DOUBLE, 1, &radius));
}

/// A mesh without its cells below a height.
inline Cut open_file(const Scratch& scratch, const Points3& points, double lowest) {
  write(scratch / "closed.nc", delaunay(points), {.format = Format::mpas, .sphere_radius = radius});
  Cut file(scratch / "closed.nc");
  file.variables.erase("nominalMinDc");
  cut_cells(file, lowest);
  set_boundary(file);
  set_kites(file);
  set_all_weights(file);
  set_spacings(file);
  return file;
}

} // namespace calotte::test::open_mpas
