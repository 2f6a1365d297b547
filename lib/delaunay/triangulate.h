// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/triangle.h"
#include "base/vector_loops.h"
#include "delaunay/room.h"

#include <CGAL/Triangulation_data_structure_2.h>

#include <array>
#include <cassert>
#include <cstdint>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace calotte::delaunay_detail {

/// A site that a region triangulates.
struct Member {
  static constexpr float not_owned = -1;

  std::int32_t rank;
  float depth; ///< of an owned site: the region covers every ball of that chord around it

  bool owned() const { return depth != not_owned; }
};

/// CGAL's vertex with the data of a site that the inner loops read: one cache line.
template <class Point, class Tds = void>
struct RegionVertex : CGAL::Triangulation_ds_vertex_base_2<Tds> {
  template <class OtherTds> struct Rebind_TDS { using Other = RegionVertex<Point, OtherTds>; };
  Point point{};
  std::int32_t local = -1; ///< index in Triangulation::members(); -1 at infinity
  float depth = Member::not_owned;

  bool owned() const { return depth != Member::not_owned; }
};

/// CGAL's face with its circle and additional marks.
template <class Circle, class Tds = void>
struct RegionFace : CGAL::Triangulation_ds_face_base_2<Tds> {
  using Base = CGAL::Triangulation_ds_face_base_2<Tds>;
  using Base::Base;
  RegionFace() {} // not defaulted: CGAL's container would set all members to 0 first
  template <class OtherTds> struct Rebind_TDS { using Other = RegionFace<Circle, OtherTds>; };
  // Small members first: they fit into the padding of the base.
  std::int8_t infinite = -1; ///< index of the vertex at infinity, -1 in a finite face
  bool in_conflict = false;  ///< during an insertion
  bool certified = false;    ///< free for a later stage; false in a new face
  std::int32_t number = -1;  ///< free for a later stage; -1 in a new face
  Circle circle;             ///< of a finite face
};

/// The Delaunay triangulation of points of a Chart (see sphere_chart.h), by incremental insertion,
/// completed by one vertex at infinity that is joined to the hull.
///
/// CGAL's Triangulation_data_structure_2 stores vertices and faces. The insertion over it is that
/// of Bowyer and Watson (1981): the faces in conflict with the new site are found from the face
/// that contains it and become the star of the site, so that each is written once. (CGAL's own
/// insertion writes a star of three and flips; with its planar predicates, on 20 000 sites in the
/// same order, it took 1.6 times as long.)
///
/// Invariant after `build`: a Delaunay triangulation, ties as the Chart resolves them. From the
/// sphere's centre the vertex at infinity represents the centre, and vanishes once the sites
/// surround it.
template <class Chart> class Triangulation {
public:
  using Point = typename Chart::Point;
  using Store =
      CGAL::Triangulation_data_structure_2<RegionVertex<Point>, RegionFace<typename Chart::Circle>>;
  static_assert(sizeof(typename Store::Vertex) <= 64 && sizeof(typename Store::Face) <= 88,
                "a region is to fit into the cache");
  using Vertex = typename Store::Vertex_handle;
  using Face = typename Store::Face_handle;

  explicit Triangulation(Chart chart) : chart_(std::move(chart)) { store_.set_dimension(2); }

  /// Inserts all members, which are ordered along a curve; false if they lie on one line of the
  /// view.
  bool build(std::span<const Member> members);

  /// Inserts one more site, which is no member yet.
  void insert(const Member& member);

  /// The faces around the site that was inserted last; valid until the next insertion.
  std::span<const Face> last_star() const { return {conflicting_.data(), rim_size_}; }

  Chart& chart() { return chart_; }
  std::span<const Member> members() const { return members_; }
  static bool is_infinite(Face face) { return face->infinite >= 0; }

  template <class Body> void for_each_face(const Body& body) {
    for (auto face = store_.faces_begin(); face != store_.faces_end(); ++face)
      body(Face(face));
  }

  /// True if a point lies inside the circumcap of a face; for an infinite face, beyond the hull's
  /// edge.
  bool conflicts(Face face, const Point& p);

private:
  /// True if p lies beyond the hull's edge of an infinite face, or on it.
  bool is_beyond(Face face, const Point& p);

  /// An edge as seen from one of its faces.
  struct Edge {
    Face face;
    int index; ///< of the vertex across from the edge
  };
  /// Index in a face of its neighbour; without branches, which would be mispredicted.
  static int index_of(Face face, Face neighbour) {
    return (face->neighbor(1) == neighbour) + 2 * (face->neighbor(2) == neighbour);
  }

  Vertex make_vertex(const Member& member);
  std::array<std::int64_t, 3> first_triangle(std::span<const Member> members);
  Face locate(const Point& p);
  bool find_conflicts(Face start, const Point& p);
  void grow();
  void make_star(Vertex centre);

  Chart chart_;
  Store store_;
  Vertex infinity_;
  Face hint_;
  std::vector<Member> members_;
  // Scratch memory of insertions; its size is never 0.
  std::vector<Edge> inner_edges_ = std::vector<Edge>(64), rim_ = std::vector<Edge>(64);
  std::vector<Face> conflicting_ = std::vector<Face>(64);
  std::size_t conflicts_ = 0, rim_size_ = 0;
};

