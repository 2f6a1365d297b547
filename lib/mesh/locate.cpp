// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/locate.h"

#include "base/message.h"
#include "base/parallel.h"
#include "base/points.h"
#include "base/require.h"
#include "base/triangle.h"
#include "curve/box_tree.h"
#include "curve/radix_sort.h"
#include "mesh/connectivity.h"
#include "mesh/faces.h"
#include "mesh/seen_mesh.h"
#include "mesh/site_search.h"
#include "mesh/triangle_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <numbers>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

namespace calotte {
namespace mesh_detail {
namespace {

using base_detail::require;

enum class Rim { exact, within_rounding };

void require_all_finite(const PointsRef& positions) {
  for (std::int64_t i = 0; i < positions.cols(); ++i)
    if (!positions.col(i).allFinite())
      throw Error(ErrorCode::not_finite, message("position {} is not finite; leave it out", i), i);
}

void require_hints(const Ids& hints, std::int64_t positions, std::int64_t triangles) {
  require(hints.size() == 0 || hints.size() == positions,
          "there are {} hints for {} positions; give one for each, or none", hints.size(),
          positions);
  for (std::int64_t i = 0; i < hints.size(); ++i)
    if (hints[i] < -1 || hints[i] >= triangles)
      refuse_at(i, "hint {} is {}; give a triangle, 0 to {}, or -1", hints[i], triangles - 1);
}

/// A Locator in a space.
template <Space S> class LocatorIn {
public:
  using Position = typename S::Position;

  /// \param known number of triangles that the grid is made from, at most all.
  LocatorIn(const Mesh& mesh, const S& space, std::int64_t known)
      : space_(space), mesh_(mesh), seen_(mesh, space), faces_(faces_of(mesh)),
        grid_(mesh, space, std::min(known, mesh.triangles.cols())), sites_(seen_, grid_) {}

  Locations find(const PointsRef& positions, const Ids& hints, Rim rim) const {
    const std::int64_t count = positions.cols();
    Locations out{Ids(count), Triples(3, count), Ids(count)};
    for_each_position(positions, hints, [&](const Position& p, std::int32_t from, std::int64_t i) {
      return locate(p, from, rim, i, out);
    });
    return out;
  }

  Ids nearest(const PointsRef& positions, const Ids& hints) const {
    Ids out(positions.cols());
    for_each_position(positions, hints, [&](const Position& p, std::int32_t from, std::int64_t i) {
      const auto near = sites_.nearest(p, from);
      out[i] = near.site;
      return near.triangle;
    });
    return out;
  }

  IdLists nearest_few(const PointsRef& positions, std::int64_t k) const {
    k = std::min<std::int64_t>(k, mesh_.points.cols());
    IdLists out{Offsets::LinSpaced(positions.cols() + 1, 0, k * positions.cols()),
                Ids(k * positions.cols())};
    for_each_position(positions, {}, [&](const Position& p, std::int32_t from, std::int64_t i) {
      return sites_.nearest_few(p, from, out[i]);
    });
    return out;
  }

  IdLists within(const PointsRef& positions, double distance) const {
    IdLists out{Offsets::Zero(positions.cols() + 1), {}};
    for_each_position(positions, {}, [&](const Position& p, std::int32_t from, std::int64_t i) {
      sites_.for_each_within(p, distance, [&](std::int32_t) { ++out.begin[i + 1]; });
      return from;
    });
    std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
    out.items.resize(out.begin[positions.cols()]);
    for_each_position(positions, {}, [&](const Position& p, std::int32_t from, std::int64_t i) {
      auto* next = out[i].data();
      sites_.for_each_within(p, distance, [&](std::int32_t site) { *next++ = site; });
      std::ranges::sort(out[i]);
      return from;
    });
    return out;
  }

private:
  static constexpr std::int32_t outside = -1, lost = -2; ///< instead of a triangle

  /// Calls body(p, t, i) for each position; it returns a triangle near the position. The triangle t
  /// is near, too: the hint, or without hints the triangle of the previous position along the
  /// curve. For few positions, the grid gives it.
  template <class Body>
  void for_each_position(const PointsRef& positions, const Ids& hints, const Body& body) const {
    checked_positions(space_, positions);
    const std::int64_t count = positions.cols();
    require_hints(hints, count, mesh_.triangles.cols());
    const bool hinted = hints.size() > 0, few = !hinted && count < grid_.cells();
    const auto position = [&](std::int64_t i) { return seen_.position(point(positions, i)); };
    Array<std::uint64_t> keys(count);
    for_each_block(keys.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i)
        keys[i] = grid_.key_of(seen_.coordinates(position(i)));
    });
    const Order order = order_by_key(std::move(keys));
    for_each_block(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      std::int32_t t = 0;
      for (std::int64_t k = begin; k != end; ++k) {
        const std::int64_t i = order.items[k];
        const Position p = position(i);
        if (hinted && hints[i] >= 0)
          t = hints[i];
        else if (hinted || few || k == begin)
          t = grid_.start(seen_.coordinates(p));
        t = body(p, t, i);
      }
    });
  }

