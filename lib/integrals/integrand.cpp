// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/integrand.h"

namespace calotte::integrals_detail {
namespace {

/// The nodes of a rule on each of divisions^2 similar parts of a triangle, in the coordinates of
/// the whole triangle.
std::vector<QuadratureRule::Node> composite(const QuadratureRule& rule, int divisions) {
  std::vector<QuadratureRule::Node> nodes;
  const double step = 1.0 / divisions;
  const auto add = [&](double b, double c, double side) { // a part from its right-angled corner on
    for (const QuadratureRule::Node& node : rule.nodes) {
      const double whole_b = b + side * node.b, whole_c = c + side * node.c;
      nodes.push_back({1 - whole_b - whole_c, whole_b, whole_c, node.weight * step * step});
    }
  };
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; i + j < divisions; ++j) {
      add(i * step, j * step, step);
      if (i + j + 1 < divisions)
        add((i + 1) * step, (j + 1) * step, -step);
    }
  return nodes;
}

} // namespace

Integrand make_integrand(const Density& density, int rule, int divisions) {
  constexpr int points_at_sites = 3;
  if (density.uniform())
    return {DensityEvaluator(density), true, false, {}};
  const bool at_sites = rule == rule_at_sites;
  const QuadratureRule& nodes = quadrature_rule(at_sites ? points_at_sites : rule);
  return {DensityEvaluator(density), false, at_sites, composite(nodes, divisions)};
}

} // namespace calotte::integrals_detail
