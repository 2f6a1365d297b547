// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/spacing_law.h"
#include "draw/values.h"
#include "support/pictures.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <cmath>

using namespace calotte;
using namespace calotte::test;
using namespace calotte::tools;

namespace {

std::vector<double> cell_spacings(const Mesh& mesh) {
  return values_of(make_scene(mesh, Shapes::cells, {}), Colouring::spacing);
}

/// The density that a mesh obeys exactly: at each site h^-4, times a factor that may be other than
/// 1 for some sites.
Density obeyed_by(const Mesh& mesh, const std::function<double(std::size_t)>& factor) {
  std::vector<double> values = cell_spacings(mesh);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = factor(i) * std::pow(values[i], -4);
  }
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [values, sites = mesh.points](const Eigen::Ref<const Points3>& x,
                                                   Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      Eigen::Index nearest = 0;
      (sites.transpose() * x.col(j)).maxCoeff(&nearest);
      rho[j] = values[static_cast<std::size_t>(nearest)];
    }
  };
  return density;
}

} // namespace

TEST_CASE("a mesh that obeys its density has every cell on the line") {
  const Mesh mesh = delaunay(random_sphere(400));
  const std::vector<double> spacings = cell_spacings(mesh);
  const auto [least, greatest] = std::minmax_element(spacings.begin(), spacings.end());
  for (const double factor : {1., 7e5, 1e-9}) { // the factor of the density does not matter
    const SpacingLaw law = spacing_law(mesh, obeyed_by(mesh, [&](std::size_t) { return factor; }));
    REQUIRE(law.measured.size() == 400);
    for (std::size_t i = 0; i < 400; ++i) {
      CHECK(law.measured[i] == doctest::Approx(law.lawful[i]).epsilon(1e-12));
      CHECK(law.measured[i] == doctest::Approx(spacings[i] / *least).epsilon(1e-12));
    }
    CHECK(law.share == 1);
    CHECK(law.extreme_ratio == doctest::Approx(*greatest / *least));
    CHECK(law.measured_ratio == doctest::Approx(law.lawful_ratio));
    CHECK(law.measured_ratio <= law.extreme_ratio);
    CHECK(law.measured_ratio > 0.8 * law.extreme_ratio);
  }
}

TEST_CASE("odd cells are off the line by their factor, and do not shift others") {
  const Mesh mesh = delaunay(random_sphere(400));
  const std::vector<double> spacings = cell_spacings(mesh);
  const auto odd = [&](std::size_t i) { // the smallest cells keep the largest density
    return i % 5 == 0 && spacings[i] > 0.1 ? std::pow(1.3, 4) : 1;
  };
  const SpacingLaw law = spacing_law(mesh, obeyed_by(mesh, odd));
  std::size_t others = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    const bool is_odd = odd(i) != 1;
    CHECK(law.measured[i] == doctest::Approx((is_odd ? 1.3 : 1) * law.lawful[i]).epsilon(1e-12));
    others += is_odd ? 0 : 1;
  }
  CHECK(others < 400);
  CHECK(law.share == static_cast<double>(others) / 400);
}

TEST_CASE("norms of the sites do not matter") {
  Mesh mesh = delaunay(random_sphere(300));
  const Density bump = tanh_bump({1, 2, 3}, 0.7, 0.2, 0.01);
  const SpacingLaw unit = spacing_law(mesh, bump);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    mesh.points.col(i) *= std::ldexp(1.0, static_cast<int>(4 * i) - 600); // to 1e-180 and 1e179
  }
  const SpacingLaw scaled = spacing_law(mesh, bump);
  for (std::size_t i = 0; i < 300; ++i) {
    CHECK(scaled.lawful[i] == doctest::Approx(unit.lawful[i]).epsilon(1e-12));
    CHECK(scaled.measured[i] == doctest::Approx(unit.measured[i]).epsilon(1e-12));
  }
}

TEST_CASE("a law's slope and intercept come from the density, not from the mesh") {
  const Mesh mesh = delaunay(fibonacci_sphere(2000)); // of one spacing
  const SpacingLaw uniform = spacing_law(mesh, {});
  CHECK(uniform.lawful_ratio == 1);
  CHECK(uniform.measured_ratio == doctest::Approx(1).epsilon(0.02));
  const SpacingLaw x8 = spacing_law(mesh, tanh_bump({0, 0, 1}, 0.5, 0.1, 1.0 / 4096));
  CHECK(x8.lawful_ratio == doctest::Approx(8).epsilon(0.01));
  CHECK(x8.measured_ratio == doctest::Approx(1).epsilon(0.1));
}

