// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/formats/formats.h"
#include "mesh/adjacency.h"

#include "base/points.h"
#include "exact/predicates.h"

#include <calotte/density.h>
#include <calotte/error.h>

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

// Files of MPI-SCVT (Jacobsen et al., Geosci. Model Dev. 6, 2013). SaveVertices has a generator x y
// z on each line. SaveTriangles has three generators on each line, counted from 0, in either
// orientation. SaveDensity has the density at each generator.

namespace calotte::io_detail {
namespace {

std::string beside_vertices(const std::string& path, std::string_view name) {
  return sibling(path, vertices_name, name).value_or(path);
}

void put_values(const Sink& sink, const DoubleVector& values) {
  Writer out(sink);
  for (const double value : values)
    out.number(value).text("\n");
  out.flush();
}

/// Orients the triangles counter-clockwise. Returns false if one has no orientation.
bool orient(const Points3& points, Triangles& triangles) {
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const int turning =
        orientation(column(points, triangles(0, t)), column(points, triangles(1, t)),
                    column(points, triangles(2, t)));
    if (turning == 0)
      return false;
    if (turning < 0)
      std::swap(triangles(1, t), triangles(2, t));
  }
  return true;
}

/// Whether the triangles cover the sphere: there are 2n - 4, and all have three neighbours.
bool close_sphere(const Points3& points, const Triangles& triangles) {
  return triangles.cols() == 2 * points.cols() - 4 &&
         neighbours_of(triangles, points.cols()).minCoeff() >= 0;
}

/// Reads the triangles from the file beside the points, if they match: those of another run, or a
/// part of them, do not cover the sphere.
Triangles read_triangles(const std::string& path, const Points3& points) {
  const std::string file = beside_vertices(path, triangles_name);
  if (std::error_code error; !std::filesystem::is_regular_file(file, error))
    return {};
  try {
    std::ifstream in = open_input(file);
    Triangles triangles = get_triangles_text(in, file, points.cols());
    if (orient(points, triangles) && close_sphere(points, triangles))
      return triangles;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::parse)
      throw;
  }
  return {};
}

/// Reads the density from the file beside the points. The file is ignored unless it has a finite,
/// non-negative number for each point.
void read_density(const std::string& path, RawMesh& raw) {
  const std::string file = beside_vertices(path, density_name);
  if (std::error_code error; !std::filesystem::is_regular_file(file, error))
    return;
  std::ifstream in = open_input(file);
  LineReader lines(in, file);
  std::vector<double> values;
  std::string_view line;
  bool valid = true;
  while (valid && lines.next_content(line)) {
    double value = 0;
    valid =
        parse_columns(line, 1, &value).outcome == Outcome::ok && value >= 0 && std::isfinite(value);
    values.push_back(value);
  }
  if (valid && std::ssize(values) == raw.points.cols())
    raw.density = Eigen::Map<const DoubleVector>(values.data(), std::ssize(values));
  else
    raw.ignored.push_back(std::string(density_name));
}

} // namespace

void write_mpi_scvt(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  Points3 units(3, mesh.points.cols());
  for (Eigen::Index i = 0; i < units.cols(); ++i)
    set_column(units, i, normalised(column(mesh.points, i)));
  const DoubleVector density =
      options.site_density.size() > 0 ? options.site_density : evaluate(options.density, units);
  OutputFile vertices(path), triangles(beside_vertices(path, triangles_name)),
      densities(beside_vertices(path, density_name));
  constexpr std::int64_t bytes_a_site = 60;
  vertices.watch(options.progress, bytes_a_site * mesh.points.cols());
  const auto to = [](OutputFile& file) {
    return [&file](std::string_view bytes) { file.append(bytes); };
  };
  put_points(to(vertices), mesh.points);
  put_triangle_lines(to(triangles), mesh.triangles);
  put_values(to(densities), density);
  triangles.commit();
  densities.commit();
  vertices.commit();
}

RawMesh read_mpi_scvt(const std::string& path) {
  RawMesh raw{read_points(path), {}};
  raw.triangles = read_triangles(path, raw.points);
  read_density(path, raw);
  return raw;
}

} // namespace calotte::io_detail
