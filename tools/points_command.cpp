// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/numbers.h"
#include "run/interruption.h"
#include "text/text.h"

#include <calotte/generators.h>
#include <calotte/write.h>

#include <CLI/App.hpp>

#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>

namespace calotte::tools {
namespace {

struct PointsRequest {
  std::string kind, output;
  std::int64_t count = 0;
  std::optional<std::uint64_t> seed;
  bool poles = false;
  std::shared_ptr<DomainWords> domain;

  bool planar() const { return kind == "random-plane" || kind == "hexagonal"; }
};

void require_request(const PointsRequest& request) {
  if (request.seed && request.kind != "random" && request.kind != "random-plane")
    refuse("--seed applies to random points only; leave it out");
  if (request.planar() && !request.domain->given())
    refuse(message("{} points need a planar domain; give --domain, --rectangle or --periodic",
                   request.kind));
  if (!request.planar() && request.domain->given())
    refuse(message(
        "{} points lie on the sphere; leave the domain out, or give random-plane or hexagonal",
        request.kind));
  if (request.poles && request.kind != "latlon")
    refuse("--poles applies to latlon points only; leave it out");
  if (request.output == "-")
    return;
  if (holds_points(request.output) || std::filesystem::path(request.output).extension() == ".tri")
    refuse_path(request.output,
                "points are text with {} on each line; give a name such as points.txt; calotte "
                "delaunay makes a mesh of them",
                request.planar() ? "x y" : "x y z");
  require_outputs({{"points", request.output}}, {request.domain->file.value_or("")});
}

/// The number of bisections of an icosahedron that gives so many points, 10 4^level + 2.
int level_of(std::int64_t count) {
  constexpr int most = 13; // 671 088 642 points
  std::int64_t fewer = 0;
  for (int level = 0; level <= most; ++level) {
    const std::int64_t points = 10 * (std::int64_t{1} << 2 * level) + 2;
    if (points == count)
      return level;
    if (points > count)
      refuse(message("a bisected icosahedron has 12, 42, 162, 642 and so on points, not {}; give "
                     "{}{}",
                     count, fewer > 0 ? message("{} or ", fewer) : "", points));
    fewer = points;
  }
  refuse(
      message("a bisected icosahedron of {} points is too large; give {} or fewer", count, fewer));
}

Points3 generate(const PointsRequest& request) {
  if (request.kind == "random")
    return random_sphere(request.count, request.seed.value_or(1));
  if (request.kind == "fibonacci")
    return fibonacci_sphere(request.count);
  if (request.kind == "spiral")
    return spiral_sphere(request.count);
  if (request.kind == "geodesic")
    return geodesic_sphere(request.count);
  if (request.kind == "icosahedron")
    return bisected_icosahedron(level_of(request.count));
  if (request.kind == "latlon")
    return lat_lon_sphere(request.count, 2 * request.count, request.poles);
  return cubed_sphere(request.count);
}

Points2 generate_in(const Surface& part, const PointsRequest& request) {
  return request.kind == "hexagonal"
             ? hexagonal_lattice(request.count, part).topRows<2>()
             : random_points(request.count, part, {}, request.seed.value_or(1)).topRows<2>();
}

template <class Points> void put(const Points& points, const PointsRequest& request) {
  if (request.output == "-") {
    write_points(std::cout, points);
    return;
  }
  announce_files();
  write_points(request.output, points);
  std::cout << message("{}: {} points\n", request.output, points.cols());
}

void run(const PointsRequest& request) {
  require_request(request);
  if (const std::optional<Surface> part = surface_of(*request.domain))
    put(generate_in(*part, request), request);
  else
    put(generate(request), request);
}

} // namespace

void add_points(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("points", "Writes points as text: x y z on each line, in the plane x y.");
  auto request = std::make_shared<PointsRequest>();
  command
      ->add_option(
          "KIND", request->kind,
          "Points on the sphere: random, fibonacci, spiral, icosahedron (bisected), geodesic (12 "
          "points of five neighbours, all others of six), latlon or cubed (equiangular cubed "
          "sphere); in a planar domain: random-plane or hexagonal")
      ->required()
      ->check(CLI::IsMember({"random", "fibonacci", "spiral", "icosahedron", "geodesic", "latlon",
                             "cubed", "random-plane", "hexagonal"}));
  command
      ->add_option("N", request->count,
                   "Number of points: for icosahedron 12, 42, 162, 642 and so on (10 4^k + 2), for "
                   "hexagonal an approximate number. For latlon the number of rows (with 2N "
                   "columns), for cubed the number of cells along an edge")
      ->required();
  command->add_option("-o,--output", request->output, "Output file; - for standard output")
      ->type_name("FILE")
      ->required();
  command->add_option("--seed", request->seed, "Seed of random points, >= 0; default: 1")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command->add_flag("--poles", request->poles, "Add both poles to latlon");
  request->domain = add_domain(*command);
  set_help(*command, {.common = {},
                      .examples = {"calotte points fibonacci 100000 -o points.txt",
                                   "calotte points random 1000 --seed 2 -o -"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
