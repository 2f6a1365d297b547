// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/legend.h"
#include "draw/page.h"
#include "draw/text.h"
#include "support/pictures.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <cairo.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;

namespace {

/// Ranges of all kinds: wide and narrow, of large and small numbers, of both signs.
const std::vector<std::pair<double, double>> ranges = {
    {42.7, 341.3},      {1, 100},           {0.0123, 0.0125}, {1e-9, 1.4e-9},  {2e7, 5e7},
    {-0.02, 0.04},      {1234.5, 1234.9},   {1, 1 + 1e-5},    {-1 - 1e-5, -1}, {1e-12, 1},
    {273.151, 273.152}, {6371220, 6371229}, {-1e5, 1e5},      {0.97, 1.03},    {3, 9}};

/// The letters of a label, each as wide as a digit.
double letters(const std::string& label) {
  double count = 0;
  for (const char c : label) {
    count += (c & 0xc0) != 0x80 ? 0.55 : 0;
  }
  return count;
}

} // namespace

TEST_CASE("labels of a colour bar never touch, and differ") {
  for (const auto& [low, high] : ranges) {
    for (const Colouring colouring : {Colouring::field, Colouring::angle, Colouring::spacing}) {
      const Scale scale = make_scale({low, high}, colouring);
      for (const double width : {4., 9., 14., 22., 28., 40.}) {
        CAPTURE(low);
        CAPTURE(high);
        CAPTURE(width);
        const AxisTicks ticks = fitted_ticks(scale, width, 0.7, letters).ticks;
        CHECK(ticks.labelled.size() <= 8);
        CHECK(ticks.labelled.size() >= (width > 20 ? 2 : 1));
        std::set<std::string> labels;
        double end = -1e9;
        for (const Tick& tick : ticks.labelled) {
          const double half = letters(tick.label) / 2;
          CHECK(tick.position * width - half >= end);
          end = tick.position * width + half + 0.7 - 1e-9;
          labels.insert(tick.label);
        }
        CHECK(labels.size() == ticks.labelled.size());
      }
    }
  }
}

TEST_CASE("labels of a narrow range are differences from a number beside the bar") {
  for (const auto& [low, high] : ranges) {
    CAPTURE(low);
    CAPTURE(high);
    const Scale scale = make_scale({low, high}, Colouring::field);
    const BarTicks bar = fitted_ticks(scale, 28, 0.7, letters);
    CHECK((bar.offset != 0) == (high - low <= 1e-3 * std::max(std::abs(low), std::abs(high))));
    for (const Tick& tick : bar.ticks.labelled) {
      if (bar.offset != 0) {
        const double label = std::stod(tick.label);
        const double value = label * std::pow(10, bar.exponent) + bar.offset;
        CHECK(scale.position(value) == doctest::Approx(tick.position).epsilon(1e-4));
        CHECK(tick.label.size() <= 5);
      }
    }
  }
}

TEST_CASE("a scale of equal values says that they are constant, or how much they differ") {
  const auto text = [](double low, double high, Colouring colouring) {
    const Scale scale = make_scale({low, high, std::nan("")}, colouring);
    CHECK(scale.constant);
    CHECK(scale.position(low) == doctest::Approx(0.5).epsilon(1e-4));
    return constant_text(scale);
  };
  CHECK(text(1.234, 1.234, Colouring::field) == "constant 1.234");
  CHECK(text(0, 0, Colouring::field) == "constant 0");
  CHECK(text(-2e-12, -2e-12, Colouring::field) ==
        "constant \u22122\u2009\u00d7\u200910^{\u221212}");
  CHECK(text(2 - 3e-8, 2 + 3e-8, Colouring::field) == "2 \u00b1 3\u2009\u00d7\u200910^{\u22128}");
  Scale angles = make_scale({1.5, 1.5}, Colouring::spacing);
  angles.degrees = true;
  CHECK(constant_text(angles) == "constant 1.5\u00b0");
  CHECK(!make_scale({1, 1 + 1e-5}, Colouring::field).constant);
  CHECK(!make_scale({0, 1e-300}, Colouring::field).constant);
}

TEST_CASE("the bar of a constant field has one colour, that of the field") {
  const Folder folder;
  const Mesh mesh = delaunay(fibonacci_sphere(50));
  DrawOptions options = {.look = {.coastlines = false, .size = 400},
                         .shapes = Shapes::cells,
                         .colouring = Colouring::field,
                         .field_name = "a"};
  const Page page = page_of(options.look, true);
  const int y = static_cast<int>(page.legend_top + 0.45 * page.text); // the bar's middle
  const auto colours = [&](double last) {
    options.field.values = Eigen::VectorXd::Constant(50, 3);
    options.field.values[49] = last;
    draw(folder.file("a.png"), mesh, options);
    const Picture picture(folder.file("a.png"));
    std::set<std::uint32_t> found;
    for (int x = 100; x < 300; ++x) {
      found.insert(picture.at(x, y));
    }
    return found;
  };
  CHECK(colours(3) == std::set{packed(palette_colour(Palette::viridis, 0.5))});
  CHECK(colours(4).size() > 50);
}