template <class Chart> auto Triangulation<Chart>::make_vertex(const Member& member) -> Vertex {
  Vertex vertex = store_.create_vertex();
  // Constructed in its final memory: a copy would wait for the writes.
  ::new (&vertex->point) Point(chart_.point(member.rank));
  vertex->local = static_cast<std::int32_t>(members_.size());
  vertex->depth = member.depth;
  members_.push_back(member);
  return vertex;
}

/// Three members not on one line of the view, counter-clockwise; the first is -1 when there are
/// none. From the centre an antipodal pair is on a line with every site, hence a second pair.
template <class Chart>
std::array<std::int64_t, 3> Triangulation<Chart>::first_triangle(std::span<const Member> members) {
  const std::int64_t n = std::ssize(members);
  if (n < 3)
    return {-1, -1, -1};
  const auto point = [&](std::int64_t i) {
    return chart_.point(members[static_cast<std::size_t>(i)].rank);
  };
  const Point a = point(0);
  for (const std::int64_t second : {1, 2})
    for (std::int64_t third = 1; third < n; ++third) {
      if (third == second)
        continue;
      const int way = chart_.orientation(a, point(second), point(third));
      if (way > 0)
        return {0, second, third};
      if (way < 0)
        return {0, third, second};
    }
  return {-1, -1, -1};
}

template <class Chart>
CALOTTE_ALL_INSTRUCTIONS bool Triangulation<Chart>::build(std::span<const Member> members) {
  const std::array<std::int64_t, 3> first = first_triangle(members);
  if (first[0] < 0)
    return false;
  members_.reserve(members.size() + members.size() / 16 + 16);
  std::array<Vertex, 3> corner;
  for (std::size_t i = 0; i < 3; ++i)
    corner[i] = make_vertex(members[static_cast<std::size_t>(first[i])]);
  const auto [a, b, c] = corner;
  infinity_ = store_.create_vertex();
  const Face abc = store_.create_face(a, b, c);
  const std::array<Face, 3> outer{store_.create_face(infinity_, c, b),
                                  store_.create_face(infinity_, a, c),
                                  store_.create_face(infinity_, b, a)};
  abc->set_neighbors(outer[0], outer[1], outer[2]);
  outer[0]->set_neighbors(abc, outer[2], outer[1]);
  outer[1]->set_neighbors(abc, outer[0], outer[2]);
  outer[2]->set_neighbors(abc, outer[1], outer[0]);
  for (const Face face : outer)
    face->infinite = 0;
  abc->circle = chart_.circle(a->point, b->point, c->point);
  hint_ = abc;

  // Members are inserted along the curve, so that walks take few steps, and in rounds from coarse
  // to fine, so that the hull is soon complete and stars stay small.
  const std::int64_t n = std::ssize(members);
  constexpr std::array<std::int64_t, 3> strides{256, 16, 1}; // powers of two, for the mask
  for (std::size_t round = 0; round < strides.size(); ++round)
    for (std::int64_t i = 0; i < n; i += strides[round]) {
      if (round > 0 && (i & (strides[round - 1] - 1)) == 0) // i is of an earlier round
        continue;
      if (const std::int64_t ahead = i + 8 * strides[round]; ahead < n)
        chart_.expect(members[static_cast<std::size_t>(ahead)].rank);
      if (i != first[0] && i != first[1] && i != first[2])
        insert(members[static_cast<std::size_t>(i)]);
    }
  return true;
}

template <class Chart> void Triangulation<Chart>::insert(const Member& member) {
  const Vertex vertex = make_vertex(member);
  const Face start = locate(vertex->point);
  while (!find_conflicts(start, vertex->point))
    grow();
  make_star(vertex);
}

