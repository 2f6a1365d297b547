// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/numbers.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/io.h>

#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>

namespace calotte::tools {
namespace {

struct Request {
  std::string kind, output;
  std::int64_t count = 0;
  std::optional<std::uint64_t> seed;
  bool poles = false;
  std::shared_ptr<DomainWords> domain;

  bool planar() const { return kind == "random-plane" || kind == "hexagonal"; }
};

void require_options(const Request& request) {
  if (request.seed && request.kind != "random" && request.kind != "random-plane")
    throw Error(ErrorCode::bad_option, "--seed is for random points only; leave it out");
  if (request.planar() && !request.domain->given())
    throw Error(ErrorCode::bad_option,
                request.kind + " points are those of a domain of the plane; give it (--domain, "
                               "--rectangle or --periodic)");
  if (!request.planar() && request.domain->given())
    throw Error(ErrorCode::bad_option, request.kind + " points are on the sphere, which has no "
                                                      "other domain; leave it out, or ask for "
                                                      "random-plane or hexagonal points");
  if (request.poles && request.kind != "latlon")
    throw Error(ErrorCode::bad_option, "--poles is for latlon points only; leave it out");
  if (request.output == "-")
    return;
  if (holds_points(request.output) || std::filesystem::path(request.output).extension() == ".tri")
    throw Error(ErrorCode::bad_option, request.output + ": points are text, " +
                                           (request.planar() ? "x y" : "x y z") +
                                           " a line; give a name such as "
                                           "points.txt, and make a mesh with calotte delaunay");
  require_folder(request.output);
}

int level_of(std::int64_t count) {
  if (count < 0 || count > std::numeric_limits<int>::max())
    throw Error(ErrorCode::bad_option,
                "the level is " + std::to_string(count) + "; give a number from 0");
  return static_cast<int>(count);
}

Points3 generate(const Request& request) {
  if (request.kind == "random")
    return random_sphere(request.count, request.seed.value_or(1));
  if (request.kind == "fibonacci")
    return fibonacci_sphere(request.count);
  if (request.kind == "spiral")
    return spiral_sphere(request.count);
  if (request.kind == "icosahedron")
    return bisected_icosahedron(level_of(request.count));
  if (request.kind == "latlon")
    return lat_lon_sphere(request.count, 2 * request.count, request.poles);
  return cubed_sphere(request.count);
}

Points2 generate_in(const PlanarDomain& domain, const Request& request) {
  return request.kind == "hexagonal"
             ? hexagonal_lattice(request.count, domain)
             : random_places(request.count, domain, request.seed.value_or(1));
}

template <class Points> void put(const Points& points, const Request& request) {
  if (request.output == "-") {
    write_points(std::cout, points);
    return;
  }
  write_points(request.output, points);
  std::cout << request.output << ": " << points.cols() << " points\n";
}

void run(const Request& request) {
  require_options(request);
  if (const std::optional<PlanarDomain> domain = domain_of(*request.domain))
    put(generate_in(*domain, request), request);
  else
    put(generate(request), request);
}

} // namespace

void add_points(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("points", "Write a set of points, x y z a line; of a plane, x y.");
  auto request = std::make_shared<Request>();
  command
      ->add_option(
          "KIND", request->kind,
          "random, fibonacci, spiral, icosahedron, latlon or cubed (an equiangular cube) on "
          "the sphere; random-plane or hexagonal in a domain of the plane")
      ->required()
      ->check(CLI::IsMember({"random", "fibonacci", "spiral", "icosahedron", "latlon", "cubed",
                             "random-plane", "hexagonal"}));
  command
      ->add_option(
          "N", request->count,
          "the number of points; of bisections for icosahedron, of rows for latlon (with 2N "
          "columns), of cells along an edge for cubed; for hexagonal about that many")
      ->required();
  command->add_option("-o,--output", request->output, "the file; - is standard output")->required();
  command->add_option("--seed", request->seed, "of random points; default 1")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()));
  command->add_flag("--poles", request->poles, "add both poles to latlon");
  request->domain = add_domain(*command);
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
