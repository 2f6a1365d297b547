// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/quadrature.h"

#include <cassert>
#include <vector>

namespace calotte::integrals_detail {
namespace {

using Node = QuadratureRule::Node;

/// A symmetric rule is a union of orbits: the permutations of one node.
void add_3(std::vector<Node>& nodes, double weight, double a) {
  const double b = 1 - 2 * a;
  nodes.insert(nodes.end(), {{a, a, b, weight}, {a, b, a, weight}, {b, a, a, weight}});
}

std::vector<Node> nodes_of(int points) {
  std::vector<Node> nodes;
  if (points == 3) {
    add_3(nodes, 1.0 / 3, 1.0 / 6);
  } else {
    add_3(nodes, 0.223381589678011, 0.445948490915965);
    add_3(nodes, 0.109951743655322, 0.091576213509771);
  }
  // The tables have 15 digits; the weights are scaled so that their sum is 1 to rounding.
  double sum = 0;
  for (const Node& node : nodes)
    sum += node.weight;
  for (Node& node : nodes)
    node.weight /= sum;
  return nodes;
}

/// Nodes and rule of one number of points, made once.
template <int points, int degree> const QuadratureRule& rule() {
  static const std::vector<Node> nodes = nodes_of(points);
  static const QuadratureRule rule{nodes, degree};
  return rule;
}

} // namespace

const QuadratureRule& quadrature_rule(int points) {
  assert(points == 3 || points == 6);
  return points == 3 ? rule<3, 2>() : rule<6, 4>();
}

} // namespace calotte::integrals_detail