TEST_CASE("a line of classes stays on the page, in letters of any size") {
  Legend legend;
  legend.scale.colouring = Colouring::valence;
  for (int valence = 3; valence <= 9; ++valence)
    legend.classes.push_back({{0.5, 0.5, 0.5}, std::to_string(valence), 88'888});
  for (const int width : {200, 340, 500, 700, 1000, 1200, 2000}) {
    CAPTURE(width);
    const double text = std::clamp(width / 46.0, 7.0, 40.0);
    cairo_surface_t* const surface =
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, static_cast<int>(5 * text));
    cairo_t* const context = cairo_create(surface);
    cairo_set_source_rgb(context, 1, 1, 1);
    cairo_paint(context);
    draw_legend(context, legend, width, 0.5 * text, text);
    cairo_surface_flush(surface);
    int first = width, last = -1;
    for (int y = 0; y < cairo_image_surface_get_height(surface); ++y)
      for (int x = 0; x < width; ++x)
        if (const auto* row =
                cairo_image_surface_get_data(surface) +
                static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface);
            (reinterpret_cast<const std::uint32_t*>(row)[x] & 0xffffff) != 0xffffff) {
          first = std::min(first, x);
          last = std::max(last, x);
        }
    cairo_destroy(context);
    cairo_surface_destroy(surface);
    CHECK(first > 0.01 * width);
    CHECK(last < 0.99 * width);
    CHECK(last > 0.9 * width); // it is not smaller than need be
  }
}

TEST_CASE("a range sets the ends of the bar, in the unit of the legend") {
  Scale scale = make_scale({1, 2, 3}, Colouring::field);
  set_range(scale, {0, 10});
  CHECK(scale.position(5) == 0.5);
  CHECK_FALSE(scale.below);
  CHECK_FALSE(scale.above);
  set_range(scale, {1.5, 2.5});
  CHECK(scale.below);
  CHECK(scale.above);
  CHECK(scale.position(3) == 1);
  Scale constant = make_scale({2, 2}, Colouring::field);
  set_range(constant, {0, 4});
  CHECK_FALSE(constant.constant);
  CHECK(constant.position(2) == 0.5);
  Scale wide = make_scale({1, 2}, Colouring::spacing);
  set_range(wide, {10, 1000}); // a magnitude over powers of ten
  CHECK(wide.position(100) == doctest::Approx(0.5));
  for (const Colouring colouring : {Colouring::valence, Colouring::region, Colouring::none}) {
    Scale classes = make_scale({5, 6}, colouring);
    CHECK(code_of([&] { set_range(classes, {0, 1}); }) == ErrorCode::invalid_argument);
  }
}

TEST_CASE(
    "colours follow a field linearly, unless it ranges over decades or another is asked for") {
  const auto is_log = [](double low, double high, Colouring colouring) {
    return make_scale({low, high}, colouring).logarithmic;
  };
  CHECK_FALSE(is_log(3, 30, Colouring::field)); // such as temperatures
  CHECK_FALSE(is_log(0, 1e6, Colouring::field));
  CHECK(is_log(1, 1e6, Colouring::field));
  CHECK(is_log(1, 5, Colouring::spacing));
  CHECK_FALSE(is_log(1, 3, Colouring::spacing));
  CHECK_FALSE(is_log(1, 1e6, Colouring::angle));
  std::vector<double> warm;
  for (int k = 0; k < 1000; ++k)
    warm.push_back(1e-4 + 0.03 * k); // a few next to 0
  CHECK_FALSE(make_scale(warm, Colouring::field).logarithmic);
  const auto looked = [](std::vector<double> values, Colouring colouring, const Look& look) {
    return make_scale(values, colouring, look).logarithmic;
  };
  CHECK(looked({3, 30}, Colouring::field, {.scale = ScaleKind::logarithmic}));
  CHECK_FALSE(looked({1, 1e6}, Colouring::field, {.scale = ScaleKind::linear}));
  CHECK_FALSE(looked({1, 5}, Colouring::spacing, {.scale = ScaleKind::linear}));
  CHECK(looked({-1, 9}, Colouring::field,
               {.range = ColourRange{1, 9}, .scale = ScaleKind::logarithmic}));
  CHECK(code_of([&] {
          looked({-1, 9}, Colouring::field, {.scale = ScaleKind::logarithmic});
        }) == ErrorCode::invalid_argument);
  CHECK(code_of([&] {
          looked({5, 6}, Colouring::valence, {.scale = ScaleKind::linear});
        }) == ErrorCode::invalid_argument);
}

TEST_CASE("a palette's colours stand at equal steps, and as text in hexadecimal digits") {
  for (const auto& [name, palette] : palette_names()) {
    CAPTURE(name);
    const std::vector<Rgb> colours = palette_colours(palette);
    REQUIRE(colours.size() == 25);
    for (std::size_t k = 0; k < 25; ++k) {
      const Rgb colour = palette_colour(palette, static_cast<double>(k) / 24);
      CHECK(packed(colour) == packed(colours[k]));
      CHECK(std::stoul(hex_text(colour), nullptr, 16) == packed(colours[k]));
    }
  }
}

TEST_CASE("a number is text in digits, or with a power of ten") {
  CHECK(number_text(1.5, 6) == "1.5");
  CHECK(number_text(-0.25, 6) == "\u22120.25");
  CHECK(number_text(6371229, 15) == "6371229");
  CHECK(number_text(1e21, 6) == "10^{21}");
  CHECK(number_text(-6.4e-9, 6) == "\u22126.4\u2009\u00d7\u200910^{\u22129}");
}
