// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_input.h"

#include "io/command.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/point_file.h"
#include "options/region_option.h"
#include "options/units_option.h"
#include "run/extent.h"
#include "text/text.h"

#include <calotte/read.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

namespace calotte::tools {
namespace {

// ---- Points

/// "NAME n with checksum c", a line of the configuration.
template <class Points> std::string fingerprint(const std::string& name, const Points& points) {
  boost::crc_32_type checksum;
  checksum.process_bytes(points.data(), sizeof(double) * static_cast<std::size_t>(points.size()));
  return message("{} {} with checksum {}\n", name, points.cols(), checksum.checksum());
}

/// The points of a file of either kind, in the plane with z = 0.
/// \param name of them in the configuration, whose line is added.
Points3 read(const CvtRequest& request, const std::string& path, const std::string& name,
             CvtInput::File& origin, std::string& configuration) {
  const bool plane = planar(request);
  PointFile file = read_point_file(path, columns_of(plane, request.lonlat));
  if (!plane && !file.surface.is_sphere())
    refuse_path(path, "it holds points of a plane; give its domain (--rectangle, --domain or "
                      "--periodic)");
  origin = {std::move(file.name), std::move(file.lines)};
  configuration =
      plane ? fingerprint(name, Points2(file.points.topRows<2>())) : fingerprint(name, file.points);
  return std::move(file.points);
}

/// Generators that stay, or lines that they follow.
void read_fixed(const CvtRequest& request, CvtInput& input) {
  Recipe& recipe = input.recipe;
  if (request.fixed != "-")
    recipe.lines = lines_in(request.fixed, recipe.surface);
  if (recipe.lines.empty()) {
    recipe.fixed = read(request, request.fixed, "fixed", input.fixed_file, input.fixed);
    return;
  }
  input.fixed_file.name = request.fixed;
  input.fixed = message("lines of {}\n", checksum_of(request.fixed));
}

// ---- The recipe

CvtStart::Kind start_named(const std::string& word) {
  return std::ranges::find(start_words(), word, &NamedValue<CvtStart::Kind>::word)->value;
}

CvtStart start_of(const CvtRequest& request) {
  CvtStart start;
  if (request.start)
    start.kind = start_named(*request.start);
  start.bisections = request.bisections;
  start.insertion_rounds = request.insertion_rounds;
  return start;
}

CvtStop stop_of(const CvtRequest& request) {
  CvtStop stop;
  stop.norm = std::ranges::find(norm_words(), request.norm, &NamedValue<Norm>::word)->value;
  stop.tolerance = request.given_tolerance;
  stop.max_iterations = request.max_iterations;
  stop.iterations = request.iterations;
  if (request.stop)
    stop.well_centred = *request.stop == "well-centred";
  stop.least_spacing = request.least_spacing.value_or(stop.least_spacing);
  stop.most_off_midpoint = request.most_off_midpoint.value_or(stop.most_off_midpoint);
  return stop;
}

} // namespace

void require_start(const CvtRequest& request) {
  require_region_words(request.part);
  if (planar(request) && request.lonlat)
    refuse("--lonlat applies to the sphere only; leave it out");
  const bool file = !request.points.empty();
  if (ends_at_boundary(request.part) && file)
    refuse("--boundary generators does not apply to a file of points; give --cells, or fixed "
           "points on the boundary (--fixed)");
  if (request.fixed == "-" && request.points == "-")
    refuse("START and --fixed are both standard input; give a file for one of them");
  const auto exclude = [&](bool given, const std::string& option) {
    if (file && given)
      refuse(message("the start is the file {}; leave {} out", request.points, option));
  };
  exclude(request.cells.has_value() || request.cells_of_widths, "--cells");
  exclude(request.start.has_value(), "--start");
  exclude(request.seed.has_value(), "--seed");
  exclude(request.insertion_rounds.has_value(), "--insertion-rounds");
  const bool widths = request.density->widths.in_km();
  exclude(!request.budget.empty(), "--budget");
  if (!request.budget.empty() && !widths && budget_of(request.budget, request.memory).step)
    refuse(message("--budget {} requires cell widths; give --cell-width", request.budget));
  if (planar(request) && !request.budget.empty())
    refuse("--budget is for grids of the sphere; give --cells");
  if (request.cells_of_widths && !widths)
    refuse("--cells auto requires cell widths; give --cell-width, or a number of cells");
  if (!file && !request.cells && request.budget.empty() && !widths)
    refuse("no start: give a file of points, or the number of cells (--cells N), or cell widths "
           "(--cell-width 60km)");
  if (request.lonlat && !file && request.fixed.empty())
    refuse("--lonlat applies to a file of points only; leave it out");
}

namespace {

/// The cells that fit the budget. \pre there is one, and no number of cells.
/// \throws Error as plan_of().
std::int64_t cells_of_budget(const CvtRequest& request, const CvtInput& input, Progress& progress) {
  const Budget budget = budget_of(request.budget, request.memory);
  if (budget.cells)
    return *budget.cells;
  const double spacing = input.recipe.stop.least_spacing;
  if (!(spacing > 0))
    refuse(message("--least-spacing {} keeps no distance for --budget {}; leave it out", spacing,
                   request.budget));
  CvtInput any = input; // a number, so that widths of any size are taken
  constexpr std::int64_t number = 1000;
  any.recipe.cells = number;
  const Schedule demanded = plan_of(any, progress);
  const double width = width_of_step(*budget.step, spacing),
               factor = width / demanded.widths->least(),
               cells = demanded.implied_cells / (factor * factor);
  if (!(cells >= fewest_cells && cells <= most_cells))
    refuse(message("--budget {} needs {} cells, with widths from {} km on; give another step",
                   request.budget, formatted("%.3g", cells), formatted("%.3g", width)));
  return static_cast<std::int64_t>(cells);
}

} // namespace

GridInput read_grid(const DensityWords& density, const RegionWords& part,
                    std::optional<std::int64_t> cells, std::optional<Surface> plane) {
  GridInput input;
  Recipe& recipe = input.recipe;
  recipe.cells = cells.value_or(0);
  recipe.radius_km = density.widths.radius;
  if (plane)
    recipe.surface = *std::move(plane);
  else if (!part.region.empty())
    recipe.surface = region_of(part.region, part.inside, recipe.radius_km);
  Resolution resolution = resolution_of(density, recipe.surface);
  recipe.resolution = for_recipe(resolution);
  if (auto* const rules = std::get_if<WidthRules>(&resolution))
    input.rules = std::move(*rules);
  recipe.limited_area = part.limited_area;
  recipe.boundary = part.boundary;
  return input;
}

CvtInput read_input(const CvtRequest& request, Progress& progress) {
  CvtInput input;
  progress.stage(request.density->widths.in_km() ? "reading the widths" : "reading the density");
  GridInput grid = read_grid(*request.density, request.part, request.cells,
                             planar(request) ? surface_of(*request.domain) : std::nullopt);
  input.rules = std::move(grid.rules);
  Recipe& recipe = input.recipe;
  recipe = std::move(grid.recipe);
  recipe.walls = walls_of(*request.domain);
  recipe.start = start_of(request);
  recipe.stop = stop_of(request);
  recipe.seed = request.seed.value_or(recipe.seed);
  recipe.method =
      std::ranges::find(method_words(), request.method, &NamedValue<Method>::word)->value;
  const DelaunayOptions merging = options_of(*request.delaunay);
  recipe.duplicates = merging.duplicates;
  recipe.merge_within = merging.merge_within;
  if (!request.points.empty()) {
    progress.stage("reading " + request.points);
    recipe.start.points = read(request, request.points, "points", input.file, input.points);
  }
  if (!request.fixed.empty()) {
    progress.stage("reading " + request.fixed);
    read_fixed(request, input);
  }
  if (!request.budget.empty())
    recipe.cells = cells_of_budget(request, input, progress);
  return input;
}

Schedule plan_of(const CvtInput& input, Progress& progress) {
  progress.stage("planning the run");
  try {
    return plan(input.recipe);
  } catch (const Error& error) {
    const std::string_view text = error.what();
    if (text.starts_with("line ") || text.starts_with("a line "))
      throw Error(error.code(), message("{}: {}", input.fixed_file.name, text), error.index());
    rethrow_with_line(error, input);
  }
}

void require_used(const CvtRequest& request, const Schedule& schedule) {
  if (request.seed && !is_drawn(schedule.recipe.start.kind))
    refuse("--seed applies to the starts multilevel, continuation, random and density only; leave "
           "it out");
  if (request.least_spacing && !*schedule.recipe.stop.well_centred)
    refuse("--least-spacing applies to --stop well-centred only; leave it out");
  if (request.most_off_midpoint && !*schedule.recipe.stop.well_centred)
    refuse("--most-off-midpoint applies to --stop well-centred only; leave it out");
}

std::vector<std::string> notes_on(const CvtRequest& request, const CvtInput& input,
                                  const Schedule& schedule) {
  const WidthWords& words = request.density->widths;
  const std::int64_t cells = schedule.recipe.cells,
                     fixed = input.recipe.fixed.cols() + schedule.on_lines;
  const bool follows = input.recipe.cells == 0 && input.file.name.empty();
  std::vector<std::string> notes;
  const std::optional<WidthField>& widths = schedule.widths;
  const bool counted_cells = widths && input.recipe.surface.is_bounded() && follows;
  if (!request.part.region.empty()) // whose longitudes and latitudes may be exchanged
    notes.push_back(message(
        "{}: {}{}", request.part.region, words_of(extent_of(input.recipe.surface), true),
        !counted_cells
            ? ""
            : message("; it requires {} cells{}", cells,
                      request.part.limited_area ? ", with those of the rings and some beyond"
                                                : "")));
  if (widths && widths->of_plane())
    notes =
        notes_in_plane(*widths, words, schedule.implied_cells,
                       input.recipe.cells == 0 ? std::nullopt : std::optional(input.recipe.cells));
  else if (widths && !input.recipe.surface.is_bounded())
    notes = notes_on(*widths, words, input.rules.gradient,
                     input.file.name.empty() && !(follows && fixed > 0) ? std::optional(cells)
                                                                        : std::nullopt,
                     unit_of(request.units, words.radius));
  if (schedule.on_lines > 0)
    notes.push_back(
        message("{}: {} {} {} generators; no place on them is farther from one than {} of "
                "the cell width there",
                request.fixed, counted(std::ssize(input.recipe.lines), "line"),
                input.recipe.lines.size() == 1 ? "holds" : "hold", schedule.on_lines,
                formatted("%.2f", schedule.from_lines)));
  if (follows && fixed > 0)
    notes.push_back(message("{} {} leave room for {} free ones: {} cells", fixed,
                            schedule.on_lines > 0 ? "fixed generators" : "fixed points",
                            cells - fixed, cells));
  const std::int64_t bisections =
      std::ranges::count(schedule.actions, CvtAction::Kind::bisect, &CvtAction::kind);
  if (schedule.recipe.start.kind == CvtStart::Kind::continuation &&
      schedule.first == CvtStart::Kind::density)
    notes.push_back(
        message("{} cells is not 10 x 4^k + 2: the start is {} points drawn from the density{}",
                cells, schedule.actions.front().cells,
                bisections == 0   ? ""
                : bisections == 1 ? ", bisected once"
                                  : message(", bisected {} times", bisections)));
  return notes;
}

void rethrow_with_line(const Error& error, const CvtInput& input) {
  const std::int64_t fixed = input.recipe.fixed.cols();
  if (error.index() < fixed)
    rethrow_with_line(error, input.fixed_file.name, input.fixed_file.lines);
  std::vector<std::int64_t> lines(static_cast<std::size_t>(fixed), 0);
  lines.insert(lines.end(), input.file.lines.begin(), input.file.lines.end());
  rethrow_with_line(error, input.file.name, lines);
}

} // namespace calotte::tools
