// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lists.h"
#include "base/points.h"
#include "base/vec3.h"
#include "domain/room.h"
#include "exact/plane_predicates.h"

#include <calotte/surface.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace calotte::domain_detail {

/// A box of x from `low.x` to `high.x` and y from `low.y` to `high.y`.
struct Box2 {
  Vec2 low, high;
};

enum class Side { outside, boundary, inside };

/// The boundary of a domain, prepared for many queries: horizontal strips list the edges that pass
/// through them.
class Outline {
public:
  /// The domain lies to the left of an edge.
  struct Edge {
    Vec2 from, to;
  };

  /// \pre there are rings. \throws Error as Surface::within().
  explicit Outline(const Surface::Rings& rings);

  const Box2& box() const { return box_; } ///< the bounding box
  double area() const { return area_; }
  const std::vector<Edge>& edges() const { return edges_.items; } ///< ring by ring
  /// The corners of each ring in the order that has the domain to the left; z = 0.
  std::vector<std::vector<Vec3>> rings() const;

  /// The position of a point relative to the boundary; exact.
  Side side(const Vec2& point) const;

  /// Calls body(edge) once for each edge whose bounding box meets a box.
  template <class Body> void for_each_edge_near(const Box2& box, const Body& body) const {
    for_each_listed_near(box, [&](std::int32_t e) { body(edge(e)); });
  }

private:
  template <class Body> void for_each_listed_near(const Box2& box, const Body& body) const {
    const std::int64_t first = strip(box.low.y), last = strip(box.high.y);
    for (std::int64_t s = first; s <= last; ++s)
      for (const std::int32_t e : edges_in_[s]) {
        const Box2 own = box_of(edge(e));
        // An edge is reported in the first strip that it shares with the box.
        if (own.low.x <= box.high.x && own.high.x >= box.low.x && own.low.y <= box.high.y &&
            own.high.y >= box.low.y && s == std::max(first, strip(own.low.y)))
          body(e);
      }
  }
  static Box2 box_of(const Edge& edge) {
    return {{std::min(edge.from.x, edge.to.x), std::min(edge.from.y, edge.to.y)},
            {std::max(edge.from.x, edge.to.x), std::max(edge.from.y, edge.to.y)}};
  }
  std::int64_t strip(double y) const; ///< clamped to existing strips
  const Edge& edge(std::int32_t e) const { return edges_.items[static_cast<std::size_t>(e)]; }
  void make_strips();
  void require_simple() const;
  void orient();

  Lists<std::vector<Edge>, std::vector<std::int32_t>> edges_{{0}, {}}; ///< by ring
  Box2 box_{{0, 0}, {0, 0}};
  double area_ = 0;
  std::int64_t strips_ = 1;
  Lists<std::vector<std::int32_t>, std::vector<std::int64_t>> edges_in_; ///< by strip
};

/// The square of the distance between an edge and a point; rounded.
inline double square_from(const Outline::Edge& edge, const Vec2& point) {
  const double x = edge.to.x - edge.from.x, y = edge.to.y - edge.from.y, square = x * x + y * y,
               dx = point.x - edge.from.x, dy = point.y - edge.from.y,
               share = square > 0 ? std::clamp((x * dx + y * dy) / square, 0.0, 1.0) : 0;
  const double beside_x = dx - share * x, beside_y = dy - share * y;
  return beside_x * beside_x + beside_y * beside_y;
}

} // namespace calotte::domain_detail