  /// Sets the location of a position. Returns a triangle near it.
  std::int32_t locate(const Position& p, std::int32_t from, Rim rim, std::int64_t i,
                      Locations& out) const {
    const std::int32_t end = walk(p, from);
    std::int32_t containing = end >= 0                            ? lowest_at(end, p)
                              : end == outside && sites_.convex() ? outside
                                                                  : search(p);
    if (containing < 0 && rim == Rim::within_rounding)
      containing = search_rim(p);
    out.triangle[i] = containing;
    set_weights(containing, p, i, out);
    if (rim == Rim::within_rounding && containing >= 0) {
      out.nearest[i] = -1; // not asked for
      return containing;
    }
    const auto near = sites_.nearest(p, containing >= 0 ? containing : from);
    out.nearest[i] = near.site;
    return near.triangle;
  }

  /// Crosses edges that separate p from the triangle: in a Delaunay triangulation each step leads
  /// to a higher plane of the convex hull over p, so that no triangle comes twice. Returns the
  /// triangle that contains p; `outside` where it leaves the mesh; `lost` where the walk runs in a
  /// circle, as in a mesh that is not Delaunay.
  std::int32_t walk(const Position& p, std::int32_t t) const {
    int came = 3; // the vertex across from the edge crossed last: p is on the inner side of it
    for (std::int64_t steps = 0; steps <= mesh_.triangles.cols(); ++steps) {
      int v = 0;
      while (v < 3 && (v == came || seen_.side(t, v, p) >= 0))
        ++v;
      if (v == 3)
        return is_behind(t, came, p) ? t : lost;
      const std::int32_t beyond = mesh_.neighbours(v, t);
      if (beyond < 0)
        return outside;
      came = vertex_across(mesh_.neighbours, beyond, t);
      t = beyond;
    }
    return lost;
  }

  /// Whether p is not beyond the edge that a walk crossed last. Half a period away the next
  /// triangle may use another copy of p.
  bool is_behind(std::int32_t t, int came, const Position& p) const {
    return came == 3 || mesh_.surface.period().isZero() || seen_.side(t, came, p) >= 0;
  }

  bool contains(std::int64_t t, const Position& p) const {
    return seen_.side(t, 0, p) >= 0 && seen_.side(t, 1, p) >= 0 && seen_.side(t, 2, p) >= 0;
  }

  /// The lowest of all triangles that contain p, or `outside`.
  std::int32_t search(const Position& p) const {
    std::int32_t lowest = outside;
    for (int k = 0; k < S::copies; ++k) {
      const Position copy = seen_.copy(p, k);
      const Vec3 at = seen_.coordinates(copy);
      tree().visit([&](const Box3& box) { return square_from(box, at) <= 0; },
                   [&](std::int32_t t) {
                     if ((lowest < 0 || t < lowest) && contains(t, copy))
                       lowest = t;
                   });
    }
    return lowest;
  }

  /// The lowest triangle that p is outside of by rounding alone, or `outside`.
  std::int32_t search_rim(const Position& p) const {
    std::int32_t lowest = outside;
    for (int k = 0; k < S::copies; ++k) {
      const Position copy = seen_.copy(p, k);
      const Vec3 at = seen_.coordinates(copy);
      const double rounding = 1e-15 * std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
      tree().visit([&](const Box3& box) { return square_from(box, at) <= rounding * rounding; },
                   [&](std::int32_t t) {
                     if ((lowest < 0 || t < lowest) && seen_.distance_outside(t, copy) <= rounding)
                       lowest = t;
                   });
    }
    return lowest;
  }

  /// The lowest of the triangles that meet at p.
  std::int32_t lowest_at(std::int32_t t, const Position& p) const {
    std::array<bool, 3> on{};
    int count = 0;
    for (int v = 0; v < 3; ++v) {
      on[static_cast<std::size_t>(v)] = seen_.side(t, v, p) == 0;
      count += on[static_cast<std::size_t>(v)] ? 1 : 0;
    }
    if (count == 0)
      return t;
    std::int32_t lowest = t;
    for (int v = 0; v < 3; ++v) {
      if (count == 1 && on[static_cast<std::size_t>(v)] && mesh_.neighbours(v, t) >= 0)
        lowest = std::min(lowest, mesh_.neighbours(v, t));
      if (count > 1 && !on[static_cast<std::size_t>(v)]) { // p is that vertex
        const Corner last = walk_both_ways(
            faces_, {t, v}, [&](Corner corner) { lowest = std::min(lowest, corner.triangle); });
        // Where parts of a mesh touch, there are further triangles.
        if (exists(last) && !sites_.convex())
          return search(p);
      }
    }
    return lowest;
  }

