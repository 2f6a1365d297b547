// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "options/mesh_source.h"
#include "options/model_option.h"
#include "run/exit_code.h"
#include "run/mesh_findings.h"
#include "run/model_gates.h"
#include "run/progress.h"
#include "run/shapes.h"
#include "text/text.h"

#include <calotte/check.h>
#include <calotte/mesh_file.h>

#include <CLI/App.hpp>

#include <iomanip>
#include <iostream>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

/// What the areas are compared with.
std::string area_line(const CheckReport& result, bool plane) {
  std::ostringstream line;
  line << (plane && result.boundary_edges > 0 ? "area / hull     "
           : plane                            ? "area / box      "
                                              : "area / 4 pi     ")
       << std::setprecision(15)
       << result.area / (plane ? result.expected_area : 4 * std::numbers::pi);
  return line.str();
}

std::string table(const Findings& found, bool plane) {
  std::ostringstream out;
  out << "sites           " << found.check.sites << "\n"
      << "triangles       " << found.check.triangles << "\n"
      << "boundary edges  " << found.check.boundary_edges << "\n";
  if (found.check.area > 0) // an earlier law is kept
    out << area_line(found.check, plane) << "\n";
  if (const std::optional<EdgeCounts>& edges = found.edges) {
    out << "not Delaunay    " << edges->not_delaunay << " edges\n"
        << "cocircular      " << edges->cocircular << " edges take the other diagonal\n";
    if (edges->boundary > 0)
      out << "boundaries      " << edges->loops << ", not convex at " << edges->not_convex
          << " sites\n";
    if (edges->unused_sites > 0)
      out << "unused          " << edges->unused_sites << " sites are in no triangle\n";
  }
  out << "Delaunay        "
      << (found.delaunay          ? "yes, all checks passed"
          : found.failure.empty() ? "yes, every edge"
                                  : "no")
      << "\n";
  return out.str();
}

/// \param found the shapes of the file's polygons.
std::string table(const PolygonShapes& found, const MeshFile& file) {
  const bool part = file.not_voronoi.passed(); // a boundary may cut its cells
  std::ostringstream out;
  out << "cells           " << file.polygons->size() << "\n"
      << "corners         " << file.polygons->corners.cols() << "\n"
      << "Voronoi         "
      << (part ? "yes, inside the boundary" : "no: " + file.not_voronoi.text()) << "\n";
  if (part)
    return out.str();
  const bool open = !file.sphere() || !file.mesh->closed(); // its edges are counted with the mesh
  return out.str() + shape_rows(found, open ? std::nullopt : file.mesh, 16);
}

/// Why deviations make the check fail; empty if they do not.
std::string failure_of(const std::vector<Deviation>& deviations) {
  std::set<std::string> variables;
  for (const Deviation& deviation : deviations)
    if (!deviation.known)
      variables.insert(deviation.variable);
  if (variables.empty())
    return "";
  return message("{} {} from the mesh or the format: {}",
                 counted(std::ssize(variables), "variable"),
                 variables.size() == 1 ? "deviates" : "deviate", listed(variables));
}

void run_check(const MeshSource& source, const std::optional<std::string>& word) {
  std::string text;
  std::vector<std::string> failures;
  const auto add = [&failures](std::string failure) {
    if (!failure.empty())
      failures.push_back(std::move(failure));
  };
  {
    Progress progress;
    progress.stage("reading " + source.path);
    MeshFile file = read_mesh_file(source, FieldChoice::none);
    progress.stage("checking " + source.path);
    text = changes_of(source, file);
    const ModelNeeds* model = model_of(word);
    if (has_own_triangles(file)) {
      const Findings found = findings_of(*file.mesh, progress.bar());
      text += table(found, file.plane() != nullptr);
      add(found.failure);
    }
    if (file.polygons) {
      const PolygonShapes found = shapes(*file.polygons);
      text += table(found, file);
      add(without_area(found));
    }
    if (model != nullptr && failures.empty()) {
      if (has_demanded_cells(file)) {
        const ModelGates found = gates_of(*model, source.path, file);
        text += table(found);
        add(failure_of(found));
      } else {
        add(no_demanded_cells(*model));
      }
      add(unsuited(*model, file));
    }
    progress.stage("comparing the variables of " + source.path);
    const std::vector<Deviation> deviations = check_file(source.path, std::move(file));
    for (const Deviation& deviation : deviations)
      text += deviation.text + "\n";
    add(failure_of(deviations));
  }
  std::cout << text;
  if (!failures.empty())
    finish(check_failed, message("{}: failed: {}", source.path, listed(failures, "; ", "; ")));
  std::cout << source.path << ": passed\n";
}

} // namespace

void add_check(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "check",
      "Proves in exact arithmetic that a mesh is the Delaunay triangulation of its points. It "
      "compares the other variables of a NetCDF file with it, too.");
  auto source = add_mesh_source(*command);
  auto model = std::make_shared<std::optional<std::string>>();
  add_demanding_model(*command, *model);
  add_plane(*command, *source, {"--for"});
  set_help(*command,
           {.common = {},
            .examples = {"calotte check mesh.nc", "calotte check mesh.nc --for mpas-atmosphere",
                         "calotte check mesh.tri --points points.txt"}});
  command->callback([source, model] { run_check(*source, *model); });
}

} // namespace calotte::tools
