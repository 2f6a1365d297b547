// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/shape.h"

#include "base/array.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "cvt/cells.h"
#include "integrals/patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace calotte::cvt_detail {
namespace {

/// The angle of a triangle at its vertex c, from a to b counter-clockwise.
struct Angle {
  std::int32_t a, b, c;
};

template <Space S> Angle angle_at(const PositionedMesh<S>& mesh, std::int32_t t, int v) {
  return {mesh.site(t, next_vertex(v)), mesh.site(t, previous_vertex(v)), mesh.site(t, v)};
}

/// The cotangent N/Q of an angle between the sides u and v, N = u v, Q = |u x v|.
struct Cotangent {
  double value, area; ///< area Q of the parallelogram
  Vec3 u, v, normal;  ///< unit normal

  template <Space S>
  Cotangent(const PositionedMesh<S>& mesh, const Angle& angle)
      : u(mesh.offset(angle.c, angle.a)), v(mesh.offset(angle.c, angle.b)) {
    const Vec3 product = cross(u, v);
    area = norm(product);
    normal = (1 / area) * product;
    value = dot(u, v) / area;
  }
  Vec3 derivative_a() const { return (1 / area) * (v - value * cross(v, normal)); }
  Vec3 derivative_b() const { return (1 / area) * (u - value * cross(normal, u)); }
};

/// A term in the gradient of one generator.
struct Share {
  std::int32_t site;
  Vec3 vector;
};

/// The penalty of some triangles.
struct PenaltyPart {
  ShapeTerms terms;
  std::vector<Share> shares;
  std::vector<std::int32_t> generators; ///< of shapes with more than the accepted excess

