// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace calotte;

namespace {

const Surface lake = rectangle({0, 0}, {20, 10});

Points3 line_of(const std::vector<std::array<double, 2>>& places) {
  Points3 line = Points3::Zero(3, std::ssize(places));
  for (std::size_t k = 0; k < places.size(); ++k)
    line.col(static_cast<Eigen::Index>(k)) << places[k][0], places[k][1], 0;
  return line;
}

double distance(const std::vector<Points3>& lines, const Eigen::Vector3d& x) {
  double least = 1e300;
  for (const Points3& line : lines)
    for (Eigen::Index k = 0; k < line.cols(); ++k) {
      const Eigen::Vector3d a = line.col(k), b = line.col(std::min(k + 1, line.cols() - 1));
      const double square = (b - a).squaredNorm(),
                   t = square > 0 ? std::clamp((x - a).dot(b - a) / square, 0.0, 1.0) : 0;
      least = std::min(least, (x - a - t * (b - a)).norm());
    }
  return least;
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

} // namespace

TEST_CASE("widths of a plane: distances from lines and points against a slow computation") {
  std::vector<Points3> lines;
  const Points3 ends = random_points(600, lake, {}, 7);
  for (Eigen::Index k = 0; k + 2 < ends.cols(); k += 3)
    lines.emplace_back(ends.middleCols(k, 3));
  lines.emplace_back(ends.col(1));
  const Widths rule = Widths::by_distance(lines, {{{0, 1}, {1, 2}, {4, 3}}}, lake);
  CHECK(rule.is_of_plane());
  const Points3 places = random_points(20000, rectangle({-5, -5}, {25, 15}), {}, 8);
  const DoubleVector widths = evaluate(rule, places);
  double worst = 0;
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const double d = distance(lines, places.col(i)),
                 exact = d < 1 ? 1 + d : std::min(3.0, 2 + (d - 1) / 3);
    worst = std::max(worst, std::abs(widths[i] - exact));
  }
  CHECK(worst < 1e-12);
  CHECK(evaluate(rule, places.topRows<2>()) == widths);
}

TEST_CASE("widths of a plane: rules combine, and are limited exactly where they grow") {
  const std::vector<Points3> shore{line_of({{0, 0}, {20, 0}})}, rock{line_of({{10, 5}})};
  const Widths rule = Widths::minimum({Widths::by_distance(shore, {{{0, 0.2}, {1, 4}}}, lake),
                                       Widths::around(rock, 0.5, 2, lake), 3})
                          .limit_gradient(0.5);
  const Points3 places = random_points(2000, lake, {}, 3);
  const DoubleVector widths = evaluate(rule, places);
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const double to_rock = std::max(0.0, distance(rock, places.col(i)) - 2);
    CHECK(widths[i] ==
          doctest::Approx(std::min({0.2 + 0.5 * places(1, i), 0.5 + 0.5 * to_rock, 3.0}))
              .epsilon(1e-8));
  }
}

TEST_CASE("widths of a plane: within a part, blended from its boundary, of a raster") {
  const Surface bay = rectangle({2, 2}, {6, 6});
  const Widths inside = Widths::where(bay, 0.5, 2);
  const Widths blend = Widths::blend(2, 0.5, WidthShare(bay, {{{-1, 1}, {1, 0}}}));
  const Raster raster{DoubleVector{{0, 20}}, DoubleVector{{0, 10}}, DoubleMatrix{{1, 1}, {3, 3}},
                      true};
  const Points2 places{{4, 8, 6, 2.5}, {4, 4, 4, 4}};
  CHECK(evaluate(inside, places) == DoubleVector{{0.5, 2, 2 - 1.5, 0.5}});
  const DoubleVector mixed = evaluate(blend, places);
  CHECK(mixed[0] == doctest::Approx(0.5));
  CHECK(mixed[1] == doctest::Approx(2));
  CHECK(mixed[2] == doctest::Approx(1.25));
  CHECK(mixed[3] == doctest::Approx(2 - 1.5 * 0.75));
  CHECK(evaluate(Widths(raster), places)[1] == doctest::Approx(1.8));
}

