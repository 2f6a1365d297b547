// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "config_option.h"
#include "format_options.h"
#include "partition_options.h"
#include "progress.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/io.h>

#include <nlohmann/json.hpp>

#include <iostream>
#include <optional>

namespace calotte::tools {
namespace {

struct Request {
  std::string points, mesh, report;
  bool lonlat = false;
  std::shared_ptr<PartitionWords> partition;
  std::shared_ptr<FormatWords> format;
  std::shared_ptr<std::string> config;
};

struct Result {
  Mesh mesh;
  DelaunayReport report;
};

/// Everything about the output that can be known to fail, before any work.
void require_request(const Request& request) {
  options_of(*request.format, request.mesh); // throws for a file that could not be written
  require_outputs({{"mesh", request.mesh}, {"report", request.report}},
                  {request.points, centres_file(*request.partition), *request.config});
}

Result triangulate(const PointFile& input, const DelaunayOptions& options,
                   std::optional<int> threads) {
  Result result;
  try {
    with_threads(threads, [&] { result.mesh = delaunay(input.points, options, &result.report); });
  } catch (const Error& error) {
    rethrow_with_line(error, input);
  }
  return result;
}

WriteOptions write_options(const Request& request, const PointFile& input) {
  WriteOptions options = options_of(*request.format, request.mesh);
  options.history = "calotte " CALOTTE_VERSION " delaunay: " + request.points + ", " +
                    std::to_string(input.points.cols()) + " points; duplicates " +
                    request.partition->duplicates + "; merge-within " +
                    shortest(request.partition->merge_within);
  return options;
}

std::string to_json(const Result& result, double read, double write) {
  const DelaunayReport& report = result.report;
  nlohmann::ordered_json json;
  json["sites"] = report.sites;
  json["triangles"] = result.mesh.triangles.cols();
  json["closed"] = result.mesh.closed();
  json["duplicates"] = report.duplicates;
  json["regions"] = report.regions;
  json["threads"] = report.threads;
  json["one_region"] = report.one_region;
  json["overlap"] = report.overlap;
  json["seconds"] = {{"sites", report.seconds.sites},
                     {"regions", report.seconds.regions},
                     {"triangulate", report.seconds.triangulate},
                     {"unite", report.seconds.unite},
                     {"total", report.seconds.total},
                     {"read", read},
                     {"write", write}};
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

std::string summary(const Request& request, const Result& result) {
  const std::int64_t duplicates = result.report.duplicates;
  std::string line = request.mesh + ": " + std::to_string(result.mesh.points.cols()) + " sites, " +
                     std::to_string(result.mesh.triangles.cols()) + " triangles, ";
  line += result.mesh.closed() ? "closed" : "open: all sites lie in a hemisphere";
  if (duplicates > 0)
    line += ", " + std::to_string(duplicates) + (duplicates == 1 ? " duplicate" : " duplicates") +
            " merged";
  return line + "\n";
}

void run(const Request& request) {
  require_request(request);
  const DelaunayOptions options = options_of(*request.partition);
  Result result;
  {
    Progress progress;
    PointFile input;
    progress.stage("reading points");
    const double read =
        seconds_of([&] { input = read_point_file(request.points, request.lonlat); });
    progress.stage("triangulating " + std::to_string(input.points.cols()) + " points");
    result = triangulate(input, options, request.partition->threads);
    progress.stage("writing " + request.mesh);
    const double written =
        seconds_of([&] { write(request.mesh, result.mesh, write_options(request, input)); });
    if (!request.report.empty())
      write_file(request.report, to_json(result, read, written));
  }
  std::cout << summary(request, result);
}

} // namespace

void add_delaunay(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "delaunay",
      "Triangulate points on the sphere; the mesh is the same for any threads and regions.");
  auto request = std::make_shared<Request>();
  command
      ->add_option("POINTS,--points", request->points,
                   "text, x y z a line (directions of any norm); - is standard input; or the "
                   "points of a mesh, " +
                       std::string(mesh_suffixes))
      ->type_name("FILE")
      ->required();
  command->add_option("-o,--output", request->mesh, help_of_output())
      ->type_name("FILE")
      ->required();
  command->add_flag("--lonlat", request->lonlat,
                    "the text's points are longitude and latitude in degrees");
  request->partition = add_partition(*command);
  request->format = add_format(*command);
  command->add_option("--report", request->report, "a JSON file of times and counts")
      ->type_name("FILE");
  request->config = add_config(*command);
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