  /// Adds the term of an angle, a ratio or a side, and returns its derivative by the excess.
  double add(double factor, double excess, const std::array<std::int32_t, 2>& of) {
    if (excess > terms.worst) {
      terms.worst = excess;
      terms.worst_generator = of[0];
    }
    if (excess > accepted_excess)
      generators.insert(generators.end(), of.begin(), of.end());
    return add_square(factor, excess);
  }
  /// The same for midpoints, which decide nothing.
  double add_off_midpoint(double factor, double excess) {
    terms.off_midpoint += factor * excess * excess;
    return add_square(factor, excess);
  }
  void add_shares(const Angle& angle, const Cotangent& cotangent, double slope) {
    const Vec3 a = slope * cotangent.derivative_a(), b = slope * cotangent.derivative_b();
    shares.push_back({angle.a, a});
    shares.push_back({angle.b, b});
    shares.push_back({angle.c, -1 * (a + b)});
  }

private:
  double add_square(double factor, double excess) {
    terms.value += factor * excess * excess;
    return 2 * factor * excess;
  }
};

/// The excess of a value below the lower limit (negative slope) or above the upper limit.
struct Excess {
  double size, sign;
};

Excess excess_of(double value, double lower, double upper) {
  if (value < lower)
    return {lower - value, -1};
  return {std::max(value - upper, 0.0), 1};
}

/// The distance of an edge's midpoint from that of its Voronoi edge, over the edge's length, from
/// the cotangents across: the circumcentres are half the edge times these away from it. Negative
/// where the first triangle's is nearer.
double off_midpoint(double cotangent, double beyond) { return (cotangent - beyond) / 4; }

template <Space S> class Penalty {
public:
  Penalty(const ShapeInput<S>& input, const ShapeFactors& factors)
      : mesh_(input.mesh), inverse_spacing_(input.inverse_spacing), limits_(input.limits),
        fixed_(input.fixed), factors_(factors) {}

  void add_triangle(std::int32_t t, PenaltyPart& part) const {
    if (!is_inner(t))
      return;
    int v = 0;
    mesh_.mesh.triangles.col(t).minCoeff(&v); // determines the order of the sums
    for (int k = 0; k < 3; ++k, v = next_vertex(v)) {
      const Angle angle = angle_at(mesh_, t, v);
      const Cotangent cotangent(mesh_, angle);
      const Excess excess =
          excess_of(cotangent.value, limits_.least_cotangent, limits_.most_cotangent);
      if (excess.size > 0 && may_change(angle))
        part.add_shares(angle, cotangent,
                        excess.sign * part.add(factors_.shapes, excess.size, {angle.c, angle.c}));
      add_side(angle, t, v, part);
      if (beyond_edges(cotangent.value) || limits_.most_off_midpoint < any_off_midpoint)
        add_edge(t, v, angle, cotangent, part);
    }
  }

private:
  bool is_fixed(std::int32_t i) const {
    return !fixed_.empty() && fixed_[static_cast<std::size_t>(i)] == pinned;
  }
  bool is_on_boundary(std::int32_t i) const {
    return is_fixed(i) || (!fixed_.empty() && fixed_[static_cast<std::size_t>(i)] == sliding);
  }
  bool may_change(const Angle& angle) const {
    return !is_fixed(angle.a) || !is_fixed(angle.b) || !is_fixed(angle.c);
  }
  bool beyond_edges(double cotangent) const {
    return cotangent < limits_.least_edge || cotangent > limits_.most_edge;
  }
  bool is_inner(std::int32_t t) const {
    return mesh_.mesh.triangles.col(t).maxCoeff() < inverse_spacing_.size() && mesh_.has_centre(t);
  }

  /// Adds the penalty for the length of the side across from a vertex. Each of its triangles adds
  /// half.
  void add_side(const Angle& angle, std::int32_t t, int v, PenaltyPart& part) const {
    const Vec3 side = mesh_.offset(angle.a, angle.b);
    const double length = norm(side),
                 demanded = (inverse_spacing_[angle.a] + inverse_spacing_[angle.b]) / 2;
    if (!(demanded > 0)) // where the density is 0, no length is too short
      return;
    double least = limits_.least_spacing, most = limits_.most_spacing;
    if (is_fixed(angle.a) && is_fixed(angle.b))
      return;
    if (is_on_boundary(angle.a) && is_on_boundary(angle.b)) {
      if (const std::int32_t u = mesh_.across(t, v); u >= 0 && is_inner(u))
        return; // across a passage, whose width is not their choice
      least = std::min(least, least_along_boundary);
      most = std::max(most, most_along_boundary);
    }
    const Excess excess = excess_of(length * demanded, least, most);
    if (!(excess.size > 0))
      return;
    const Vec3 pull = (excess.sign * part.add(factors_.shapes, excess.size, {angle.a, angle.b}) *
                       demanded / length) *
                      side;
    part.shares.push_back({angle.a, -1 * pull});
    part.shares.push_back({angle.b, pull});
  }

  /// Adds the penalty for the ratio and the midpoints of the edge across from a vertex.
  void add_edge(std::int32_t t, int v, const Angle& angle, const Cotangent& cotangent,
                PenaltyPart& part) const {
    const std::int32_t u = mesh_.across(t, v);
    if (u < 0 || !is_inner(u))
      return;
    const Angle other = angle_at(mesh_, u, vertex_across(mesh_.mesh.neighbours, u, t));
    const Cotangent beyond(mesh_, other);
    if (!(may_change(angle) || may_change(other)))
      return;
    add_ratio(angle, cotangent, other, beyond, part);
    add_off_midpoint(angle, cotangent, other, beyond, part);
  }

  /// If both cotangents are beyond the limits, the triangle with the lower vertex across adds it.
  void add_ratio(const Angle& angle, const Cotangent& cotangent, const Angle& other,
                 const Cotangent& beyond, PenaltyPart& part) const {
    if (!beyond_edges(cotangent.value) || (beyond_edges(beyond.value) && other.c < angle.c))
      return;
    const Excess excess =
        excess_of((cotangent.value + beyond.value) / 2, limits_.least_edge, limits_.most_edge);
    if (!(excess.size > 0))
      return;
    const double slope =
        excess.sign * part.add(factors_.shapes, excess.size, {angle.a, angle.b}) / 2;
    part.add_shares(angle, cotangent, slope);
    part.add_shares(other, beyond, slope);
  }

  /// The triangle with the lower vertex across adds it.
  void add_off_midpoint(const Angle& angle, const Cotangent& cotangent, const Angle& other,
                        const Cotangent& beyond, PenaltyPart& part) const {
    if (other.c < angle.c)
      return;
    const double offset = off_midpoint(cotangent.value, beyond.value);
    const Excess excess = excess_of(offset, -limits_.most_off_midpoint, limits_.most_off_midpoint);
    if (!(excess.size > 0))
      return;
    const double slope = excess.sign * part.add_off_midpoint(factors_.off_midpoint, excess.size) *
                         off_midpoint(1, 0);
    part.add_shares(angle, cotangent, slope);
    part.add_shares(other, beyond, -slope);
  }

  const PositionedMesh<S> mesh_;
  const DoubleVector& inverse_spacing_;
  const ShapeLimits& limits_;
  const std::vector<std::uint8_t>& fixed_;
  const ShapeFactors factors_;
};

/// The cotangents of a triangle's angles, in single precision; NaN in a hull.
using Cotangents = std::array<float, 3>;

/// Whether a triangle may be beyond a limit of its own angles and sides.
template <Space S>
bool is_distorted(const ShapeInput<S>& input, std::int32_t triangle, Cotangents& cotangents) {
  const PositionedMesh<S>& mesh = input.mesh;
  const ShapeLimits& limits = input.limits;
  const auto ids = mesh.mesh.triangles.col(triangle);
  if (ids.maxCoeff() >= input.inverse_spacing.size()) {
    cotangents.fill(std::numeric_limits<float>::quiet_NaN());
    return false;
  }
  const Vec3 ab = mesh.offset(ids[0], ids[1]), bc = mesh.offset(ids[1], ids[2]),
             ca = mesh.offset(ids[2], ids[0]);
  const Vec3 product = cross(ab, bc);
  const double lower = std::max(limits.least_edge, limits.least_cotangent),
               upper = std::min(limits.most_edge, limits.most_cotangent);
  const double area = norm(product), low = lower * area, high = upper * area;
  const double at_a = -dot(ca, ab), at_b = -dot(ab, bc), at_c = -dot(bc, ca);
  cotangents = {static_cast<float>(at_a / area), static_cast<float>(at_b / area),
                static_cast<float>(at_c / area)};
  if (std::min({at_a, at_b, at_c}) < low || std::max({at_a, at_b, at_c}) > high)
    return true;
  const auto beyond = [&](const Vec3& side, std::int32_t i, std::int32_t j) {
    const double demanded = (input.inverse_spacing[i] + input.inverse_spacing[j]) / 2,
                 square = dot(side, side) * demanded * demanded;
    return demanded > 0 && (square < limits.least_spacing * limits.least_spacing ||
                            square > limits.most_spacing * limits.most_spacing);
  };
  return beyond(ab, ids[0], ids[1]) || beyond(bc, ids[1], ids[2]) || beyond(ca, ids[2], ids[0]);
}

/// Whether an edge of a triangle may have midpoints too far apart.
bool is_off_midpoint(const Connectivity& mesh, const Array<Cotangents>& cotangents, float most,
                     std::int32_t t) {
  for (int v = 0; v < 3; ++v)
    if (const std::int32_t u = mesh.neighbours(v, t); u >= 0) {
      const auto across = static_cast<std::size_t>(vertex_across(mesh.neighbours, u, t));
      if (std::abs(off_midpoint(cotangents[t][static_cast<std::size_t>(v)],
                                cotangents[u][across])) > most)
        return true;
    }
  return false;
}

} // namespace

