// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "options/mesh_source.h"
#include "run/exit_code.h"
#include "run/progress.h"

#include <calotte/check.h>

#include <iomanip>
#include <iostream>
#include <numbers>
#include <sstream>
#include <string>

namespace calotte::tools {
namespace {

Check read_and_check(const MeshSource& source) {
  Progress progress;
  progress.stage("reading " + source.path);
  const auto checked = [&](const auto& mesh) {
    progress.stage("checking " + source.path);
    return check(mesh);
  };
  return source.plane ? checked(read_planar_mesh(source)) : checked(read_mesh(source));
}

/// What the areas are compared with.
std::string area_line(const Check& result, bool plane) {
  std::ostringstream line;
  line << (plane && result.boundary_edges > 0 ? "area / hull     "
           : plane                            ? "area / box      "
                                              : "area / 4 pi     ")
       << std::setprecision(15) << result.area / (plane ? result.whole : 4 * std::numbers::pi);
  return line.str();
}

void run(const MeshSource& source) {
  const Check result = read_and_check(source);
  std::cout << "sites           " << result.sites << "\n"
            << "triangles       " << result.triangles << "\n"
            << "boundary edges  " << result.boundary_edges << "\n"
            << area_line(result, source.plane) << "\n"
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
      "Proves in exact arithmetic that a mesh is the Delaunay triangulation of its points.");
  auto source = add_mesh_source(*command);
  add_plane(*command, *source);
  command->callback([source] { run(*source); });
}

} // namespace calotte::tools
