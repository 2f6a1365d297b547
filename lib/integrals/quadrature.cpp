// SPDX-License-Identifier: GPL-3.0-or-later
#include "integrals/quadrature.h"

#include <calotte/error.h>

#include <string>
#include <vector>

namespace calotte::integrals_detail {
namespace {

using Node = QuadratureRule::Node;

/// A symmetric rule is a union of orbits: the permutations of one node.
void add_centre(std::vector<Node>& nodes, double weight) {
  nodes.push_back({1.0 / 3, 1.0 / 3, 1.0 / 3, weight});
}
void add_3(std::vector<Node>& nodes, double weight, double a) {
  const double b = 1 - 2 * a;
  nodes.insert(nodes.end(), {{a, a, b, weight}, {a, b, a, weight}, {b, a, a, weight}});
}
void add_6(std::vector<Node>& nodes, double weight, double a, double b) {
  const double c = 1 - a - b;
  nodes.insert(nodes.end(), {{a, b, c, weight},
                             {a, c, b, weight},
                             {b, a, c, weight},
                             {b, c, a, weight},
                             {c, a, b, weight},
                             {c, b, a, weight}});
}

std::vector<Node> nodes_of(int points) {
  std::vector<Node> nodes;
  switch (points) {
  case 1:
    add_centre(nodes, 1);
    break;
  case 3:
    add_3(nodes, 1.0 / 3, 1.0 / 6);
    break;
  case 6:
    add_3(nodes, 0.223381589678011, 0.445948490915965);
    add_3(nodes, 0.109951743655322, 0.091576213509771);
    break;
  case 7:
    add_centre(nodes, 0.225);
    add_3(nodes, 0.132394152788506, 0.470142064105115);
    add_3(nodes, 0.125939180544827, 0.101286507323456);
    break;
  case 13:
    add_centre(nodes, -0.149570044467682);
    add_3(nodes, 0.175615257433208, 0.260345966079040);
    add_3(nodes, 0.053347235608838, 0.065130102902216);
    add_6(nodes, 0.077113760890257, 0.048690315425316, 0.312865496004874);
    break;
  default: // 19
    add_centre(nodes, 0.097135796282799);
    add_3(nodes, 0.031334700227139, 0.489682519198738);
    add_3(nodes, 0.077827541004774, 0.437089591492937);
    add_3(nodes, 0.079647738927210, 0.188203535619033);
    add_3(nodes, 0.025577675658698, 0.044729513394453);
    add_6(nodes, 0.043283539377289, 0.036838412054736, 0.221962989160766);
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
  switch (points) {
  case 1:
    return rule<1, 1>();
  case 3:
    return rule<3, 2>();
  case 6:
    return rule<6, 4>();
  case 7:
    return rule<7, 5>();
  case 13:
    return rule<13, 7>();
  case 19:
    return rule<19, 9>();
  default:
    throw Error(ErrorCode::invalid_argument, "there is no quadrature rule of " +
                                                 std::to_string(points) +
                                                 " points: take 1, 3, 6, 7, 13 or 19");
  }
}

} // namespace calotte::integrals_detail
