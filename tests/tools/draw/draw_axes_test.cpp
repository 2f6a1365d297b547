// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/axes.h"
#include "draw/text.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

using namespace calotte::tools;

namespace {

/// The number in a label: digits grouped by thin spaces, with a minus sign, a factor, a power of
/// ten.
double value_of(std::string label) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = label.find(from); at != std::string::npos; at = label.find(from)) {
      label.replace(at, from.size(), to);
    }
  };
  replace("\u2009", "");
  replace("\u2212", "-");
  replace("\u00d710^{", "e");
  replace("10^{", "1e");
  replace("}", "");
  char* end = nullptr;
  const double value = std::strtod(label.c_str(), &end);
  CHECK(*end == '\0');
  return value;
}

void check_ticks(const Axis& axis, int most) {
  CAPTURE(axis.low);
  CAPTURE(axis.high);
  CAPTURE(axis.logarithmic);
  CAPTURE(most);
  const AxisTicks ticks = ticks_of(axis, most);
  CHECK(static_cast<int>(ticks.labelled.size()) <= most + 1); // both ends of `most` steps
  CHECK(!ticks.labelled.empty());
  double last = -1;
  for (const Tick& tick : ticks.labelled) {
    CAPTURE(tick.label);
    CHECK(tick.position > last);
    CHECK(tick.position > -1e-6);
    CHECK(tick.position < 1 + 1e-6);
    CHECK(axis.position(value_of(tick.label)) == doctest::Approx(tick.position).epsilon(1e-4));
    last = tick.position;
  }
  for (const double position : ticks.unlabelled) {
    CHECK(position > -1e-6);
    CHECK(position < 1 + 1e-6);
  }
}

} // namespace

TEST_CASE("a label is at the place of its number, and the number of labels is limited") {
  for (const int most : {3, 5, 8, 12}) {
    for (const auto& [low, high] : {std::pair{1e-3, 1.0},
                                    {0.9, 8.7},
                                    {1.0, 1.05},
                                    {0.97, 1.2},
                                    {3e-16, 40.0},
                                    {2e-7, 3e-5},
                                    {1e-90, 1e90},
                                    {5.0, 12000.0}}) {
      check_ticks({low, high, true}, most);
      check_ticks({low, high, false}, most);
    }
    check_ticks({-12, 12, false}, most);
    check_ticks({-0.005, 1.005, false}, most);
    check_ticks({-4e6, 1e5, false}, most);
  }
}

TEST_CASE("whole decades are labelled as powers of ten, and 2 to 9 between them are ticks") {
  const AxisTicks ticks = ticks_of({1e-3, 1, true}, 8);
  REQUIRE(ticks.labelled.size() == 4);
  CHECK(ticks.labelled.front().label == "10^{\u22123}");
  CHECK(ticks.labelled.back().label == "10^{0}");
  CHECK(ticks.unlabelled.size() == 3 * 8);
}

TEST_CASE("an axis runs from 0 to 1 and holds the values that it can show") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> values = {3, 0.02, -1, 0, std::nan(""), infinity, 1e3};
  for (const bool logarithmic : {false, true}) {
    const Axis axis = axis_around(values, logarithmic);
    CHECK(axis.position(axis.low) == 0);
    CHECK(axis.position(axis.high) == 1);
    CHECK(axis.shows(-1) == !logarithmic);
    CHECK(!axis.shows(infinity));
    for (const double value : values) {
      if (axis.shows(value)) {
        CHECK(axis.position(value) > 0);
        CHECK(axis.position(value) < 1);
      }
    }
  }
}

TEST_CASE("an axis of no values, of one and of the most extreme has a length") {
  const double most = std::numeric_limits<double>::max();
  for (const bool logarithmic : {false, true}) {
    for (const std::vector<double>& values : {std::vector<double>{},
                                              {0.0},
                                              {7.0},
                                              {5e-324, 1e300},
                                              {5e-324},
                                              {logarithmic ? most : 1e300}}) {
      const Axis axis = axis_around(values, logarithmic);
      CHECK(axis.low < axis.high);
      CHECK(std::isfinite(axis.high));
      CHECK((!logarithmic || axis.low > 0));
      check_ticks(axis, 6);
    }
  }
}

TEST_CASE("a frame maps its axes' ends to its corners, y downwards") {
  const Frame frame = {10, 20, 300, 200, {1, 100, true}, {-5, 5, false}};
  CHECK(frame.at(1, -5).x == 10);
  CHECK(frame.at(1, -5).y == 220);
  CHECK(frame.at(100, 5).x == doctest::Approx(310));
  CHECK(frame.at(100, 5).y == 20);
  CHECK(frame.at(10, 0).x == doctest::Approx(160));
  CHECK(frame.at(10, 0).y == 120);
}

TEST_CASE("marks are not letters: raised and lowered text is smaller, other text as it is") {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 8, 8);
  cairo_t* context = cairo_create(surface);
  select_font(context, 20);
  const double plain = text_width(context, "mean");
  CHECK(marked_width(context, "mean") == doctest::Approx(plain));
  CHECK(marked_width(context, "^{mean}") < 0.9 * plain);
  CHECK(marked_width(context, "_{mean}") == doctest::Approx(marked_width(context, "^{mean}")));
  CHECK(marked_width(context, "^{}mean_{}") == doctest::Approx(plain));
  CHECK(marked_text(context, 5, 5, "mean") == doctest::Approx(5 + plain));
  CHECK(marked_text(context, 5, 5, "mean", 1) == doctest::Approx(5));
  CHECK(text_width(context, "mean") == doctest::Approx(plain)); // the font is unchanged
  cairo_destroy(context);
  cairo_surface_destroy(surface);
}

TEST_CASE("a file's words become text that can be shown, its exponents raised") {
  CHECK(shown("a\xff") == "a\ufffd");
  CHECK(unmarked("2*x_{1}, y^2") == "2x_1, y^2");
  CHECK(unit_text("kg m-2 s-1") == "kg m^{\u22122} s^{\u22121}");
  CHECK(unit_text("m2") == "m^{2}");
  for (const char* plain : {"degrees_north", "1e-3", "K", "", "days since 2000-01-01", "m/s"}) {
    CHECK(unit_text(plain) == plain);
  }
}

TEST_CASE("a curve has gaps where it cannot be shown, and a dot between two gaps") {
  cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 100, 20);
  cairo_t* context = cairo_create(surface);
  const Frame frame = {0, 0, 100, 20, {0, 10, false}, {0.1, 10, true}};
  cairo_set_source_rgb(context, 1, 1, 1);
  cairo_set_line_width(context, 4);
  draw_curve(context, frame, {1, 3, 4, 5, 6, 8}, {1, 1, 0, 1, std::nan(""), 1});
  cairo_surface_flush(surface);
  const auto lit = [&](int x) {
    const auto* row =
        cairo_image_surface_get_data(surface) + 10 * cairo_image_surface_get_stride(surface);
    return (reinterpret_cast<const std::uint32_t*>(row)[x] & 0xff) > 128;
  };
  CHECK(lit(20));
  CHECK(!lit(40));
  CHECK(lit(50));
  CHECK(!lit(60));
  CHECK(lit(80));
  CHECK(!lit(5));
  CHECK(!lit(95));
  cairo_destroy(context);
  cairo_surface_destroy(surface);
}
