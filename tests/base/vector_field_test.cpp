// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/vector_field.h"

#include <calotte/generators.h>

#include <tbb/task_arena.h>

#include <doctest/doctest.h>

#include <cmath>

using namespace calotte;
using namespace calotte::base_detail;

TEST_CASE("compact fields err by single precision, whatever the scale of the vectors") {
  const Points3 a = random_sphere(5000), b = random_sphere(5000, 2);
  for (const double scale : {1e-100, 1e-20, 1.0, 1e20, 1e100}) {
    const Points3 vectors = scale * a;
    const CompactField field = compacted(vectors, inner(vectors, vectors));
    CHECK((expanded(field) - vectors).cwiseAbs().maxCoeff() < 1e-7 * scale);
    CHECK(inner(field, b) == doctest::Approx(inner(vectors, b)).epsilon(1e-5));
    Points3 sum = scale * b, expected = scale * b;
    const CompactField other = compacted(b, inner(b, b));
    const double product = inner_of_sum(sum, -2, field, other);
    expected -= 2 * vectors;
    CHECK((sum - expected).cwiseAbs().maxCoeff() < 1e-6 * scale);
    CHECK(product == doctest::Approx(inner(expected, b)).epsilon(1e-5));
  }
}

TEST_CASE("compact fields of zeros, and of no vectors, stay so") {
  const Points3 zeros = Points3::Zero(3, 7), none(3, 0);
  CHECK(expanded(compacted(zeros, 0)) == zeros);
  CHECK(expanded(compacted(none, 0)).cols() == 0);
}

TEST_CASE("sums over compact fields have the same bits for any number of threads") {
  const Points3 a = random_sphere(20000), b = random_sphere(20000, 2);
  const CompactField field = compacted(a, inner(a, a));
  const double here = inner(field, b);
  for (const int threads : {1, 2, 4})
    CHECK(tbb::task_arena(threads).execute([&] { return inner(field, b); }) == here);
}
