// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "runs.h"
#include "words.h"

#include <calotte/error.h>
#include <calotte/grid.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

// ---- The recipe

constexpr std::array<NamedValue<Duplicates>, 2> duplicates{
    {{"merge", Duplicates::merge}, {"refuse", Duplicates::refuse}}};

/// A field of a recipe, or of a part of it, as an attribute.
/// \param field returns a reference to it.
template <class Field>
void add_field(py::class_<Recipe>& type, const char* name, const Field& field) {
  using Value = std::remove_cvref_t<decltype(field(std::declval<Recipe&>()))>;
  type.def_property(
      name, [field](const Recipe& recipe) -> Value { return field(recipe); },
      [field](Recipe& recipe, Value value) { field(recipe) = std::move(value); });
}

/// n x 3 or n x 2 points, in the plane with z = 0, as an attribute that is set.
template <class Field>
void add_points_field(py::class_<Recipe>& type, const char* name, const Field& field) {
  type.def_property(
      name, [field](const Recipe& recipe) { return handed_over(Points3(field(recipe))); },
      [field](Recipe& recipe, const Doubles& points) {
        const auto given = columns(points);
        Points3& all = field(recipe);
        all.setZero(3, given.cols());
        all.topRows(given.rows()) = given;
      });
}

/// "x", "y", "xy" or "".
Walls walls_named(const std::string& word) {
  if (word.find_first_not_of("xy") != std::string::npos)
    throw Error(ErrorCode::invalid_argument, "no walls " + word + "; give x or y");
  return {word.find('x') != std::string::npos, word.find('y') != std::string::npos};
}

std::string word_of(Walls walls) { return std::string(walls.x ? "x" : "") + (walls.y ? "y" : ""); }

void add_recipe(py::module_& module) {
  py::class_<Recipe> type(module, "Recipe");
  type.def(py::init<>())
      .def_readwrite("surface", &Recipe::surface)
      .def_property(
          "walls", [](const Recipe& recipe) { return word_of(recipe.walls); },
          [](Recipe& recipe, const std::string& word) { recipe.walls = walls_named(word); })
      .def_readwrite("cells", &Recipe::cells)
      .def("take_density",
           [](Recipe& recipe, const Density& density) { recipe.resolution = density; })
      .def("take_widths", [](Recipe& recipe, const Widths& widths) { recipe.resolution = widths; })
      .def_readwrite("radius_km", &Recipe::radius_km)
      .def_readwrite("limited_area", &Recipe::limited_area)
      .def_readwrite("seed", &Recipe::seed)
      .def_readwrite("merge_within", &Recipe::merge_within);
  const auto of_start = [&](const char* name, auto CvtStart::*field) {
    add_field(
        type, name, [field](auto& recipe) -> auto& { return recipe.start.*field; });
  };
  of_start("bisections", &CvtStart::bisections);
  of_start("insertion_rounds", &CvtStart::insertion_rounds);
  const auto of_stop = [&](const char* name, auto CvtStop::*field) {
    add_field(
        type, name, [field](auto& recipe) -> auto& { return recipe.stop.*field; });
  };
  of_stop("tolerance", &CvtStop::tolerance);
  of_stop("max_iterations", &CvtStop::max_iterations);
  of_stop("iterations", &CvtStop::iterations);
  of_stop("well_centred", &CvtStop::well_centred);
  of_stop("least_spacing", &CvtStop::least_spacing);
  of_stop("most_off_midpoint", &CvtStop::most_off_midpoint);
  add_points_field(
      type, "points", [](auto& recipe) -> auto& { return recipe.start.points; });
  add_points_field(
      type, "fixed", [](auto& recipe) -> auto& { return recipe.fixed; });
  type.def_property(
      "lines", [](const Recipe& recipe) { return std::ssize(recipe.lines); },
      [](Recipe& recipe, const std::vector<Doubles>& lines) { recipe.lines = lines_of(lines); });
  type.def("take_lines", [](Recipe& recipe, const std::string& path) {
    recipe.lines = call([&] { return read_lines(path, recipe.surface); });
  });
  add_word(
      type, "start", "start", start_words(),
      [](auto& recipe) -> auto& { return recipe.start.kind; });
  add_word(
      type, "norm", "norm", norm_words(), [](auto& recipe) -> auto& { return recipe.stop.norm; });
  add_word(
      type, "method", "method", method_words(),
      [](auto& recipe) -> auto& { return recipe.method; });
  add_word(
      type, "boundary", "boundary", boundary_words(),
      [](auto& recipe) -> auto& { return recipe.boundary; });
  add_word(
      type, "duplicates", "rule for duplicates",
      std::span<const NamedValue<Duplicates>>(duplicates),
      [](auto& recipe) -> auto& { return recipe.duplicates; });
}

