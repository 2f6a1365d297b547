// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "options/config_option.h"
#include "options/density_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/mesh_source.h"
#include "run/progress.h"

#include <calotte/error.h>
#include <calotte/io.h>
#include <calotte/version.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <variant>

namespace calotte::tools {
namespace {

struct Request {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::shared_ptr<FormatWords> format;
  std::shared_ptr<std::string> config;
  std::string output;
};

using AnyMesh = std::variant<Mesh, PlanarMesh>;

/// All that can be known to fail before anything is read.
void require_request(const Request& request) {
  const MeshSource& source = *request.source;
  options_of(*request.format, request.output); // throws for a file that could not be written
  const WidthWords& widths = request.density->widths;
  require_outputs({{"mesh", request.output}},
                  {source.path, source.points, widths.file, widths.raster, *request.config});
  if (source.points.empty() && (source.path == "-" || holds_triangles(source.path)))
    throw Error(ErrorCode::bad_option,
                source.path +
                    " holds triangles without points; give the points with --points FILE, or, if "
                    "the file holds points, triangulate them with calotte delaunay");
}

/// A mesh of the sphere, or else of the plane.
AnyMesh read(const MeshSource& source) {
  if (source.plane)
    return read_planar_mesh(source);
  try {
    return read_mesh(source);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_option)
      throw;
    try {
      return calotte::read_planar_mesh(source.path);
    } catch (const Error& other) {
      throw other.code() == ErrorCode::bad_option ? error : other;
    }
  }
}

/// Of the sphere that all points stand on but for their digits, with 12 of its own; 1 where there
/// is none.
double radius_of(const Points3& points) {
  constexpr double rounding = 1e-6;
  const Eigen::RowVectorXd norms = points.colwise().stableNorm();
  const double mean = norms.mean();
  if (!((norms.array() - mean).abs() <= rounding * mean).all())
    return 1;
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.12g", mean);
  return std::strtod(text.data(), nullptr);
}

WriteOptions write_options(const Request& request, const Density& density, const AnyMesh& mesh) {
  WriteOptions options = options_of(*request.format, request.output);
  if (const auto* sphere = std::get_if<Mesh>(&mesh); sphere && !request.format->sphere_radius)
    options.sphere_radius = radius_of(sphere->points);
  options.density = density;
  options.history = "calotte " CALOTTE_VERSION " convert: " + request.source->path;
  return options;
}

std::string describe(const Mesh& mesh) {
  return std::to_string(mesh.points.cols()) + " sites, " + std::to_string(mesh.triangles.cols()) +
         " triangles, " + (mesh.closed() ? "closed" : "open");
}

std::string describe(const PlanarMesh& mesh) {
  return std::to_string(mesh.points.cols()) + " sites, " + std::to_string(mesh.triangles.cols()) +
         " triangles, a " + (mesh.period.minCoeff() > 0 ? "periodic plane" : "plane");
}

void run(const Request& request) {
  require_request(request);
  const Density density = density_of(*request.density);
  std::string words;
  {
    Progress progress;
    progress.stage("reading " + request.source->path);
    const AnyMesh any = read(*request.source);
    progress.stage("writing " + request.output);
    const WriteOptions options = write_options(request, density, any);
    std::visit([&](const auto& mesh) { write(request.output, mesh, options); }, any);
    words = std::visit([](const auto& mesh) { return describe(mesh); }, any);
  }
  std::cout << request.output + ": " + words + "\n";
}

} // namespace

void add_convert(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "convert", "Converts a mesh to another format. Points and triangles do not change.");
  auto request = std::make_shared<Request>();
  request->source = add_mesh_source(*command, "IN,--input");
  add_plane(*command, *request->source);
  command->add_option("OUT,-o,--output", request->output, help_of_output())
      ->type_name("FILE")
      ->required();
  request->format =
      add_format(*command, "the radius of the points if all lie on one sphere, else 1");
  request->density = add_density(*command);
  request->config = add_config(*command);
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