  void set_weights(std::int32_t t, const Position& p, std::int64_t i, Locations& out) const {
    if (t < 0) {
      out.weights.col(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    for (int v = 0; v < 3; ++v)
      out.weights(v, i) = seen_.side(t, v, p) == 0 ? 0 : std::max(0.0, seen_.area(t, v, p));
    out.weights.col(i) /= out.weights.col(i).sum();
  }

  const BoxTree& tree() const {
    std::call_once(made_, [&] {
      const std::int64_t count = mesh_.triangles.cols();
      std::vector<Box3> boxes(static_cast<std::size_t>(count));
      std::vector<std::uint64_t> keys(boxes.size());
      for (std::int64_t t = 0; t < count; ++t) {
        boxes[static_cast<std::size_t>(t)] = seen_.box(t);
        keys[static_cast<std::size_t>(t)] = grid_.key_of(seen_.vertex(mesh_.triangles(0, t)));
      }
      tree_ = BoxTree(boxes, keys);
    });
    return tree_;
  }

  S space_;
  const Mesh& mesh_;
  SeenMesh<S> seen_;
  Faces faces_;
  TriangleGrid<S> grid_;
  SiteSearch<S> sites_;
  mutable std::once_flag made_;
  mutable BoxTree tree_; ///< of all triangles, once a position needs them
};

/// Calls body(space) for a mesh in which positions can be.
template <class Body> decltype(auto) in_space_of_mesh(const Mesh& mesh, const Body& body) {
  require(mesh.triangles.cols() > 0, "the mesh has no triangles; give one that has");
  return in_space_of(mesh.surface, [&](const Space auto& space) {
    require_positions(space, mesh.points, "site");
    return body(space);
  });
}

/// For a single search the grid is made from few triangles: visiting all would take longer than the
/// walks.
constexpr std::int64_t known_to_one_search = 4096;

Locations locate(const Mesh& mesh, const PointsRef& positions, Rim rim) {
  return in_space_of_mesh(mesh, [&](const Space auto& space) {
    return LocatorIn(mesh, space, known_to_one_search).find(positions, {}, rim);
  });
}

} // namespace

base_detail::Points3Ref checked_positions(const Sphere&, const PointsRef& given) {
  const base_detail::Points3Ref positions = base_detail::directions_of(given);
  require_all_finite(positions);
  for (std::int64_t i = 0; i < positions.cols(); ++i)
    if (positions.col(i).isZero(0))
      throw Error(ErrorCode::zero_vector,
                  message("position {} is the zero vector, which is no direction; leave it out", i),
                  i);
  return positions;
}

base_detail::Points2Ref checked_positions(const Plane& plane, const PointsRef& given) {
  const base_detail::Points2Ref positions = base_detail::plane_points_of(given);
  require_all_finite(positions);
  require_positions(plane, positions, "position");
  return positions;
}

void require_positions_of(const Surface& surface, const PointsRef& given) {
  in_space_of(surface, [&](const Space auto& space) { checked_positions(space, given); });
}

Locations locate_within_rounding(const Mesh& mesh, const PointsRef& positions) {
  return locate(mesh, positions, Rim::within_rounding);
}

Ids find_nearest(const Mesh& mesh, const PointsRef& positions) {
  return in_space_of_mesh(mesh, [&](const Space auto& space) {
    return LocatorIn(mesh, space, known_to_one_search).nearest(positions, {});
  });
}

} // namespace mesh_detail

struct Locator::Prepared {
  template <class S>
  Prepared(const Mesh& mesh, const S& space)
      : in(std::in_place_type<mesh_detail::LocatorIn<S>>, mesh, space, mesh.triangles.cols()) {}

  std::variant<mesh_detail::LocatorIn<exact_detail::Sphere>,
               mesh_detail::LocatorIn<exact_detail::Plane>>
      in;
};

Locator::Locator(const Mesh& mesh)
    : prepared_(mesh_detail::in_space_of_mesh(mesh, [&](const auto& space) {
        return std::make_shared<const Prepared>(mesh, space);
      })) {}

Locations Locator::find(const PointsRef& positions, const Ids& hints) const {
  return std::visit(
      [&](const auto& in) { return in.find(positions, hints, mesh_detail::Rim::exact); },
      prepared_->in);
}

Ids Locator::nearest(const PointsRef& positions, const Ids& hints) const {
  return std::visit([&](const auto& in) { return in.nearest(positions, hints); }, prepared_->in);
}

IdLists Locator::nearest_few(const PointsRef& positions, std::int64_t k) const {
  mesh_detail::require(k >= 1, "k is {}; give 1 or more", k);
  return std::visit([&](const auto& in) { return in.nearest_few(positions, k); }, prepared_->in);
}

IdLists Locator::within(const PointsRef& positions, double distance) const {
  const bool sphere =
      std::holds_alternative<mesh_detail::LocatorIn<exact_detail::Sphere>>(prepared_->in);
  mesh_detail::require(distance >= 0 && std::isfinite(distance),
                       "the distance is {}; give 0 or more", distance);
  mesh_detail::require(!sphere || distance <= std::numbers::pi,
                       "the distance is {}; give an angle of at most pi", distance);
  return std::visit([&](const auto& in) { return in.within(positions, distance); }, prepared_->in);
}

Locations locate(const Mesh& mesh, const PointsRef& positions) {
  return mesh_detail::locate(mesh, positions, mesh_detail::Rim::exact);
}

} // namespace calotte
