// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/config_option.h"
#include "options/delaunay_options.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/point_file.h"
#include "run/memory_use.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/version.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <CLI/App.hpp>

#include <nlohmann/json.hpp>

#include <iostream>
#include <optional>
#include <utility>

namespace calotte::tools {
namespace {

struct DelaunayRequest {
  std::string points, mesh, report;
  bool lonlat = false, plane = false;
  std::optional<std::string> periodic;
  std::shared_ptr<DelaunayWords> delaunay;
  std::shared_ptr<FormatWords> format;
  std::shared_ptr<std::string> config;
};

/// Checks all options that can fail, before any work.
void require_request(const DelaunayRequest& request) {
  if (request.periodic && !request.plane && !holds_points(request.points))
    refuse("--periodic requires --plane, which reads x y on each line of a text");
  period_of(request.periodic);               // throws for an invalid box
  options_of(*request.format, request.mesh); // throws for a file that cannot be written
  require_outputs({{"mesh", request.mesh}, {"report", request.report}},
                  {request.points, *request.config});
}

/// The box of --periodic, or else the surface that the points have.
Surface surface_of(const DelaunayRequest& request, const Surface& own) {
  if (own.is_sphere() && request.periodic)
    refuse_path(request.points, "it holds points of the sphere; leave --periodic out");
  if (!own.is_sphere() && request.format->sphere_radius)
    refuse("--sphere-radius does not apply to a plane; leave it out");
  const std::optional<Eigen::Vector2d> period = period_of(request.periodic);
  if (period && !own.period().isZero(0) && own.period() != *period)
    refuse_path(request.points, "its periodic box is {} x {}; leave --periodic out",
                shortest(own.period().x()), shortest(own.period().y()));
  return period ? Surface::periodic(*period) : own;
}

Triangulation triangulate(PointFile&& input, const Surface& surface,
                          const DelaunayOptions& options) {
  try {
    return calotte::triangulate(std::move(input.points), surface, options);
  } catch (const Error& error) {
    rethrow_with_line(error, input.name, input.lines);
  }
}

WriteOptions write_options(const DelaunayRequest& request, std::int64_t points) {
  WriteOptions options = options_of(*request.format, request.mesh);
  options.history =
      message("calotte " CALOTTE_VERSION " delaunay: {}, {} points; duplicates {}; merge-within {}",
              request.points, points, request.delaunay->duplicates,
              shortest(request.delaunay->merge_within));
  return options;
}

std::string to_json(const Triangulation& result, double read, double write) {
  const DelaunayReport& report = result.report;
  nlohmann::ordered_json json;
  json["sites"] = report.sites;
  json["triangles"] = result.mesh.triangles.cols();
  json["closed"] = result.mesh.closed();
  json["duplicates"] = report.duplicates;
  json["regions"] = report.regions;
  json["threads"] = report.threads;
  json["serial"] = report.serial;
  json["overlap"] = report.overlap;
  json["seconds"] = {{"sites", report.seconds.sites},
                     {"regions", report.seconds.regions},
                     {"triangulate", report.seconds.triangulate},
                     {"unite", report.seconds.unite},
                     {"total", report.seconds.total},
                     {"read", read},
                     {"write", write}};
  json["memory"] = memory_use();
  json["certified_by_cull"] = report.certified_by_cull;
  json["certified_by_query"] = report.certified_by_query;
  json["halo_insertions"] = report.halo_insertions;
  json["seam_triangles"] = report.seam_triangles;
  json["filtered_predicates"] = report.filtered_predicates;
  json["exact_predicates"] = report.exact_predicates;
  json["sites_per_region"] = report.sites_per_region;
  json["owned_per_region"] = report.owned_per_region;
  json["seconds_per_region"] = report.seconds_per_region;
  return json.dump(2) + "\n";
}

std::string kind_of(const Mesh& mesh) {
  if (mesh.surface.is_sphere())
    return mesh.closed() ? "closed" : "open: all sites lie in a hemisphere";
  if (mesh.closed())
    return "periodic";
  return message("{} sites on the hull", 2 * mesh.points.cols() - 2 - mesh.triangles.cols());
}

std::string summary(const DelaunayRequest& request, const Triangulation& result) {
  const std::int64_t duplicates = result.report.duplicates;
  return message("{}: {} sites, {} triangles, {}{}\n", request.mesh, result.mesh.points.cols(),
                 result.mesh.triangles.cols(), kind_of(result.mesh),
                 duplicates > 0 ? message(", {} merged", counted(duplicates, "duplicate")) : "");
}

/// What a model reads of the file.
std::string remarks(const DelaunayRequest& request, const WriteOptions& output, bool on_sphere) {
  std::string lines;
  if (output.site_density.size() > 0)
    lines += derived_density(request.mesh, output.site_density);
  if (on_sphere)
    lines += suited_models(request.mesh, output);
  return lines;
}

/// For the points of an open mesh, such as a region, a line that warns: the triangulation covers
/// what lies beyond its boundary, too. Empty for other input, and where the mesh cannot be read.
std::string warning_of(const std::string& points, bool closed) {
  if (!closed || !holds_points(points))
    return {};
  try {
    const MeshFile file = read_mesh_file(points, nullptr, FieldChoice::none);
    if (!file.mesh || file.mesh->closed())
      return {};
    return message("{}: its mesh is open, with {} triangles; the new one closes the sphere\n",
                   points, file.mesh->triangles.cols());
  } catch (const Error&) {
    return {}; // the points alone are used
  }
}

/// \returns the lines to print.
std::string triangulate_file(const DelaunayRequest& request, DelaunayOptions options) {
  Progress progress;
  PointFile input;
  progress.stage("reading points");
  const double read = seconds_of(
      [&] { input = read_point_file(request.points, columns_of(request.plane, request.lonlat)); });
  const std::int64_t points = input.points.cols();
  const Surface surface = surface_of(request, input.surface);
  progress.stage(message("triangulating {} points", points));
  options.progress = progress.bar();
  const Triangulation result = triangulate(std::move(input), surface, options);
  WriteOptions output = write_options(request, points);
  output.progress = progress.writing(request.mesh);
  const double written = seconds_of([&] {
    if (is_mpas(output.format) && result.mesh.closed())
      output.site_density = spacing_density(voronoi(result.mesh));
    write(request.mesh, result.mesh, output);
  });
  if (!request.report.empty())
    write_file(request.report, to_json(result, read, written));
  return warning_of(request.points, surface.is_sphere() && result.mesh.closed()) +
         remarks(request, output, surface.is_sphere()) + summary(request, result);
}

void run(const DelaunayRequest& request) {
  require_request(request);
  with_threads(request.delaunay->threads,
               [&] { std::cout << triangulate_file(request, options_of(*request.delaunay)); });
}

} // namespace

void add_delaunay(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("delaunay", "Triangulates points on the sphere or in the plane. The mesh "
                                     "has the same bits for any number of threads and regions.");
  auto request = std::make_shared<DelaunayRequest>();
  command
      ->add_option("POINTS,--points", request->points,
                   "Input points: text with x y z on each line (vectors of any length), - for "
                   "standard input, or the points of a mesh. Meshes: " +
                       names_of_read_meshes())
      ->type_name("FILE")
      ->required();
  command->add_option("-o,--output", request->mesh, help_of_output())
      ->type_name("FILE")
      ->required();
  CLI::Option* lonlat = command->add_flag("--lonlat", request->lonlat,
                                          "The points are longitude and latitude in degrees");
  command
      ->add_flag("--plane", request->plane,
                 "The points are text with x y on each line; files of meshes know that they "
                 "are planar. The mesh is .vtp, .vtu, .off, .ply, .msh, .txt or .tri")
      ->excludes(lonlat);
  add_periodic(*command, request->periodic);
  request->delaunay = add_delaunay_options(*command);
  request->format = add_format(*command);
  command->add_option("--report", request->report, "Write times and counts to this JSON file")
      ->type_name("FILE");
  request->config = add_config(*command);
  set_help(*command, {.common = {"POINTS", "--output", "--lonlat", "--plane", "--periodic",
                                 "--threads", "--duplicates", "--merge-within", "--for", "--format",
                                 "--sphere-radius", "--report", "--config"},
                      .examples = {"calotte delaunay points.txt -o mesh.vtp",
                                   "calotte delaunay stations.csv --lonlat -o mesh.nc"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