template <Space S> std::vector<std::int32_t> distorted(const ShapeInput<S>& input) {
  constexpr double rounding = 1e-5; // of cotangents that are not beyond other limits
  const Connectivity& mesh = input.mesh.mesh;
  const bool to_midpoints = input.limits.most_off_midpoint < any_off_midpoint;
  const auto most = static_cast<float>(input.limits.most_off_midpoint - rounding);
  const std::int64_t count = mesh.triangles.cols();
  Array<Cotangents> cotangents(to_midpoints ? count : 0);
  std::vector<std::uint8_t> found(static_cast<std::size_t>(count));
  for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    Cotangents unused;
    for (auto t = static_cast<std::int32_t>(begin); t != end; ++t)
      found[static_cast<std::size_t>(t)] =
          is_distorted(input, t, to_midpoints ? cotangents[t] : unused);
  });
  std::vector<std::vector<std::int32_t>> parts(static_cast<std::size_t>(block_count(count)));
  for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    for (auto t = static_cast<std::int32_t>(begin); t != end; ++t)
      if (found[static_cast<std::size_t>(t)] != 0 ||
          (to_midpoints && is_off_midpoint(mesh, cotangents, most, t)))
        parts[static_cast<std::size_t>(block)].push_back(t);
  });
  std::vector<std::int32_t> all;
  for (const std::vector<std::int32_t>& part : parts)
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

