// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/vector_field.h"

#include <calotte/generators.h>

#include <tbb/task_arena.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace calotte;
using namespace calotte::base_detail;

TEST_CASE("compact fields err by single precision, whatever the scale of the vectors") {
  const Points3 a = random_sphere(5000), b = random_sphere(5000, 2);
  for (const double scale : {1e-100, 1e-20, 1.0, 1e20, 1e100}) {
    const Points3 vectors = scale * a;
    const CompactField field = compacted(vectors, inner(vectors, vectors));
    CHECK((expanded(field) - vectors).cwiseAbs().maxCoeff() < 1e-7 * scale);
    const CompactField other = compacted(b, inner(b, b));
    const auto near = [&](double product, const Points3& x, const Points3& y) {
      return product == doctest::Approx(inner(x, y)).epsilon(1e-5);
    };
    const std::vector<CompactField> both{field, other};
    const std::vector<double> products = inner_of_each(both, b);
    CHECK(near(products[0], vectors, b));
    CHECK(near(products[1], b, b));
    const Part all{0, b.cols()};
    CHECK(near(inner(other, field, all), b, vectors));
    CHECK(near(inner(vectors, b, {0, 1234}) + inner(vectors, b, {1234, b.cols()}), vectors, b));
    Points3 sum = b;
    set_sum(sum, -scale, sum, std::vector<double>{2, scale}, both, all);
    CHECK((sum - 2 * vectors).cwiseAbs().maxCoeff() < 1e-6 * scale);
    CompactField difference;
    prepare(difference, scale, b.cols());
    set_difference(vectors, scale * b, difference, all);
    const Points3 exact = vectors - scale * b;
    CHECK((expanded(difference) - exact).cwiseAbs().maxCoeff() < 1e-6 * scale);
    CHECK(near(inner(difference, difference, all), exact, exact));
  }
}

TEST_CASE("a square over weights") {
  const Points3 a = random_sphere(5000); // unit vectors
  Array<double> weights(5000);
  std::fill(weights.begin(), weights.end(), 4);
  CHECK(square_over(compacted(a, 5000), weights) == doctest::Approx(1250).epsilon(1e-6));
}

TEST_CASE("compact fields of zeros, and of no vectors, stay so") {
  const Points3 zeros = Points3::Zero(3, 7), none(3, 0);
  CHECK(expanded(compacted(zeros, 0)) == zeros);
  CHECK(expanded(compacted(none, 0)).cols() == 0);
}

TEST_CASE("sums over compact fields have the same bits for any number of threads") {
  const Points3 a = random_sphere(20000), b = random_sphere(20000, 2);
  const CompactField field = compacted(a, inner(a, a));
  const std::vector<CompactField> both{field, compacted(b, inner(b, b))};
  const std::vector<double> here = inner_of_each(both, b);
  for (const int threads : {1, 2, 4})
    CHECK(tbb::task_arena(threads).execute([&] { return inner_of_each(both, b); }) == here);
}
