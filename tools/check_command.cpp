// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "progress.h"

#include <calotte/check.h>

#include <iomanip>
#include <iostream>
#include <numbers>

namespace calotte::tools {
namespace {

Check read_and_check(const MeshSource& source) {
  Progress progress;
  progress.stage("reading " + source.path);
  const Mesh mesh = read_mesh(source);
  progress.stage("checking " + source.path);
  return check(mesh);
}

void run(const MeshSource& source) {
  const Check result = read_and_check(source);
  std::cout << "sites           " << result.sites << "\n"
            << "triangles       " << result.triangles << "\n"
            << "boundary edges  " << result.boundary_edges << "\n"
            << "area / 4 pi     " << std::setprecision(15) << result.area / (4 * std::numbers::pi)
            << "\n"
            << "Delaunay        " << (result.passed() ? "yes, all checks passed" : "no") << "\n";
  if (result.passed())
    return;
  std::cout.flush();
  std::cerr << "calotte: " + source.path + ": " + result.failure + "\n";
  finish(check_failed);
}

} // namespace

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "check",
      "Prove in exact arithmetic that a mesh is the Delaunay triangulation of its points.");
  auto source = add_mesh_source(*command);
  command->callback([source] { run(*source); });
}

} // namespace calotte::tools