TEST_CASE("an open mesh: its unbounded cells are left out; with no other there is no law") {
  const Points3 all = fibonacci_sphere(600); // from the north pole down
  const Mesh cap = delaunay(all.leftCols(200));
  const auto boundary = (cap.neighbours.array() < 0).count();
  CHECK(boundary > 0);
  CHECK(spacing_law(cap, {}).measured.size() == static_cast<std::size_t>(200 - boundary));
  Points3 square(3, 5);
  square << 0, 1, 0, -1, 0, /**/ 0, 0, 1, 0, -1, /**/ 1, 1, 1, 1, 1;
  CHECK(spacing_law(delaunay(square), {}).measured.size() == 1); // the one in the middle
  const Mesh none = delaunay(square.rightCols(4));
  CHECK(code_of([&] { spacing_law(none, {}); }) == ErrorCode::invalid_argument);
}

TEST_CASE("a density of 0 at a site is refused by the site's number") {
  const Mesh mesh = delaunay(random_sphere(50));
  const Density density = obeyed_by(mesh, [](std::size_t i) { return i < 37 ? 1 : 0; });
  const Error error = error_of([&] { spacing_law(mesh, density); });
  CHECK(error.code() == ErrorCode::invalid_argument);
  CHECK(error.index() == 37);
}

TEST_CASE("the picture has its size, the law's line is a diagonal, and odd cells are dots off it") {
  const Folder folder;
  const Mesh mesh = delaunay(random_sphere(200));
  const std::vector<double> spacings = cell_spacings(mesh);
  const auto middle = static_cast<std::size_t>(
      std::find_if(spacings.begin(), spacings.end(), [](double h) { return h > 0.25; }) -
      spacings.begin());
  REQUIRE(middle < 200);
  const Density density =
      obeyed_by(mesh, [&](std::size_t i) { return i == middle ? std::pow(1.12, 4) : 1; });
  draw_spacing_law(folder.file("a.png"), mesh, density, 1800);
  const Picture picture(folder.file("a.png"));
  const SpacingLaw law = spacing_law(mesh, density);
  const SpacingLawPage page = spacing_law_page(law, 1800);
  CHECK(picture.width() == 1800);
  CHECK(picture.height() == page.height);
  CHECK(page.deviation.top > page.spacing.bottom());
  CHECK(page.height > page.deviation.bottom());
  const auto pixel = [&](const PagePoint& at) {
    return picture.at(static_cast<int>(at.x), static_cast<int>(at.y));
  };
  const auto red = [&](const PagePoint& at) { return pixel(at) >> 16; };
  const Axis& across = page.spacing.across;
  for (const double position : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double x = across.low * std::pow(across.high / across.low, position);
    CHECK(red(page.spacing.at(x, x)) < 0x40);        // the line,
    CHECK(red(page.spacing.at(x, 1.04 * x)) < 0xf0); // its band,
    CHECK(red(page.spacing.at(x, 1.06 * x)) > 0xe0); // and beyond it paper or grid
  }
  const double x = law.lawful[middle];
  CHECK(red(page.spacing.at(x, law.measured[middle])) < 0xc0);
  CHECK(red(page.spacing.at(x, 2 * x - law.measured[middle])) > 0xe0); // nothing below the line
  CHECK(red(page.deviation.at(x, 12)) < 0xc0);
  CHECK(red(page.deviation.at(x, -12)) > 0xe0);
}

TEST_CASE("a large mesh is drawn by a sample: the file does not grow with it") {
  const Folder folder;
  const auto size = [&](std::int64_t cells) {
    draw_spacing_law(folder.file("a.svg"), delaunay(fibonacci_sphere(cells)), {});
    return fs::file_size(folder.file("a.svg"));
  };
  const auto full = size(static_cast<std::int64_t>(most_dots));
  CHECK(size(static_cast<std::int64_t>(2 * most_dots)) < 1.1 * static_cast<double>(full));
  CHECK(size(static_cast<std::int64_t>(most_dots / 2)) < 0.6 * static_cast<double>(full));
}
