// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/eigenvalues.h"

#include "base/array.h"
#include "base/parallel.h"
#include "base/solvers.h"
#include "base/split_mix.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace calotte::quality_detail {
namespace {

using Values = Array<double>;

double squared_norm(const Values& x) {
  return sums_over_blocks(x.size(), 1, [&](Part part, std::span<double> sums) {
    for (std::int64_t i = part.begin; i != part.end; ++i)
      sums[0] += x[i] * x[i];
  })[0];
}

void fill_with_noise(Values& x) {
  for_each_block(x.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    SplitMix random(1, static_cast<std::uint64_t>(begin));
    for (std::int64_t i = begin; i != end; ++i)
      x[i] = random.signed_unit();
  });
  const double scale = 1 / std::sqrt(squared_norm(x));
  for (double& value : x)
    value *= scale;
}

/// The largest eigenvalue of a symmetric matrix, to a few parts in a thousand.
/// \param row(x, i) the product of row i with x.
template <class Row> double largest_eigenvalue(std::int64_t n, const Row& row) {
  constexpr int most_steps = 300, between = 8;
  constexpr int first_test = 24;  // noise contains little of an eigenvector of one short edge
  constexpr double enough = 1e-3; // change of the Ritz value over `between` steps
  Values now(n), before(n), product(n);
  fill_with_noise(now);
  std::fill(before.begin(), before.end(), 0.0);
  std::vector<double> diagonal, beside;
  double found = 0;
  for (int step = 1; step <= most_steps; ++step) {
    const double last = beside.empty() ? 0 : beside.back();
    const double along = sums_over_blocks(n, 1, [&](Part part, std::span<double> sums) {
      for (std::int64_t i = part.begin; i != part.end; ++i) {
        product[i] = row(now, i);
        sums[0] += product[i] * now[i];
      }
    })[0];
    const double rest = std::sqrt(sums_over_blocks(n, 1, [&](Part part, std::span<double> sums) {
      for (std::int64_t i = part.begin; i != part.end; ++i) {
        product[i] -= along * now[i] + last * before[i];
        sums[0] += product[i] * product[i];
      }
    })[0]);
    diagonal.push_back(along);
    const bool complete = !(rest > 1e-12 * std::abs(along)); // the space contains the eigenvector
    if ((step >= first_test && step % between == 0) || complete) {
      const double ritz = largest_tridiagonal_eigenvalue(diagonal, beside);
      if (complete || ritz - found <= enough * ritz)
        return ritz;
      found = ritz;
    }
    beside.push_back(rest);
    for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        product[i] /= rest;
    });
    std::swap(before, now);
    std::swap(now, product);
  }
  return found;
}

/// By cell or vertex 1 / sqrt(area); 0 where there is no area.
template <class Area> Values inverse_roots(std::int64_t n, const Area& area) {
  Values roots(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      roots[i] = area(i) > 0 ? 1 / std::sqrt(area(i)) : 0;
  });
  return roots;
}

bool is_whole(const Voronoi& of, std::int64_t vertex) {
  return of.cells_on_vertex.col(vertex).minCoeff() >= 0 &&
         of.edges_on_vertex.col(vertex).minCoeff() >= 0;
}

/// Whether an edge between two whole vertices has no length.
bool has_point_edge(const Voronoi& of) {
  return !holds_for_blocks(of.dv.size(), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t e = begin; e != end; ++e)
      if (!(of.dv[e] > 1e-12 * of.dc[e]) && is_whole(of, of.vertices_on_edge(0, e)) &&
          is_whole(of, of.vertices_on_edge(1, e)))
        return false;
    return true;
  });
}

} // namespace

double primal_eigenvalue(const Voronoi& of) {
  const std::int64_t n = of.cells.cols();
  const Values roots = inverse_roots(n, [&](std::int64_t i) { return of.cell_area[i]; });
  return largest_eigenvalue(n, [&](const Values& x, std::int64_t i) {
    double sum = 0;
    const std::span<const std::int32_t> edges = of.edges_on_cell[i], others = of.cells_on_cell[i];
    for (std::size_t k = 0; k != edges.size(); ++k)
      if (const std::int32_t edge = edges[k], other = others[k]; other >= 0)
        sum += of.dv[edge] / of.dc[edge] * (roots[i] * x[i] - roots[other] * x[other]);
    return roots[i] * sum;
  });
}

double dual_eigenvalue(const Voronoi& of) {
  if (has_point_edge(of))
    return std::numeric_limits<double>::infinity();
  const std::int64_t m = of.vertices.cols();
  const Values roots =
      inverse_roots(m, [&](std::int64_t t) { return is_whole(of, t) ? of.vertex_area[t] : 0.0; });
  return largest_eigenvalue(m, [&](const Values& x, std::int64_t t) {
    if (roots[t] == 0)
      return 0.0;
    double sum = 0;
    for (int j = 0; j < 3; ++j) {
      const std::int32_t edge = of.edges_on_vertex(j, t);
      const std::int32_t first = of.vertices_on_edge(0, edge);
      const std::int32_t other = first == t ? of.vertices_on_edge(1, edge) : first;
      if (roots[other] > 0)
        sum += of.dc[edge] / of.dv[edge] * (roots[t] * x[t] - roots[other] * x[other]);
    }
    return roots[t] * sum;
  });
}

} // namespace calotte::quality_detail