/// A face in conflict with p, by a visibility walk towards p. The walk ends in a Delaunay
/// triangulation, whose faces seen from any point are ordered without a cycle, at the latest in the
/// face that contains p, or in an infinite face if p lies beyond the hull. Behind an edge, p is
/// beyond one of the other two edges of a face without conflict: a test of one of them decides, and
/// begins before the result of the conflict is needed, so that the processor overlaps the tests.
template <class Chart> auto Triangulation<Chart>::locate(const Point& p) -> Face {
  Face face = is_infinite(hint_) ? hint_->neighbor(hint_->infinite) : hint_;
  const auto is_beyond_edge = [&](int i) {
    return chart_.orientation(face->vertex(next_vertex(i))->point,
                              face->vertex(previous_vertex(i))->point, p) < 0;
  };
  if (conflicts(face, p))
    return face;
  int out = is_beyond_edge(0) ? 0 : is_beyond_edge(1) ? 1 : 2;
  for (;;) {
    const Face beyond = face->neighbor(out);
    const int back = index_of(beyond, std::exchange(face, beyond));
    if (is_infinite(face))
      return face;
    if (conflicts(face, p))
      return face;
    out = is_beyond_edge(next_vertex(back)) ? next_vertex(back) : previous_vertex(back);
  }
}

template <class Chart> inline bool Triangulation<Chart>::conflicts(Face face, const Point& p) {
  if (!is_infinite(face)) [[likely]]
    return chart_.in_circle(face->circle, face->vertex(0)->point, face->vertex(1)->point,
                            face->vertex(2)->point, p) > 0;
  return is_beyond(face, p);
}

template <class Chart> bool Triangulation<Chart>::is_beyond(Face face, const Point& p) {
  const Point& a = face->vertex(next_vertex(face->infinite))->point;
  const Point& b = face->vertex(previous_vertex(face->infinite))->point;
  const int way = chart_.orientation(a, b, p);
  return way != 0 ? way > 0 : chart_.between(a, p, b);
}

/// Finds the conflicting faces, which are connected, and their rim, breadth first: the next edges
/// are known before the last result, so that the processor overlaps their tests.
/// \return false, with no face marked, if the scratch is too small.
template <class Chart> bool Triangulation<Chart>::find_conflicts(Face start, const Point& p) {
  // Local pointers stay in registers: as members, they would make each edge wait for memory.
  Face* conflicting = conflicting_.data();
  Edge *inner = inner_edges_.data(), *end = inner, *rim = rim_.data();
  const Edge* const last_with_room = inner + inner_edges_.size() - 2;
  start->in_conflict = true;
  *conflicting++ = start;
  for (int i = 0; i < 3; ++i)
    *end++ = {start, i};
  for (; inner != end; ++inner) {
    const Face face = inner->face->neighbor(inner->index);
    const int back = index_of(face, inner->face);
    if (face->in_conflict) // reached around a vertex that vanishes
      continue;
    if (!conflicts(face, p)) {
      rim->face = face; // field by field: a temporary edge would pass through memory
      rim++->index = back;
      continue;
    }
    face->in_conflict = true;
    *conflicting++ = face;
    if (end > last_with_room) {
      while (conflicting != conflicting_.data())
        (*--conflicting)->in_conflict = false;
      return false;
    }
    end->face = face;
    end++->index = next_vertex(back);
    end->face = face;
    end++->index = previous_vertex(back);
  }
  conflicts_ = static_cast<std::size_t>(conflicting - conflicting_.data());
  rim_size_ = static_cast<std::size_t>(rim - rim_.data());
  return true;
}

template <class Chart> void Triangulation<Chart>::grow() {
  inner_edges_.resize(2 * inner_edges_.size());
  rim_.resize(inner_edges_.size());
  conflicting_.resize(inner_edges_.size());
}

/// Replaces the conflicting faces by the star of a vertex over their rim. The face pointers of the
/// rim's vertices identify which faces of the star are neighbours.
template <class Chart> void Triangulation<Chart>::make_star(Vertex centre) {
  for (; conflicts_ < rim_size_; ++conflicts_)
    conflicting_[conflicts_] = store_.create_face();
  assert(conflicts_ == rim_size_);
  for (std::size_t e = 0; e < rim_size_; ++e) {
    const auto [outer, index] = rim_[e];
    const Face face = conflicting_[e];
    const Vertex a = outer->vertex(previous_vertex(index)), b = outer->vertex(next_vertex(index));
    face->set_vertices(centre, a, b);
    face->set_neighbor(0, outer);
    outer->set_neighbor(index, face);
    a->set_face(face);
    face->infinite = a == infinity_   ? std::int8_t{1}
                     : b == infinity_ ? std::int8_t{2}
                                      : std::int8_t{-1};
    face->in_conflict = false;
    face->certified = false;
    if (face->infinite < 0)
      face->circle = chart_.circle(centre->point, a->point, b->point);
  }
  for (std::size_t e = 0; e < rim_size_; ++e) {
    const Face face = conflicting_[e], following = face->vertex(2)->face();
    face->set_neighbor(1, following);
    following->set_neighbor(2, face);
  }
  hint_ = conflicting_[0];
  centre->set_face(hint_);
}

} // namespace calotte::delaunay_detail