template <Space S>
ShapeTerms add_shape_terms(const ShapeInput<S>& input, std::vector<std::int32_t> triangles,
                           const ShapeFactors& factors, Points3& gradient) {
  constexpr std::int64_t chunk = 512;
  sort_by_sites(triangles, input.mesh.mesh.triangles);
  const std::int64_t count = std::ssize(triangles);
  std::vector<PenaltyPart> parts(static_cast<std::size_t>((count + chunk - 1) / chunk));
  const Penalty<S> penalty(input, factors);
  for_each_task(std::ssize(parts), [&](std::int64_t k) {
    for (std::int64_t i = k * chunk; i < std::min(count, (k + 1) * chunk); ++i)
      penalty.add_triangle(triangles[static_cast<std::size_t>(i)],
                           parts[static_cast<std::size_t>(k)]);
  });
  ShapeTerms all;
  std::vector<std::int32_t> generators;
  for (const PenaltyPart& part : parts) {
    all.value += part.terms.value;
    all.off_midpoint += part.terms.off_midpoint;
    if (part.terms.worst > all.worst) {
      all.worst = part.terms.worst;
      all.worst_generator = part.terms.worst_generator;
    }
    generators.insert(generators.end(), part.generators.begin(), part.generators.end());
    for (const Share& share : part.shares)
      set_column(gradient, share.site, column(gradient, share.site) + share.vector);
  }
  std::sort(generators.begin(), generators.end());
  all.generators = std::unique(generators.begin(), generators.end()) - generators.begin();
  return all;
}

template <Space S> double shape_excess(const ShapeInput<S>& input, std::int32_t triangle) {
  PenaltyPart part;
  Penalty<S>(input, {}).add_triangle(triangle, part);
  return part.terms.worst;
}

template std::vector<std::int32_t> distorted(const ShapeInput<Sphere>&);
template std::vector<std::int32_t> distorted(const ShapeInput<Plane>&);
template double shape_excess(const ShapeInput<Sphere>&, std::int32_t);
template double shape_excess(const ShapeInput<Plane>&, std::int32_t);
template ShapeTerms add_shape_terms(const ShapeInput<Sphere>&, std::vector<std::int32_t>,
                                    const ShapeFactors&, Points3&);
template ShapeTerms add_shape_terms(const ShapeInput<Plane>&, std::vector<std::int32_t>,
                                    const ShapeFactors&, Points3&);

} // namespace calotte::cvt_detail
