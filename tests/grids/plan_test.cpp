// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/constants.h"
#include "support/densities.h"
#include "support/files.h"
#include "support/text.h"

#include <calotte/calotte.h>
#include <calotte/grid.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;

namespace {

using Kind = CvtAction::Kind;

/// The rounds of the last level.
int last_rounds(const Schedule& schedule) {
  const auto at = std::ranges::find(schedule.actions.rbegin(), schedule.actions.rend(),
                                    Kind::insert, &CvtAction::kind);
  return at == schedule.actions.rend() ? 0 : at->times;
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Surface part() { return circle({1, 1, 1}, 20 * degree); }

/// Widths from 400 km at the equator to `poles` km at the poles.
Raster widths(double poles) {
  Raster table;
  table.x = Eigen::Vector2d(0, 180);
  table.y = Eigen::Vector3d(-90, 0, 90);
  table.values.resize(2, 3);
  table.values << poles, 400, poles, poles, 400, poles;
  return table;
}

Recipe with(CvtStart::Kind kind, std::int64_t cells, const Surface& surface = {}) {
  Recipe recipe;
  recipe.cells = cells;
  recipe.surface = surface;
  recipe.start.kind = kind;
  return recipe;
}

std::string message_of(const Recipe& recipe) {
  try {
    plan(recipe);
  } catch (const Error& error) {
    return error.what() + (error.index() < 0 ? "" : " @" + std::to_string(error.index()));
  }
  return "";
}

} // namespace

TEST_CASE("plan: the start follows from density, surface and fixed generators") {
  const Surface box = Surface::periodic({2, 1});
  Recipe recipe;
  recipe.cells = 500;
  const auto kind = [](const Recipe& of) { return plan(of).recipe.start.kind; };
  CHECK(kind(recipe) == CvtStart::Kind::continuation);
  CHECK(plan(recipe).first == CvtStart::Kind::geodesic);
  for (const Surface& plane : {box, rectangle({0, 0}, {2, 1})}) {
    recipe.surface = plane;
    CHECK(kind(recipe) == CvtStart::Kind::multilevel);
    CHECK(plan(recipe).recipe.stop.well_centred == true);
  }
  recipe.stop.iterations = 20;
  CHECK(kind(recipe) == CvtStart::Kind::density);
  recipe.stop.iterations = {};
  recipe.surface = part();
  CHECK(kind(recipe) == CvtStart::Kind::multilevel);
  recipe.start.bisections = 1;
  CHECK(kind(recipe) == CvtStart::Kind::density);
  recipe = {};
  recipe.cells = 500;
  recipe.fixed = random_sphere(3);
  CHECK(kind(recipe) == CvtStart::Kind::multilevel);
  CHECK(last_rounds(plan(recipe)) == 3);
  recipe.stop.iterations = 20;
  CHECK(kind(recipe) == CvtStart::Kind::density);
  recipe = {};
  recipe.cells = 2562;
  recipe.resolution = test::x8();
  CHECK(kind(recipe) == CvtStart::Kind::multilevel);
  recipe.cells = 0;
  recipe.start.points = random_sphere(100);
  CHECK(kind(recipe) == CvtStart::Kind::points);
  CHECK(plan(recipe).actions.front().cells == 100);
}

TEST_CASE("plan: a run that follows widths ends well-centred, at a wider tolerance") {
  Recipe recipe;
  recipe.cells = 2562;
  CHECK(plan(recipe).recipe.stop.well_centred == false);
  CHECK(plan(recipe).recipe.stop.tolerance == 1e-6);
  recipe.resolution = test::x8();
  CHECK(plan(recipe).recipe.stop.well_centred == true);
  CHECK(plan(recipe).recipe.stop.tolerance == 1e-4);
  recipe.stop.well_centred = false;
  CHECK(plan(recipe).recipe.stop.tolerance == 1e-6);
  recipe.stop.tolerance = 1e-3;
  CHECK(plan(recipe).recipe.stop.tolerance == 1e-3);
}

TEST_CASE("plan: actions lead from a coarse grid to the number of cells") {
  Recipe recipe;
  recipe.cells = 40962;
  recipe.resolution = test::x8();
  const std::vector<CvtAction> actions = plan(recipe).actions;
  REQUIRE(actions.size() > 7);
  CHECK(actions.front().kind == Kind::start);
  std::size_t k = 1;
  for (; k < actions.size() && actions[k].kind == Kind::insert; k += 2) {
    CHECK(actions[k].cells == actions[k - 1].cells);
    CHECK(actions[k].tolerance == 1e-3);
    if (actions[k + 1].kind == Kind::bisect) {
      CHECK(std::abs(actions[k + 2].cells - 4 * actions[k].cells) <= 8);
      CHECK(actions[k + 2].times < actions[k].times);
    }
  }
  CHECK(k == actions.size() - 2);
  REQUIRE(actions.end()[-3].kind == Kind::converge);
  CHECK(actions.end()[-3].cells == 40962);
  CHECK(actions.end()[-3].tolerance == 1e-4);
  CHECK(actions.end()[-2].kind == Kind::polish);
  CHECK(actions.back().kind == Kind::raise);
  CHECK(plan(with(CvtStart::Kind::icosahedron, 642)).actions.size() == 1);
  recipe = with(CvtStart::Kind::icosahedron, 642);
  recipe.start.bisections = 2;
  const Schedule bisected = plan(recipe);
  REQUIRE(bisected.actions.size() == 3);
  CHECK(bisected.actions.front().cells == 42);
  CHECK(bisected.actions.back().kind == Kind::bisect);
  CHECK(bisected.actions.back().cells == 642);
}

TEST_CASE("plan: the actions are those of the run") {
  Recipe recipe;
  recipe.cells = 800;
  recipe.resolution = test::x8();
  for (const Surface& surface : {Surface::sphere(), Surface(part())}) {
    recipe.surface = surface;
    const Schedule schedule = plan(recipe);
    const Cvt grid = make_grid(schedule);
    REQUIRE(grid.report.actions.size() == schedule.actions.size());
    REQUIRE(grid.report.done.size() == schedule.actions.size());
    std::int64_t iterations = 0;
    for (std::size_t k = 0; k < schedule.actions.size(); ++k) {
      const CvtAction &planned = schedule.actions[k], &made = grid.report.actions[k];
      const CvtDone& done = grid.report.done[k];
      CHECK(made.kind == planned.kind);
      CHECK(made.cells == planned.cells);
      CHECK(made.times == planned.times);
      CHECK((done.times > 0 || planned.kind == Kind::raise));
      CHECK((done.times <= planned.times || planned.kind == Kind::insert));
      if (planned.kind == Kind::insert)
        CHECK(done.cells == doctest::Approx(planned.cells).epsilon(0.1));
      iterations += done.iterations;
    }
    CHECK(iterations == std::ssize(grid.report.iterations));
    CHECK(grid.mesh.points.cols() == 800);
    CHECK(grid.mesh.surface == surface);
    CHECK(grid.report.converged);
  }
}

TEST_CASE("plan: widths give the number of cells") {
  Recipe recipe;
  recipe.resolution = widths(800);
  const Schedule schedule = plan(recipe);
  CHECK(schedule.recipe.cells == std::llround(schedule.implied_cells));
  CHECK(!schedule.density.uniform());
  recipe.resolution = widths(400); // of one size
  CHECK(plan(recipe).density.uniform());
  CHECK(plan(recipe).recipe.cells == geodesic_count(plan(recipe).implied_cells));
  recipe.surface = part();
  const std::int64_t inside = plan(recipe).recipe.cells;
  recipe.limited_area = true;
  const Schedule wider = plan(recipe);
  CHECK(wider.recipe.cells > inside);
  CHECK(wider.recipe.surface.area() > recipe.surface.area());
  recipe.limited_area = false;
  recipe.boundary = Boundary::generators;
  const Schedule ending = plan(recipe);
  CHECK(ending.on_boundary > 0);
  CHECK(ending.recipe.fixed.cols() == ending.on_boundary);
  CHECK(ending.recipe.cells > inside);
  CHECK(*ending.recipe.start.insertion_rounds == 1); // generators on the boundary do not count
}

TEST_CASE("plan: walls widen the box") {
  Recipe recipe;
  recipe.cells = 300;
  recipe.surface = Surface::periodic({2, 1});
  recipe.walls.y = true;
  const Schedule schedule = plan(recipe);
  CHECK(schedule.recipe.surface.period().x() == 2);
  CHECK(schedule.recipe.surface.period().y() > 1);
  CHECK(schedule.recipe.cells > 300);
  const Cvt grid = make_grid(schedule);
  const double between = (grid.mesh.points.row(1).array() <= 1).cast<double>().sum();
  CHECK(std::abs(between - 300) < 20);
  for (const int bisections : {1, 2}) { // the box has as many cells as they lead to
    recipe.start.bisections = bisections;
    CHECK(plan(recipe).recipe.cells % (1 << 2 * bisections) == 0);
    CHECK(std::abs(plan(recipe).recipe.cells - schedule.recipe.cells) <= 2 << 2 * bisections);
  }
}

TEST_CASE("plan: recipes that do not fit together are refused, with the remedy") {
  Recipe recipe;
  CHECK(message_of(recipe).find("there is no number of cells; give one, or cell widths") == 0);
  CHECK(message_of(with(CvtStart::Kind::automatic, 11)) ==
        "the number of cells is 11; give a number from 12 to 1073741824");
  CHECK(has(message_of(with(CvtStart::Kind::automatic, 3, part())), "number from 4"));
  CHECK(has(message_of(with(CvtStart::Kind::spiral, 100, part())), "the whole sphere only"));
  CHECK(has(message_of(with(CvtStart::Kind::hexagonal, 100)), "the plane only"));
  CHECK(has(message_of(with(CvtStart::Kind::geodesic, 100, Surface::periodic({1, 1}))),
            "the sphere only"));
  CHECK(message_of(with(CvtStart::Kind::icosahedron, 100)) ==
        "the start icosahedron makes 10 x 4^k + 2 cells, not 100; the nearest numbers are 42 and "
        "162");
  CHECK(has(message_of(with(CvtStart::Kind::points, 100)), "no points"));
  recipe = with(CvtStart::Kind::random, 100);
  recipe.start.bisections = 1;
  CHECK(message_of(recipe) ==
        "1 bisection does not lead to 100 cells; the nearest numbers are 98 and 102");
  recipe.start.bisections = 14;
  CHECK(message_of(recipe) == "the number of bisections is 14; give 0 to 13");
  recipe = with(CvtStart::Kind::automatic, 100, Surface::plane());
  CHECK(has(message_of(recipe), "a plane that has no end"));
  recipe = with(CvtStart::Kind::automatic, 100);
  recipe.fixed = random_sphere(120);
  CHECK(message_of(recipe) == "fixed point 99 leaves no free one of the 100 cells; give more cells "
                              "or fewer fixed points @99");
  recipe = with(CvtStart::Kind::automatic, 0);
  recipe.resolution = widths(8e5);
  CHECK(has(message_of(recipe), "a grid has 12 to 1073741824"));
  recipe.resolution = {};
  recipe.cells = 100;
  recipe.limited_area = true;
  CHECK(has(message_of(recipe), "give the rings that bound it"));
  recipe = with(CvtStart::Kind::automatic, 100);
  recipe.resolution = tanh_bump({0, 0, 1}, 0.5, -1, 0.1);
  CHECK(has(message_of(recipe), "alpha"));
}

TEST_CASE("plan: rounds of insertion lead to any number of cells") {
  for (const std::int64_t cells : {std::int64_t{1'073'000'000}, std::int64_t{1} << 30}) {
    Recipe recipe = with(CvtStart::Kind::multilevel, cells);
    recipe.resolution = test::x8();
    CHECK(plan(recipe).actions.back().cells == cells);
  }
}

TEST_CASE("plan: values out of range are refused before any work") {
  const auto refused = [](const auto& change, const std::string& words) {
    Recipe recipe = with(CvtStart::Kind::automatic, 100);
    change(recipe);
    CAPTURE(words);
    CHECK(has(message_of(recipe), words));
  };
  refused([](Recipe& r) { r.cells = -1; }, "the number of cells is -1");
  refused([](Recipe& r) { r.stop.tolerance = not_a_number; }, "the tolerance is nan");
  refused([](Recipe& r) { r.stop.max_iterations = -5; }, "-5");
  refused([](Recipe& r) { r.stop.least_spacing = not_a_number; }, "least_spacing is nan");
  refused([](Recipe& r) { r.start.insertion_rounds = 1 << 30; }, "give 1 to 100");
  refused([](Recipe& r) { r.fixed = Points3::Constant(3, 2, not_a_number); },
          "fixed generator 0 is not finite; give finite coordinates @0");
  refused([](Recipe& r) { r.fixed = Points3::Zero(3, 1); },
          "fixed generator 0 is 0 0 0; give a direction @0");
  refused(
      [](Recipe& r) {
        r.resolution = Widths::around({Points3(Eigen::Vector3d(0, 0, 1))}, 100, 500);
      },
      "no rule gives a width at longitude -180, latitude -90; add one that holds everywhere");
  CHECK_THROWS_AS(make_grid(Schedule{}), Error);
  CHECK_THROWS_AS(random_points(100, Surface::plane()), Error);
  CHECK_THROWS_AS(hexagonal_lattice(100, Surface::sphere()), Error);
}

TEST_CASE("make_grid: a run that is stopped goes on from its state to the same bits") {
  Recipe recipe;
  recipe.cells = 400;
  recipe.resolution = test::x8();
  const Cvt whole = make_grid(recipe);
  RunOptions stopping;
  std::optional<CvtState> state;
  stopping.progress = [&](const Progress& now) {
    state = now.run->state;
    return now.run->report.iterations.size() >= 20 ? ProgressReply::stop : ProgressReply::proceed;
  };
  CHECK_FALSE(make_grid(recipe, stopping).report.converged);
  REQUIRE(state);
  RunOptions going;
  going.state = state;
  CHECK(make_grid(recipe, going).mesh.points == whole.mesh.points);
  recipe.cells = 900;
  CHECK_THROWS_AS(make_grid(recipe, going), Error);
  stopping.progress = [](const Progress&) { return ProgressReply::cancel; };
  CHECK(test::code_of([&] { make_grid(recipe, stopping); }) == ErrorCode::cancelled);
}

TEST_CASE("make_grid: a run goes on to the same bits after each of its actions") {
  Recipe recipe;
  recipe.cells = 800;
  recipe.resolution = test::x8();
  std::vector<CvtState> ends;
  std::optional<CvtState> before;
  RunOptions watching;
  watching.progress = [&](const Progress& now) {
    const CvtReport& report = now.run->report;
    if (before && before->report().done.size() != report.done.size())
      ends.push_back(*before);
    before = now.run->state;
    return ProgressReply::proceed;
  };
  const Cvt whole = make_grid(recipe, watching);
  ends.push_back(*before);
  REQUIRE(ends.size() >= 5); // start, insert, bisect, converge, polish
  for (const CvtState& state : ends) {
    RunOptions going;
    going.state = state;
    const Cvt resumed = make_grid(recipe, going);
    CHECK(resumed.mesh.points == whole.mesh.points);
    REQUIRE(resumed.report.done.size() == whole.report.done.size());
    for (std::size_t k = 0; k < whole.report.done.size(); ++k) {
      CHECK(resumed.report.done[k].times == whole.report.done[k].times);
      CHECK(resumed.report.done[k].iterations == whole.report.done[k].iterations);
      CHECK(resumed.report.done[k].cells == whole.report.done[k].cells);
    }
  }
}

namespace {

/// A square of 20 degrees without a bent wall, which is 0.02 degrees thick but for spikes on one
/// side.
Surface around_bent_wall() {
  std::vector<Eigen::Vector2d> corners;
  constexpr int steps = 17;
  for (int k = 0; k <= 2 * steps + 1; ++k) {
    const bool back = k > steps;
    const double angle = 10 * degree * (back ? 2 * steps + 1 - k : k), radius = back         ? 4.98
                                                                                : k % 5 == 2 ? 6.5
                                                                                             : 5;
    corners.emplace_back(10 + radius * std::cos(angle), 10 + radius * std::sin(angle));
  }
  Points3 wall(3, std::ssize(corners)), square(3, 4);
  for (std::size_t k = 0; k < corners.size(); ++k) // clockwise
    wall.col(wall.cols() - 1 - static_cast<Eigen::Index>(k)) = from_lonlat(corners[k]);
  Eigen::Index next = 0;
  for (const auto& [longitude, latitude] :
       std::vector<std::pair<double, double>>{{0, 0}, {20, 0}, {20, 20}, {0, 20}})
    square.col(next++) = from_lonlat(Eigen::Vector2d(longitude, latitude));
  return Surface::sphere().within({square, wall});
}

} // namespace

TEST_CASE("make_grid: a mesh that leaves the boundary where it is narrow says by how many edges") {
  // Two bays with a wall between them that is much thinner than a cell: the mesh ends at both
  // sides.
  Points3 wall(3, 8);
  Eigen::Index next = 0;
  for (const auto& [longitude, latitude] : std::vector<std::pair<double, double>>{
           {0, 0}, {20, 0}, {20, 20}, {10.1, 20}, {10.05, 2}, {9.95, 2}, {9.9, 20}, {0, 20}})
    wall.col(next++) = from_lonlat(Eigen::Vector2d(longitude, latitude));
  Recipe recipe;
  recipe.cells = 60;
  recipe.boundary = Boundary::generators;
  recipe.start.kind = CvtStart::Kind::random;
  recipe.surface = Surface::sphere().within({wall});
  const Cvt beside_wall = make_grid(recipe);
  CHECK(beside_wall.report.off_boundary == 0);
  CHECK(check_surface(beside_wall.mesh).failure == "");
  // The edges along the two sides of a wall that is thin and bent cross each other.
  recipe.surface = around_bent_wall();
  recipe.start = {};
  recipe.cells = 200;
  const Cvt around_wall = make_grid(recipe);
  CHECK(around_wall.report.off_boundary > 0);
  CHECK(check_surface(around_wall.mesh).failure == "");
  recipe.surface = part();
  CHECK(make_grid(recipe).report.off_boundary == 0);
  recipe.boundary = Boundary::clip;
  CHECK(make_grid(recipe).report.off_boundary == 0);
}
