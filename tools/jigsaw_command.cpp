// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/cell_width_option.h"
#include "options/delaunay_options.h"
#include "options/files.h"
#include "options/jig_file.h"
#include "options/warning.h"
#include "run/cvt_forecast.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/grid.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace calotte::tools {
namespace {

JigsawSizes sizes_of(const JigFile& jig, const JigsawGeometry& geometry) {
  constexpr double usual_most = 0.02;
  const std::string scale = jig.word("HFUN_SCAL", "relative");
  if (scale != "relative" && scale != "absolute")
    jig.refuse("HFUN_SCAL", "give RELATIVE or ABSOLUTE");
  JigsawSizes sizes;
  sizes.scale = scale == "relative" ? geometry.extent : 1;
  sizes.most =
      std::min(geometry.extent, sizes.scale * jig.number("HFUN_HMAX").value_or(usual_most));
  sizes.least = sizes.scale * std::max(0.0, jig.number("HFUN_HMIN").value_or(0));
  if (!(sizes.most > 0))
    jig.refuse("HFUN_HMAX", "give a number > 0");
  if (!(sizes.least <= sizes.most))
    jig.refuse("HFUN_HMIN", "give a number that is not above HFUN_HMAX");
  return sizes;
}

void take_widths(const JigFile& jig, const JigsawGeometry& geometry, Recipe& recipe) {
  const JigsawSizes sizes = sizes_of(jig, geometry);
  const std::optional<std::string> file = jig.text("HFUN_FILE");
  recipe.resolution =
      file ? Widths(read_jigsaw_widths(*file, sizes, geometry.surface)) : Widths(sizes.most);
}

/// The points of INIT_FILE: fixed ones, or with MESH_ITER = 0 all generators.
/// \returns a remark, or "".
std::string take_points(const JigFile& jig, Recipe& recipe) {
  const std::optional<std::string> file = jig.text("INIT_FILE");
  const bool alone = jig.whole("MESH_ITER").value_or(1) == 0;
  if (!file && alone)
    jig.refuse("MESH_ITER", "0 needs INIT_FILE, whose points are then the grid's");
  if (!file)
    return "";
  if (alone && !recipe.surface.is_sphere())
    jig.refuse("MESH_ITER", "0 applies to the sphere only; leave it out");
  const JigsawPoints init = read_jigsaw_points(*file, !recipe.surface.is_sphere());
  std::vector<Eigen::Index> fixed, free;
  for (std::size_t i = 0; i < init.fixed.size(); ++i)
    (init.fixed[i] ? fixed : free).push_back(static_cast<Eigen::Index>(i));
  recipe.fixed = init.points(Eigen::all, fixed);
  if (alone) {
    recipe.start.points = init.points(Eigen::all, free);
    recipe.start.kind = CvtStart::Kind::points;
    recipe.stop.well_centred = true;
    return "";
  }
  return free.empty() ? ""
                      : message("{}: {} points without a negative tag have no effect: the grid "
                                "does not depend on where it starts; with MESH_ITER=0 it has these "
                                "alone",
                                *file, free.size());
}

/// What to mesh, and remarks on options.
struct Job {
  Recipe recipe;
  double radius = 1; ///< of the sphere
  std::vector<std::string> remarks;
};

Job job_of(const JigFile& jig) {
  if (const int dimensions = jig.whole("MESH_DIMS").value_or(2); dimensions != 2)
    jig.refuse("MESH_DIMS", message("{}; only surfaces, 2, are meshed", dimensions));
  JigsawGeometry geometry = read_jigsaw_geometry(jig.file("GEOM_FILE"));
  Job job;
  Recipe& recipe = job.recipe;
  recipe.surface = geometry.surface;
  recipe.radius_km = job.radius = geometry.radius;
  take_widths(jig, geometry, recipe);
  job.remarks = jig.ignored();
  if (const std::string remark = take_points(jig, recipe); !remark.empty())
    job.remarks.push_back(remark);
  const bool given = recipe.start.kind == CvtStart::Kind::points;
  if (recipe.surface.is_bounded() && !given)
    recipe.boundary = Boundary::generators;
  if (!given)
    recipe.lines = std::move(geometry.lines);
  return job;
}

Cvt make_mesh(const Job& job, const std::optional<int>& threads, Progress& progress) {
  Cvt grid;
  with_threads(threads, [&] {
    const Schedule schedule = plan(job.recipe);
    RunOptions options;
    options.progress = [&](const calotte::Progress& now) {
      progress.stage(describe(*now.run, schedule), std::to_string(now.run->bisections_left));
      return ProgressReply::proceed;
    };
    grid = make_grid(schedule, std::move(options));
  });
  return grid;
}

void run_jigsaw(const std::string& path) {
  const JigFile jig(path);
  const std::string output = jig.file("MESH_FILE");
  require_outputs({{"mesh", output}},
                  {path, jig.file("GEOM_FILE"), jig.text("HFUN_FILE").value_or(""),
                   jig.text("INIT_FILE").value_or("")});
  const std::optional<int> threads = jig.threads();
  Progress progress;
  progress.stage("reading the widths");
  const Job job = job_of(jig);
  if (jig.whole("VERBOSITY").value_or(0) > 0)
    for (const std::string& remark : job.remarks)
      std::cout << message("calotte: {}\n", remark);
  Cvt grid = make_mesh(job, threads, progress);
  grid.mesh.points *= job.radius;
  write(output, grid.mesh, {.format = Format::msh, .progress = progress.writing(output)});
  std::cout << message("{}: {} points, {} triangles, {}{} s\n", output, grid.mesh.points.cols(),
                       grid.mesh.triangles.cols(), grid.report.well_centred ? "well-centred, " : "",
                       formatted("%.2f", grid.report.seconds));
  if (grid.report.cells_beyond_limits > 0)
    warn(message(
        "{} cells have shapes beyond the limits of models{}", grid.report.cells_beyond_limits,
        jig.text("HFUN_FILE") ? "; make the widths smoother, such as by marche"
                              : ", beside lines or the boundary; give a smaller HFUN_HMAX"));
}

} // namespace

void add_jigsaw(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "jigsaw",
      "Makes a mesh as JIGSAW's program of this name does. It reads the same options and files, "
      "and writes the same format. With libexec/calotte/jigsaw before other folders in PATH, "
      "programs that call jigsaw call this. See calotte help jig.");
  auto path = std::make_shared<std::string>();
  command->add_option("FILE", *path, "Options of JIGSAW (.jig)")->required()->type_name("FILE.jig");
  set_help(*command, {.common = {},
                      .examples = {"calotte jigsaw mesh.jig",
                                   "calotte jigsaw mesh.jig && calotte info mesh.msh"}});
  command->callback([path] { run_jigsaw(*path); });
}

} // namespace calotte::tools
