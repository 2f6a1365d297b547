// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/coverage.h"
#include "delaunay/regions.h"
#include "delaunay/site_boxes.h"
#include "delaunay/sites.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

/// The search of all sites for those in the circumcap of a region's triangle.
namespace calotte::delaunay_detail {

inline Vec3 middle_of(const SiteBox& box) { return {box.middle[0], box.middle[1], box.middle[2]}; }
inline Vec3 half_of(const SiteBox& box) { return {box.half[0], box.half[1], box.half[2]}; }

/// The maximum of d.x over offsets x from the middle of the box.
inline double most_along(const Vec3& d, const SiteBox& box) {
  const Vec3 half = half_of(box);
  return std::abs(d.x) * half.x + std::abs(d.y) * half.y + std::abs(d.z) * half.z;
}

/// Squared distance of the box from a point.
inline double square_distance(const SiteBox& box, const Vec3& p) {
  const Vec3 apart = middle_of(box) - p, half = half_of(box);
  const double x = std::max(std::abs(apart.x) - half.x, 0.0),
               y = std::max(std::abs(apart.y) - half.y, 0.0),
               z = std::max(std::abs(apart.z) - half.z, 0.0);
  return x * x + y * y + z * z;
}

/// The region in which sites in conflict with a face may lie, in doubles: a site outside it is
/// certainly not in conflict.
template <class Chart> class Zone;

template <> class Zone<SphereChart> {
public:
  Zone(FaceOf<SphereChart> face, const SphereChart& chart) {
    const std::int8_t infinite = face->infinite;
    for (int i = 0; i < 3; ++i)
      corner_[static_cast<std::size_t>(i)] =
          i == infinite ? normalised(chart.view().focus) : face->vertex(i)->point.unit;
    normal_ = cross(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    const double longest = std::max({norm(corner_[1] - corner_[0]), norm(corner_[2] - corner_[0]),
                                     norm(corner_[2] - corner_[1])});
    normal_error_ = normal_error * longest;
    const double area = norm(normal_);
    cap_centre_ = area > 0 ? (1 / area) * normal_ : corner_[0];
    cap_radius_ = area > 0 ? norm(corner_[0] - cap_centre_) + 2 * normal_error_ / area + 1e-14 : 2;
  }

  /// True if no site of the box lies in the circumcap, with rounding taken into account: the centre
  /// of the cap and the chord of its radius each err by the error of the normal. For a triangle so
  /// thin that this test is useless, the box must lie below the plane: over the vertex a and any x
  /// of the box, (x - a).q errs by |x - a| times the error and 12 roundoffs of |q|.
  bool is_outside(const SiteBox& box) const {
    if (square_distance(box, cap_centre_) > cap_radius_ * cap_radius_ * (1 + 1e-14))
      return true;
    const Vec3 apart = middle_of(box) - corner_[0];
    const double area = norm(normal_), reach = norm(apart) + norm(half_of(box));
    const double error = normal_error_ * reach + 16 * roundoff * (1 + reach) * area;
    return dot(apart, normal_) + most_along(normal_, box) < -error;
  }

private:
  std::array<Vec3, 3> corner_{};
  Vec3 normal_{}, cap_centre_{};
  double normal_error_ = 0, cap_radius_ = 0; ///< the latter a chord, and rounded up
};

/// f(x) = n.(x - a) - q |x - a|^2 is positive inside the circle, with n and q the lifted triangle's
/// normal (see plane_chart.h). Beyond an edge of the hull, the circle is infinite and q = 0.
template <> class Zone<PlaneChart> {
public:
  Zone(FaceOf<PlaneChart> face, const PlaneChart&) {
    const std::int8_t infinite = face->infinite;
    const int first = infinite < 0 ? 0 : next_vertex(infinite);
    a_ = face->vertex(first)->point.unit;
    const Vec3 p = face->vertex(next_vertex(first))->point.unit - a_;
    if (infinite >= 0) {
      straight_ = true;
      normal_ = {-p.y, p.x, 0};
      size_ = norm(p);
      return;
    }
    const Vec3 r = face->vertex(previous_vertex(first))->point.unit - a_;
    const double p2 = dot(p, p), r2 = dot(r, r);
    normal_ = {p2 * r.y - p.y * r2, p.x * r2 - p2 * r.x, 0};
    curvature_ = p.x * r.y - p.y * r.x;
    size_ = std::sqrt(std::max(p2, r2)) + 16 * roundoff;
  }

  /// f is concave, so that over the box it is at most its value in the middle plus the rise of the
  /// tangent there. A frame coordinate errs by 3 roundoffs, a difference by 6 and its own. With L
  /// the longer side from a and R the reach of the box, n errs by 36 L^2 + 8 L^3 roundoffs, q by 12
  /// L, and x - a moves f by 12 L^3 + 12 L^2 R: below 128 L (L + R)^2 in all, as L < 3. The second
  /// order matters only if L is no more than some roundoffs, which are added to it.
  bool is_outside(const SiteBox& box) const {
    const Vec3 apart = middle_of(box) - a_;
    const double reach = norm(apart) + norm(half_of(box)), q = std::max(curvature_, 0.0);
    const Vec3 slope = normal_ - 2 * q * apart;
    const double value = dot(normal_, apart) - q * dot(apart, apart) + most_along(slope, box);
    const double error = straight_ ? 32 * roundoff * (reach + size_)
                                   : 128 * roundoff * size_ * (size_ + reach) * (size_ + reach);
    return value < -error;
  }

private:
  Vec3 a_{}, normal_{};
  bool straight_ = false;
  double curvature_ = 0, size_ = 0;
};

/// True if the sites of ranks begin to end - 1 are all members. \param members ascending.
inline bool are_members(const std::vector<Run>& members, std::int64_t begin, std::int64_t end) {
  const auto beyond =
      std::upper_bound(members.begin(), members.end(), begin,
                       [](std::int64_t rank, const Run& run) { return rank < run.begin; });
  return beyond != members.begin() && end <= beyond[-1].end;
}

/// True if all sites of node i of a level of boxes are members.
inline bool are_members(const std::vector<Run>& members, const Sites& sites, int level,
                        std::int64_t i) {
  std::int64_t width = SiteBoxes::width;
  for (int l = 0; l < level; ++l)
    width *= SiteBoxes::width;
  return are_members(members, i * width, std::min((i + 1) * width, sites.size()));
}

/// Finds sites in conflict with a face, from the nearest boxes on. It returns a few at most,
/// because each changes the triangulation around it. No member of the region is among them, because
/// the circle of a face contains no member. If the circle meets only boxes of members, no site is
/// tested.
template <class Chart> class ConflictQuery {
public:
  ConflictQuery(Triangulation<Chart>& triangulation, const Sites& sites,
                const std::vector<Run>& members)
      : triangulation_(triangulation), sites_(sites), members_(members) {}

  /// Number of boxes and sites tested so far.
  std::int64_t looks() const { return looks_; }

  const std::vector<std::int32_t>& run(FaceOf<Chart> face) {
    face_ = face;
    found_.clear();
    near_ = face->vertex(face->infinite == 0 ? 1 : 0)->point.unit;
    const Zone<Chart> zone(face, triangulation_.chart());
    descend(sites_.boxes.levels() - 1, 0, sites_.boxes.nodes(sites_.boxes.levels() - 1), zone);
    return found_;
  }

private:
  static constexpr std::size_t enough = 8;

  /// Visits the nodes begin to end - 1 of a level, the nearest first.
  void descend(int level, std::int64_t begin, std::int64_t end, const Zone<Chart>& zone) {
    const SiteBoxes& boxes = sites_.boxes;
    std::array<std::pair<double, std::int64_t>, SiteBoxes::width> order;
    std::size_t count = 0;
    looks_ += end - begin;
    for (std::int64_t i = begin; i != end; ++i) {
      const SiteBox& box = boxes.box(level, i);
      if (zone.is_outside(box) || are_members(members_, sites_, level, i))
        continue;
      const std::pair<double, std::int64_t> entry{square_distance(box, near_), i};
      std::size_t c = count++;
      for (; c > 0 && entry < order[c - 1]; --c)
        order[c] = order[c - 1];
      order[c] = entry;
    }
    for (std::size_t c = 0; c < count && found_.size() < enough; ++c) {
      const std::int64_t first = order[c].second * SiteBoxes::width,
                         last = first + SiteBoxes::width;
      if (level == 0)
        look_at(first, std::min(last, sites_.size()));
      else
        descend(level - 1, first, std::min(last, boxes.nodes(level - 1)), zone);
    }
  }

  void look_at(std::int64_t begin, std::int64_t end) {
    looks_ += end - begin;
    for (std::int64_t r = begin; r != end && found_.size() < enough; ++r)
      if (is_in_conflict(r))
        found_.push_back(static_cast<std::int32_t>(r));
  }

  bool is_in_conflict(std::int64_t rank) {
    for (int i = 0; i < 3; ++i)
      if (i != face_->infinite && face_->vertex(i)->point.site == sites_.id[rank])
        return false;
    Chart& chart = triangulation_.chart();
    return chart.has_point(rank) && triangulation_.conflicts(face_, chart.point(rank));
  }

  Triangulation<Chart>& triangulation_;
  const Sites& sites_;
  const std::vector<Run>& members_; ///< ascending
  FaceOf<Chart> face_;
  Vec3 near_{};
  std::vector<std::int32_t> found_;
  std::int64_t looks_ = 0;
};

} // namespace calotte::delaunay_detail
