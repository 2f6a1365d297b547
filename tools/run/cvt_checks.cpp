// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_checks.h"

#include "options/files.h"
#include "options/global_option.h"
#include "options/numbers.h"
#include "options/region_option.h"
#include "run/cvt_input.h"
#include "text/text.h"

#include <calotte/cut.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace calotte::tools {
namespace {

/// A mesh with walls is one of cells, which lose their periods in other formats.
void require_walls_format(const CvtRequest& request, const WriteOptions& options) {
  const Walls walls = walls_of(*request.domain);
  if ((walls.x || walls.y) && format_of(request.mesh, options.format) != Format::mpas)
    refuse_path(request.mesh, "a plane with walls is written as MPAS; give a name in .nc");
  if (request.domain->periodic && walls.x && walls.y)
    refuse("--walls xy leaves no period; give --rectangle, whose sides clip the cells");
}

/// Rejects options that a planar run does not support.
void require_plane(const CvtRequest& request, const WriteOptions& options) {
  require_walls_format(request, options);
  if (!request.points.empty() && request.domain->walls)
    refuse("--walls needs points beyond them, too; give --cells instead of START");
  require_no_sphere(request.format->sphere_radius, request.units);
}

/// Rejects formats and options that a run in a region does not support.
void require_region_format(const CvtRequest& request, const WriteOptions& options) {
  if (request.part.region.empty())
    return;
  if (planar(request))
    refuse("--region applies to the sphere only; leave it out, or the domain of the plane");
  const Format format = format_of(request.mesh, options.format);
  if (request.part.limited_area)
    require_mpas_name(request.mesh);
  if (!request.part.limited_area && format == Format::mpas_minimal)
    refuse_path(request.mesh, "minimal MPAS files hold whole cells, and the region clips those "
                              "along its boundary; write mpas, or give --limited-area");
  if (!request.part.limited_area && info_of(format).cells && ends_at_boundary(request.part))
    refuse_path(request.mesh, "this format has cells, whose centres --boundary generators puts on "
                              "the boundary; leave it out, or write triangles such as .vtp");
}

/// The name of the file that is written beside a full MPAS file; empty for other formats.
std::string graph_of(const std::string& mesh, Format format) {
  if (format_of(mesh, format) != Format::mpas)
    return "";
  return std::filesystem::path(mesh).replace_extension(".graph.info");
}

} // namespace

void require_no_sphere(const std::optional<double>& sphere_radius,
                       const std::optional<std::string>& units) {
  if (sphere_radius)
    refuse("--sphere-radius does not apply to the plane; leave it out");
  if (units)
    refuse("a plane has the unit of its coordinates; leave --units out");
}

void require_no_run(const CvtRequest& request, const std::set<std::string>& outputs) {
  std::set<std::string> allowed{"hexagons", "walls", "config", "threads"};
  allowed.insert(outputs.begin(), outputs.end());
  const auto exclude = [](const std::string& option) {
    refuse(message("--hexagons makes a uniform grid without a run; leave {} out", option));
  };
  if (!request.points.empty())
    exclude("START");
  if (!request.resume.empty())
    exclude("--resume");
  std::istringstream given(request.options);
  for (std::string line; std::getline(given, line);)
    if (const std::string name = line.substr(0, line.find('\t')); !allowed.contains(name))
      exclude("--" + name);
}

void require_hexagons(const CvtRequest& request) {
  require_no_run(request, {"output", "format", "for"});
  require_walls_format(request, write_options(request));
  require_outputs({{"mesh", request.mesh}}, {*request.config});
}

void require_request(const CvtRequest& request) {
  require_positive("--tolerance", request.given_tolerance.value_or(1), "one such as 1e-6");
  require_positive("--checkpoint-minutes", request.checkpoint_minutes, "one such as 10");
  require_start(request);
  const WriteOptions options = write_options(request); // throws for a file that cannot be written
  if (planar(request))
    require_plane(request, options);
  require_region_format(request, options);
  require_coast(request.coast, request.mesh, format_of(request.mesh, options.format));
  const bool of_memory =
      !request.budget.empty() && budget_of(request.budget, request.memory).bytes.has_value();
  if (!of_memory && !(request.memory == ModelMemory()))
    refuse(
        "--levels and --bytes-per-level apply to a budget of memory, such as --budget 24GiB; leave "
        "them out");
  if (request.units && !request.density->widths.in_km())
    refuse("--units is the unit of widths; leave it out, or give --cell-width");
  const WidthWords& widths = request.density->widths;
  std::vector<std::string> inputs = files_of(request.coast);
  inputs.insert(inputs.end(), {request.points, request.fixed, widths.file, widths.raster,
                               request.domain->file.value_or(""), *request.config,
                               region_file(request.part.region)});
  require_outputs({{"mesh", request.mesh},
                   {"graph of the mesh", graph_of(request.mesh, options.format)},
                   {"report", request.report},
                   {"checkpoint", request.checkpoint}},
                  inputs);
  // A run may overwrite the checkpoint from which it resumed.
  require_outputs({{"mesh", request.mesh}, {"report", request.report}}, {request.resume});
}

} // namespace calotte::tools