/// \param done of each, as far as the run went.
py::list actions_of(const std::vector<CvtAction>& actions, const std::vector<CvtDone>& done = {}) {
  py::list values;
  for (std::size_t k = 0; k < actions.size(); ++k) {
    const CvtAction& action = actions[k];
    const CvtDone made = k < done.size() ? done[k] : CvtDone{};
    values.append(py::make_tuple(word_in(action_words(), action.kind), action.cells, action.times,
                                 word_in(norm_words(), action.norm), action.tolerance,
                                 action.max_iterations, made.times, made.iterations));
  }
  return values;
}

/// The choices of a recipe.
void add_schedule(py::module_& module) {
  py::class_<Schedule> type(module, "Schedule");
  type.def_property_readonly("cells",
                             [](const Schedule& schedule) { return schedule.recipe.cells; })
      .def_property_readonly("start",
                             [](const Schedule& schedule) {
                               return word_in(start_words(), schedule.recipe.start.kind);
                             })
      .def_property_readonly("actions",
                             [](const Schedule& schedule) { return actions_of(schedule.actions); })
      .def_readonly("implied_cells", &Schedule::implied_cells)
      .def_readonly("widths", &Schedule::widths);
  module.def("plan", [](const Recipe& recipe) { return call([&] { return plan(recipe); }); });
}

// ---- The run

/// An accepted iteration, as a function of Python receives it.
py::dict progress_of(const CvtProgress& now) {
  const CvtIteration& last = now.report.iterations.back();
  py::dict values;
  values["iterations"] = now.report.iterations.size();
  values["cells"] = last.cells;
  values["residual"] = now.report.residual;
  values["energy"] = last.energy;
  values["bisections_left"] = now.bisections_left;
  values["rounds_left"] = now.rounds_left;
  values["seconds"] = now.report.seconds;
  return values;
}

py::dict report_of(const CvtReport& report) {
  py::dict values;
  values["converged"] = report.converged;
  values["well_centred"] = report.well_centred;
  values["cells_beyond_limits"] = report.cells_beyond_limits;
  values["worst_cell"] = report.worst_cell;
  values["moved_on_lines"] = report.moved_on_lines;
  values["farthest_move"] = report.farthest_move;
  values["off_boundary"] = report.off_boundary;
  values["residual"] = report.residual;
  values["iterations"] = report.iterations.size();
  values["energy"] = report.iterations.empty() ? 0 : report.iterations.back().energy;
  values["seconds"] = report.seconds;
  values["actions"] = actions_of(report.actions, report.done);
  DoubleVector energies(std::ssize(report.iterations)), norms(std::ssize(report.iterations));
  Eigen::Index k = 0;
  for (const CvtIteration& iteration : report.iterations) {
    energies[k] = iteration.energy;
    norms[k++] = norm_of(iteration, Norm::l2_scaled);
  }
  values["energies"] = handed_over(std::move(energies));
  values["norms"] = handed_over(std::move(norms));
  return values;
}

/// The cells between walls, with their density.
MeshFile between_walls(const Recipe& asked, const Density& density, const Mesh& box) {
  MeshFile file = walled(box, asked.surface.period(), asked.walls);
  if (!density.uniform())
    file.density = evaluate(density, file.polygons->centres, box.surface);
  return file;
}

/// The mesh, the report, and the polygons between walls with their content, or None.
/// \param schedule of the recipe.
py::tuple run(const Recipe& recipe, const Schedule& schedule, std::optional<int> regions,
              py::object function) {
  const ProgressCallback callback = callback_of(std::move(function), ProgressReply::stop);
  auto cells = std::make_shared<MeshFile>();
  Cvt grid = call([&] {
    Cvt made = make_grid(schedule, {.decomposition = {.regions = regions}, .progress = callback});
    if (recipe.walls.x || recipe.walls.y)
      *cells = between_walls(recipe, schedule.density, made.mesh);
    return made;
  });
  py::object polygons = py::none();
  if (cells->polygons)
    polygons = py::make_tuple(std::shared_ptr<Polygons>(cells, &*cells->polygons), cells);
  return py::make_tuple(std::make_shared<Mesh>(std::move(grid.mesh)), report_of(grid.report),
                        polygons);
}

} // namespace

ProgressCallback callback_of(py::object function, ProgressReply end) {
  return [f = Callable(std::move(function)), end](const Progress& now) {
    const py::gil_scoped_acquire locked;
    check_interrupt();
    const bool stops = !f.none() && f(progress_of(*now.run)).is(py::bool_(true));
    return stops ? end : ProgressReply::proceed;
  };
}

void add_tessellations(py::module_& module) {
  add_recipe(module);
  add_schedule(module);
  module.def("make_grid", &run);
}

} // namespace calotte::python
