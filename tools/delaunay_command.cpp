// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "progress.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/io.h>

#include <nlohmann/json.hpp>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <charconv>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <optional>

namespace calotte::tools {
namespace {

struct Request {
  std::string points, mesh, report;
  bool lonlat = false;
  std::optional<int> threads, regions;
  std::string centres = "sample", sort = "halo", duplicates = "merge";
  double merge_within = 0;
};

/// The points with the lines they stand on, for messages.
struct Input {
  std::string name;
  Points3 points;
  std::vector<std::int64_t> lines;
};

struct Result {
  Mesh mesh;
  DelaunayReport report;
};

CLI::Validator whole_number(int least, int most) {
  const std::string range = most == std::numeric_limits<int>::max()
                                ? std::to_string(least) + " or more"
                                : "from " + std::to_string(least) + " to " + std::to_string(most);
  return {[=](const std::string& text) {
            int value = least - 1;
            const char* const end = text.data() + text.size();
            const bool whole = std::from_chars(text.data(), end, value).ptr == end;
            return whole && least <= value && value <= most
                       ? std::string()
                       : "\"" + text + "\" is not a whole number " + range;
          },
          "N"};
}

/// Everything about the output that can be known to fail, before any work.
void require_outputs(const Request& request) {
  require_mesh_suffix(request.mesh);
  require_folder(request.mesh);
  require_distinct(request.mesh, request.points);
  if (request.report.empty())
    return;
  require_folder(request.report);
  require_distinct(request.report, request.points);
  if (std::filesystem::path(request.report).lexically_normal() ==
      std::filesystem::path(request.mesh).lexically_normal())
    throw Error(ErrorCode::bad_option,
                request.report + " is both mesh and report; give the report another name");
}

Points3 read_centres(const Request& request) {
  if (request.regions)
    throw Error(ErrorCode::bad_option,
                "--regions and a file of centres exclude each other; leave one of them out");
  if (std::error_code absent;
      request.centres != "-" && !std::filesystem::exists(request.centres, absent))
    throw Error(ErrorCode::bad_option,
                "--centres " + request.centres +
                    " is not a file; give sample, fibonacci or a file of points");
  return points_from(request.centres, Columns::xyz);
}

DelaunayOptions options_of(const Request& request) {
  static const std::map<std::string, Sort> sorts{
      {"halo", Sort::halo}, {"distance", Sort::distance}, {"voronoi", Sort::voronoi}};
  DelaunayOptions options;
  options.regions = request.regions;
  options.sort = sorts.at(request.sort);
  options.duplicates = request.duplicates == "merge" ? Duplicates::merge : Duplicates::refuse;
  options.merge_within = request.merge_within;
  if (request.centres == "fibonacci")
    options.centres = Centres::fibonacci;
  else if (request.centres != "sample")
    options.given_centres = read_centres(request);
  return options;
}

Input read_input(const Request& request) {
  const Columns columns = request.lonlat ? Columns::lonlat : Columns::xyz;
  Input input;
  input.name = request.points == "-" ? "standard input" : request.points;
  input.points = points_from(request.points, columns, &input.lines);
  return input;
}

/// delaunay() names the column; who wrote the file looks for the line.
[[noreturn]] void rethrow_with_line(const Error& error, const Input& input) {
  const bool of_input = error.code() == ErrorCode::not_finite ||
                        error.code() == ErrorCode::zero_vector ||
                        error.code() == ErrorCode::duplicate;
  if (!of_input || error.index() < 0 ||
      error.index() >= static_cast<std::int64_t>(input.lines.size()))
    throw error;
  const std::int64_t line = input.lines[static_cast<std::size_t>(error.index())];
  throw Error(error.code(), input.name + " line " + std::to_string(line) + ": " + error.what(),
              line);
}

Result triangulate(const Input& input, const DelaunayOptions& options, std::optional<int> threads) {
  std::optional<tbb::global_control> control;
  if (threads)
    control.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(*threads));
  tbb::task_arena arena(threads ? *threads : int{tbb::task_arena::automatic});
  Result result;
  try {
    arena.execute([&] { result.mesh = delaunay(input.points, options, &result.report); });
  } catch (const Error& error) {
    rethrow_with_line(error, input);
  }
  return result;
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
  require_outputs(request);
  const DelaunayOptions options = options_of(request);
  Result result;
  {
    Progress progress;
    Input input;
    progress.stage("reading points");
    const double read = seconds_of([&] { input = read_input(request); });
    progress.stage("triangulating " + std::to_string(input.points.cols()) + " points");
    result = triangulate(input, options, request.threads);
    progress.stage("writing " + request.mesh);
    const double written = seconds_of([&] { write(request.mesh, result.mesh); });
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
      ->add_option("POINTS", request->points,
                   "text, x y z a line (directions of any norm); - is standard input")
      ->required();
  command
      ->add_option("-o,--output", request->mesh,
                   "the mesh; its suffix names the format: .txt .tri .vtp .vtu .off .ply")
      ->required();
  command->add_flag("--lonlat", request->lonlat,
                    "the points are longitude and latitude in degrees");
  command->add_option("--threads", request->threads, "threads to use; default all")
      ->check(whole_number(1, 4096));
  command
      ->add_option("--regions", request->regions,
                   "regions to divide the sphere into; default from "
                   "the number of points")
      ->check(whole_number(1, std::numeric_limits<int>::max()));
  command
      ->add_option("--centres", request->centres,
                   "the regions' centres: sample (a coarse CVT of the points), fibonacci, or a "
                   "file of points")
      ->capture_default_str();
  command->add_option("--sort", request->sort, "which points a region takes beside its own")
      ->check(CLI::IsMember({"halo", "distance", "voronoi"}))
      ->capture_default_str();
  command->add_option("--duplicates", request->duplicates, "what to do with equal directions")
      ->check(CLI::IsMember({"merge", "refuse"}))
      ->capture_default_str();
  command->add_option("--merge-within", request->merge_within,
                      "merge points nearer than this to an earlier one, radians");
  command->add_option("--report", request->report, "a JSON file of times and counts");
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
