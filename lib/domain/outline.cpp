// SPDX-License-Identifier: GPL-3.0-or-later
#include "domain/outline.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/require.h"
#include "domain/rings.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

namespace calotte::domain_detail {
namespace {

constexpr double largest_coordinate = 1e30, least_extent = 1e-30;

[[noreturn]] void refuse_domain(const std::string& what, std::int64_t index = -1) {
  refuse("the domain: " + what, index);
}

void require_ring(const DoubleMatrix& ring, std::int64_t r) {
  if (ring.rows() != 2)
    refuse_domain(message("ring {} has {}; give 2 x n columns x y", r, counted(ring.rows(), "row")),
                  r);
  if (ring.cols() < 3)
    refuse_domain(few_corners_fault(message("ring {}", r), ring.cols()), r);
  for (Eigen::Index i = 0; i < ring.cols(); ++i) {
    if (!(ring.col(i).cwiseAbs().maxCoeff() <= largest_coordinate)) // NaN included
      refuse_domain(corner_name(r, i) + " is not finite, or beyond 1e30; give numbers within", r);
    if (ring.col(i) == ring.col((i + 1) % ring.cols()))
      refuse_domain(corner_name(r, i) + " and the next are one place; leave one of them out", r);
  }
}

/// True if a point lies on an edge or at one of its ends.
bool on_edge(const Outline::Edge& edge, const Vec2& p) {
  return orientation(edge.from, edge.to, p) == 0 &&
         compare(edge.from, p) * compare(p, edge.to) >= 0;
}

/// True if two edges have a common point.
bool meet(const Outline::Edge& a, const Outline::Edge& b) {
  const int b_from = orientation(a.from, a.to, b.from), b_to = orientation(a.from, a.to, b.to),
            a_from = orientation(b.from, b.to, a.from), a_to = orientation(b.from, b.to, a.to);
  if (b_from * b_to < 0 && a_from * a_to < 0)
    return true;
  return on_edge(a, b.from) || on_edge(a, b.to) || on_edge(b, a.from) || on_edge(b, a.to);
}

/// True if two consecutive edges of a ring share more than the corner between them.
bool fold(const Outline::Edge& a, const Outline::Edge& b) {
  return on_edge(a, b.to) || on_edge(b, a.from);
}

/// True if the ray from p to the right crosses the edge. An edge contains its lower end only, so
/// that a ray through a corner counts once.
/// \pre p is not on the edge.
bool crosses_ray(const Outline::Edge& edge, const Vec2& p) {
  const bool from_below = edge.from.y <= p.y, to_below = edge.to.y <= p.y;
  if (from_below == to_below)
    return false;
  return orientation(edge.from, edge.to, p) == (from_below ? 1 : -1);
}

} // namespace

std::int64_t Outline::strip(double y) const {
  const double strip = (y - box_.low.y) / (box_.high.y - box_.low.y) * static_cast<double>(strips_);
  return static_cast<std::int64_t>(std::clamp(strip, 0.0, static_cast<double>(strips_ - 1)));
}

/// Lists the edges of each strip. There are about as many strips as edges, or fewer if long edges
/// pass through so many strips that the lists would be long.
void Outline::make_strips() {
  const auto edges = std::ssize(edges_.items);
  constexpr std::int64_t most_strips = 1 << 16, listings = 64;
  for (strips_ = std::min(edges, most_strips);; strips_ /= 2) {
    std::int64_t total = 0;
    for (const Edge& edge : edges_.items)
      total += strip(box_of(edge).high.y) - strip(box_of(edge).low.y) + 1;
    if (strips_ == 1 || total <= listings * edges)
      break;
  }
  edges_in_ = lists_by_key<std::vector<std::int32_t>>(strips_, [&](const auto& put) {
    for (std::int32_t e = 0; e < edges; ++e) {
      const Box2 own = box_of(edge(e));
      for (std::int64_t s = strip(own.low.y); s <= strip(own.high.y); ++s)
        put(s, e);
    }
  });
}

void Outline::require_simple() const {
  for (std::int32_t e = 0; e < std::ssize(edges_.items); ++e) {
    const std::int32_t following = next_in_list(edges_, e);
    for_each_listed_near(box_of(edge(e)), [&](std::int32_t f) {
      const bool bad = f == e                         ? false
                       : f == following               ? fold(edge(e), edge(f))
                       : next_in_list(edges_, f) == e ? fold(edge(f), edge(e))
                                                      : meet(edge(e), edge(f));
      if (bad)
        refuse_domain(meeting_fault(edges_, e, f), list_of(edges_, e));
    });
  }
}

/// Reverses the edges of rings that have the domain to their right.
void Outline::orient() {
  for (std::int64_t r = 0; r < edges_.size(); ++r) {
    const std::span<Edge> ring = edges_[r];
    const Vec2 corner = ring.front().from;
    int around = 0; // number of rings that enclose this one, modulo 2
    for_each_listed_near({corner, {box_.high.x, corner.y}}, [&](std::int32_t e) {
      around += list_of(edges_, e) != r && crosses_ray(edge(e), corner);
    });
    double twice_area = 0;
    for (const Edge& edge : ring)
      twice_area += (edge.from.x - corner.x) * (edge.to.y - corner.y) -
                    (edge.from.y - corner.y) * (edge.to.x - corner.x);
    const bool outer = around % 2 == 0;
    if ((twice_area > 0) != outer)
      for (Edge& edge : ring)
        std::swap(edge.from, edge.to);
    area_ += (outer ? 1 : -1) * std::abs(twice_area) / 2;
  }
}

Outline::Outline(const Surface::Rings& rings) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const DoubleMatrix& ring = rings[r];
    require_ring(ring, static_cast<std::int64_t>(r));
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const Eigen::Vector2d from = ring.col(i), to = ring.col((i + 1) % ring.cols());
      edges_.items.push_back({{from.x(), from.y()}, {to.x(), to.y()}});
    }
    edges_.begin.push_back(static_cast<std::int32_t>(edges_.items.size()));
  }
  box_ = box_of(edges_.items.front());
  for (const Edge& edge : edges_.items) {
    const Box2 own = box_of(edge);
    box_ = {{std::min(box_.low.x, own.low.x), std::min(box_.low.y, own.low.y)},
            {std::max(box_.high.x, own.high.x), std::max(box_.high.y, own.high.y)}};
  }
  if (!(std::min(box_.high.x - box_.low.x, box_.high.y - box_.low.y) >= least_extent))
    refuse_domain("it is narrower than 1e-30; give it in a smaller unit of length");
  make_strips();
  require_simple();
  orient();
}

std::vector<std::vector<Vec3>> Outline::rings() const {
  std::vector<std::vector<Vec3>> rings;
  for (std::int64_t r = 0; r < edges_.size(); ++r) {
    const std::span<const Edge> ring = edges_[r];
    std::vector<Vec3> corners;
    for (const Edge& edge : ring)
      corners.push_back({edge.from.x, edge.from.y, 0});
    if (compare(ring[0].to, ring[1].from) != 0) // orient() turned the edges, not their order
      std::reverse(corners.begin(), corners.end());
    rings.push_back(std::move(corners));
  }
  return rings;
}

Side Outline::side(const Vec2& point) const {
  if (!(point.x >= box_.low.x && point.x <= box_.high.x && point.y >= box_.low.y &&
        point.y <= box_.high.y))
    return Side::outside;
  bool boundary = false, inside = false;
  for_each_edge_near({point, {box_.high.x, point.y}}, [&](const Edge& edge) {
    if (boundary || on_edge(edge, point))
      boundary = true;
    else if (crosses_ray(edge, point))
      inside = !inside;
  });
  return boundary ? Side::boundary : inside ? Side::inside : Side::outside;
}

} // namespace calotte::domain_detail