TEST_CASE("widths of a plane: distances go across periods, numbers hold everywhere") {
  const Widths rule = Widths::by_distance({line_of({{0.5, 0}, {0.5, 10}})}, {{{0, 1}, {5, 6}}},
                                          Surface::periodic({20, 10}));
  const DoubleVector widths = evaluate(rule, Points2{{19, 1, 10}, {5, 5, 5}});
  CHECK(widths[0] == doctest::Approx(2.5));
  CHECK(widths[1] == doctest::Approx(1.5));
  CHECK(widths[2] == doctest::Approx(6));
  CHECK(evaluate(Widths(3.0), Points2{{19, 1}, {5, 5}}) == DoubleVector{{3, 3}});
  const Widths number = Widths::sum({1, 2}).limit_gradient(0.1); // is of no surface
  CHECK(evaluate(Widths::minimum({rule, number}), Points2{{10}, {5}})[0] == 3);
}

TEST_CASE("widths of a plane: what says nothing has no mean with a width") {
  const Widths rock = Widths::around({line_of({{10, 5}})}, 0.5, 2, lake);
  const Widths blend = Widths::blend(2, rock, WidthShare(lake, {{{-10, 0.5}}}));
  const DoubleVector widths = evaluate(blend, Points2{{10, 1}, {5, 5}});
  CHECK(widths[0] == doctest::Approx(1.25));
  CHECK(widths[1] == Widths::no_demand);
}

TEST_CASE("widths of a plane: the raster covers the domain and has the rule's values") {
  const Widths rule = Widths::by_distance({line_of({{10, 5}})}, {{{0, 0.1}, {5, 2}}}, lake);
  for (const Surface& plane : {lake, Surface::periodic({20, 10})}) {
    const Raster raster = sampled(rule, plane);
    CHECK(raster.x[0] == 0);
    CHECK(raster.x[raster.x.size() - 1] == 20);
    CHECK(raster.x[1] - raster.x[0] <= 0.05 * (1 + 1e-12));
    require_covering(raster, plane);
    CHECK(raster.values(0, 0) ==
          doctest::Approx(std::min(2.0, 0.1 + 1.9 / 5 * std::hypot(10, 5))).epsilon(1e-12));
  }
  CHECK(sampled(rule, lake, 2.5).x.size() == 9);
}

TEST_CASE("widths of a plane: a limit in a domain without a demand is refused, not an accident") {
  const Widths outside = Widths::around({line_of({{100, 100}})}, 0.5, 2, lake);
  for (const Surface& plane : {lake, Surface::periodic({20, 10})})
    CHECK(message_of([&] {
            outside.limit_gradient(0.1, plane);
          }).find("no rule gives a width at x ") == 0);
  CHECK(evaluate(Widths(3.0).limit_gradient(0.1, lake), Points2{{1}, {2}})[0] == 3);
  const Widths rock = Widths::around({line_of({{10, 5}})}, 0.5, 2, lake);
  const Widths limited = rock.limit_gradient(0.1, lake);
  CHECK(evaluate(limited, Points2{{10}, {5}})[0] == doctest::Approx(0.5));
  CHECK(evaluate(limited, Points2{{17}, {5}})[0] == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("widths of a plane: what does not fit is refused in one line") {
  const Widths plane = Widths::by_distance({line_of({{1, 1}})}, {{{0, 1}, {5, 2}}}, lake),
               sphere = Widths::by_latitude({{{-90, 1}, {90, 2}}});
  CHECK(message_of([&] {
          Widths::minimum({plane, sphere});
        }).find("some widths are of the sphere and some of a plane") == 0);
  CHECK(message_of([&] { sampled(plane); }).find("the widths are those of a plane") == 0);
  CHECK(message_of([&] { sampled(sphere, lake); }).find("the widths are those of the sphere") == 0);
  CHECK(message_of([&] { sampled(plane, Surface::plane()); }).find("the domain: it has no rings") ==
        0);
  CHECK(message_of([&] { sampled(plane, lake, 1e-6); }).find("the step 1e-06") == 0);
  CHECK(message_of([&] {
          Widths::maximum({plane, 2}).limit_gradient(0.1);
        }).find("the gradient of such widths of a plane") == 0);
  Points3 bad = line_of({{1, 1}, {2, 2}});
  bad(2, 1) = 1;
  CHECK(message_of([&] {
          Widths::by_distance({bad}, {{{0, 1}}}, lake);
        }).find("line 0, point 1 is no place x y 0 of a plane") == 0);
}
