// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "quality/parts.h"
#include "quality/room.h"

#include <calotte/quality.h>

#include <cmath>
#include <cstdint>

/// Sums and extremes of errors, which have the same bits for any number of threads.
namespace calotte::quality_detail {

using Errors = Array<double>; ///< by cell, edge or vertex; NaN without a complete stencil

/// Squares at one point, summed over the fields.
struct Squares {
  double error = 0, exact = 0;

  void add(double value, double expected) {
    error += (value - expected) * (value - expected);
    exact += expected * expected;
  }
};

struct NormPart {
  double weight = 0, error = 0, exact = 0, greatest = 0;
  std::int64_t at = -1;

  void add(double w, const Squares& squares, std::int64_t index) {
    weight += w;
    error += w * squares.error;
    exact += w * squares.exact;
    if (at < 0 || squares.error > greatest) {
      greatest = squares.error;
      at = index;
    }
  }
  void join(const NormPart& other) {
    weight += other.weight;
    error += other.error;
    exact += other.exact;
    if (other.at >= 0 && (at < 0 || other.greatest > greatest)) {
      greatest = other.greatest;
      at = other.at;
    }
  }
};

/// The norms of errors at n points, over the root mean square of the exact values.
/// \param weight(i) of point i; 0 without a complete stencil.
/// \param measure(i) the Squares of point i.
/// \param errors receives the relative errors.
/// \returns norms whose `cell` is the index of the largest error, the first of several.
template <class Weight, class Measure>
ErrorNorms error_norms(std::int64_t n, const Weight& weight, const Measure& measure,
                       Errors& errors) {
  if (errors.size() != n) // reuses the memory of another operator
    errors = Errors(n);
  const auto sum = join_blocks<NormPart>(n, [&](NormPart& part, std::int64_t i) {
    errors[i] = no_value;
    const double w = weight(i);
    if (!(w > 0))
      return;
    const Squares squares = measure(i);
    errors[i] = squares.error;
    part.add(w, squares, i);
  });
  if (sum.at < 0)
    return {};
  const double scale = std::sqrt(sum.weight / sum.exact);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      errors[i] = scale * std::sqrt(errors[i]);
  });
  ErrorNorms out;
  out.l2 = std::sqrt(sum.error / sum.exact);
  out.max = scale * std::sqrt(sum.greatest);
  out.cell = sum.at;
  return out;
}

/// The norms of distances at n points of equal weight; `cell` is the index of the largest.
/// \param distance(i) NaN for a point to skip.
template <class Distance> ErrorNorms distance_norms(std::int64_t n, const Distance& distance) {
  Errors distances(n), squares;
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      distances[i] = distance(i);
  });
  return error_norms(
      n, [&](std::int64_t i) { return std::isnan(distances[i]) ? 0.0 : 1.0; },
      [&](std::int64_t i) {
        return Squares{distances[i] * distances[i], 1};
      },
      squares);
}

} // namespace calotte::quality_detail
