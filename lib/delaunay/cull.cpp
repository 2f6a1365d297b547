// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/cull.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace calotte::delaunay_detail {
namespace {

template <class Space> using FaceOf = typename Triangulation<Space>::Face;

template <class Face> bool has_owned_vertex(Face face) {
  return face->vertex(0)->owned() || face->vertex(1)->owned() || face->vertex(2)->owned();
}

/// Radius of a ball around the centre that the region covers, at most that of the domain.
double inner_radius(const Vec3& centre, const std::vector<HalfSpace>& covered, double diameter) {
  double radius = diameter;
  for (const HalfSpace& h : covered)
    radius = std::min(radius, h.offset - dot(centre, h.normal));
  return radius;
}

/// Distance of x to the covered part's rim, if not far inside: then a lower bound.
double depth_of(const Vec3& x, const Vec3& centre, double inner,
                const std::vector<HalfSpace>& covered, double diameter) {
  double depth = inner - norm(x - centre);
  if (depth > inner / 4)
    return depth;
  depth = diameter;
  for (const HalfSpace& h : covered)
    depth = std::min(depth, h.offset - dot(x, h.normal));
  return depth;
}

// ---- The cull test

/// Error of a triangle's normal (b - a) x (c - a), for each unit of its longest side: a difference
/// of unit vectors errs by 10 roundoffs and its own rounding, the cross product by two such times a
/// side.
constexpr double normal_error = 50 * roundoff;

/// The flat triangle's normal (b - a) x (c - a), not normalised.
Vec3 normal_of(FaceOf<Sphere> face) { return face->circle.normal; }
Vec3 normal_of(FaceOf<Plane> face) {
  return cross(face->vertex(1)->place.unit - face->vertex(0)->place.unit,
               face->vertex(2)->place.unit - face->vertex(0)->place.unit);
}

/// Whether the triangle's normal points outward, so that its circumcap is less than a hemisphere.
bool is_below_hemisphere(FaceOf<Sphere> face) {
  return dot(face->circle.normal, face->vertex(0)->place.unit) > 0;
}
bool is_below_hemisphere(FaceOf<Plane>) { return true; }

/// A triangle's circumcircle, in doubles.
struct Circumcircle {
  Vec3 normal;   ///< as normal_of
  double area;   ///< its norm
  double radius; ///< of the flat triangle; on the sphere the sine of the cap's
  double error;  ///< of the normal, relative
};

template <class Face> Circumcircle circumcircle(Face face) {
  const Vec3 &a = face->vertex(0)->place.unit, &b = face->vertex(1)->place.unit,
             &c = face->vertex(2)->place.unit;
  const Vec3 ab = b - a, ac = c - a, bc = c - b;
  const double ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  const Vec3 normal = normal_of(face);
  const double area = norm(normal);
  const double longest = std::sqrt(std::max({ab2, ac2, bc2}));
  return {normal, area, std::sqrt(ab2 * ac2 * bc2) / (2 * area), normal_error * longest / area};
}

/// Whether a ball around an owned vertex that holds the circumcap is covered. Its radius is the
/// chord of the cap's diameter, 2 sin r, and sin r = |ab||ac||bc| / (2 |q|), q = ab x ac. Most
/// triangles pass, so it is written without roots or quotients; a relative error of 1e-3 in q moves
/// it by less than the 2% set aside. \pre one of its vertices is owned.
template <class Face> bool is_within_depth(Face face) {
  const auto a = face->vertex(0), b = face->vertex(1), c = face->vertex(2);
  const float depth = std::max({a->depth, b->depth, c->depth});
  assert(depth >= 0);
  const Vec3 ab = b->place.unit - a->place.unit, ac = c->place.unit - a->place.unit,
             bc = c->place.unit - b->place.unit;
  const double ab2 = dot(ab, ab), ac2 = dot(ac, ac), bc2 = dot(bc, bc);
  const Vec3 normal = normal_of(face);
  const double area2 = dot(normal, normal);
  constexpr double most_error = 1e-3, error = normal_error / most_error;
  return is_below_hemisphere(face) && area2 > error * error * std::max({ab2, ac2, bc2}) &&
         1.04 * ab2 * ac2 * bc2 < static_cast<double>(depth) * depth * area2;
}

/// Whether the cap lies in all half-spaces: its highest point over each is cos(angle - r), the
/// angle from the cap's centre to the normal, or 1 when the cap holds the normal.
bool is_covered(FaceOf<Sphere> face, const std::vector<HalfSpace>& covered) {
  const Circumcircle cap = circumcircle(face);
  if (!is_below_hemisphere(face) || !(cap.error < 1e-3) || cap.radius > 0.9)
    return false;
  const Vec3 centre = (1 / cap.area) * cap.normal;
  const double cosine = std::sqrt(1 - cap.radius * cap.radius);
  // The cap's centre errs by the normal's error e, and sin r by 1.6 e relative: by e for the
  // normal's length, by e/5 for each side, 10 roundoffs long. That moves r by 1.6 e tan r < 3.4 e.
  const double margin = 8 * cap.error + 1e-14;
  return std::all_of(covered.begin(), covered.end(), [&](const HalfSpace& h) {
    const double height = dot(centre, h.normal);
    if (height >= cosine)
      return false;
    // Near -1, the root makes 1e-8 of a rounding in the height: it must not come out too small.
    const double across = std::sqrt(1 - height * height + 1e-14);
    return height * cosine + cap.radius * across + margin <= h.offset;
  });
}

/// Whether the disc lies in all half-planes. With e the relative error of q, radius and centre,
/// a + ((ab . ab) ac - (ac . ac) ab) turned / 2q, err by some e times the radius and longest side.
bool is_covered(FaceOf<Plane> face, const std::vector<HalfSpace>& covered) {
  const Circumcircle disc = circumcircle(face);
  if (!(disc.error < 1e-3) || disc.radius > Plane::diameter)
    return false;
  const Vec3& a = face->vertex(0)->place.unit;
  const Vec3 ab = face->vertex(1)->place.unit - a, ac = face->vertex(2)->place.unit - a;
  const Vec3 across = dot(ab, ab) * ac - dot(ac, ac) * ab;
  const Vec3 centre = a + (1 / (2 * disc.normal.z)) * Vec3{across.y, -across.x, 0};
  const double margin = 16 * disc.error * disc.radius + 1e-14;
  return std::all_of(covered.begin(), covered.end(), [&](const HalfSpace& h) {
    return dot(centre, h.normal) + disc.radius + margin <= h.offset;
  });
}

// ---- Queries

Vec3 middle_of(const SiteBox& box) { return {box.middle[0], box.middle[1], box.middle[2]}; }
Vec3 half_of(const SiteBox& box) { return {box.half[0], box.half[1], box.half[2]}; }

/// The greatest d.x over offsets x from the box's middle.
double most_along(const Vec3& d, const SiteBox& box) {
  const Vec3 half = half_of(box);
  return std::abs(d.x) * half.x + std::abs(d.y) * half.y + std::abs(d.z) * half.z;
}

/// Squared distance of the box from a point.
double square_distance(const SiteBox& box, const Vec3& p) {
  const Vec3 apart = middle_of(box) - p, half = half_of(box);
  const double x = std::max(std::abs(apart.x) - half.x, 0.0),
               y = std::max(std::abs(apart.y) - half.y, 0.0),
               z = std::max(std::abs(apart.z) - half.z, 0.0);
  return x * x + y * y + z * z;
}

/// Where sites in conflict with a face may stand, in doubles: what is outside is surely outside.
template <class Space> class Zone;

template <> class Zone<Sphere> {
public:
  Zone(FaceOf<Sphere> face, const Sphere& space) {
    const std::int8_t infinite = face->infinite;
    for (int i = 0; i < 3; ++i)
      corner_[static_cast<std::size_t>(i)] =
          i == infinite ? normalised(space.view().focus) : face->vertex(i)->place.unit;
    normal_ = cross(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    const double longest = std::max({norm(corner_[1] - corner_[0]), norm(corner_[2] - corner_[0]),
                                     norm(corner_[2] - corner_[1])});
    normal_error_ = normal_error * longest;
    const double area = norm(normal_);
    cap_centre_ = area > 0 ? (1 / area) * normal_ : corner_[0];
    cap_radius_ = area > 0 ? norm(corner_[0] - cap_centre_) + 2 * normal_error_ / area + 1e-14 : 2;
  }

  /// No site of the box lies in the circumcap, whatever the rounding: the cap's centre and the
  /// chord of its radius err by the normal's error each. Of a triangle so thin that this says
  /// little, the box must be below the plane: over the vertex a and any x of the box, (x - a).q
  /// errs by |x - a| times the error and 12 roundoffs of |q|.
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

/// f(x) = n.(x - a) - q |x - a|^2 is positive inside the circle, n and q the lifted triangle's
/// normal (see plane.h); beyond a hull's edge, an infinite circle, q = 0.
template <> class Zone<Plane> {
public:
  Zone(FaceOf<Plane> face, const Plane&) {
    const std::int8_t infinite = face->infinite;
    const int first = infinite < 0 ? 0 : next_vertex(infinite);
    a_ = face->vertex(first)->place.unit;
    const Vec3 p = face->vertex(next_vertex(first))->place.unit - a_;
    if (infinite >= 0) {
      straight_ = true;
      normal_ = {-p.y, p.x, 0};
      size_ = norm(p);
      return;
    }
    const Vec3 r = face->vertex(previous_vertex(first))->place.unit - a_;
    const double p2 = dot(p, p), r2 = dot(r, r);
    normal_ = {p2 * r.y - p.y * r2, p.x * r2 - p2 * r.x, 0};
    curvature_ = p.x * r.y - p.y * r.x;
    size_ = std::sqrt(std::max(p2, r2)) + 16 * roundoff;
  }

  /// f is concave, so over the box it is at most its value in the middle and the rise of the
  /// tangent there. A frame's coordinate errs by 3 roundoffs, a difference by 6 and its own; with L
  /// the longer side from a and R the reach of the box, n errs by 36 L^2 + 8 L^3 roundoffs, q by 12
  /// L, and x - a moves f by 12 L^3 + 12 L^2 R: below 128 L (L + R)^2 in all, as L < 3. The second
  /// order counts only where L is no more than some roundoffs, which are added to it.
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

/// Sites of the whole set in conflict with a face, found from the nearest cells on: at most a few,
/// since each changes the triangulation around it. None is a member of the region, as these are in
/// no face's circle: where the circle holds members' boxes alone, nothing is looked at.
template <class Space> class ConflictQuery {
public:
  ConflictQuery(Triangulation<Space>& triangulation, const Sites& sites,
                const std::vector<Run>& members)
      : triangulation_(triangulation), sites_(sites), members_(members) {}

  /// Boxes and sites looked at so far.
  std::int64_t looks() const { return looks_; }

  const std::vector<std::int32_t>& run(FaceOf<Space> face) {
    face_ = face;
    found_.clear();
    near_ = face->vertex(face->infinite == 0 ? 1 : 0)->place.unit;
    const Zone<Space> zone(face, triangulation_.space());
    descend(sites_.boxes.levels() - 1, 0, sites_.boxes.nodes(sites_.boxes.levels() - 1), zone);
    return found_;
  }

private:
  static constexpr std::size_t enough = 8;

  /// Nodes begin to end - 1 of a level, the nearest first.
  void descend(int level, std::int64_t begin, std::int64_t end, const Zone<Space>& zone) {
    const SiteBoxes& boxes = sites_.boxes;
    std::array<std::pair<double, std::int64_t>, SiteBoxes::width> order;
    std::size_t count = 0;
    looks_ += end - begin;
    for (std::int64_t i = begin; i != end; ++i) {
      const SiteBox& box = boxes.box(level, i);
      if (zone.is_outside(box) || are_members(level, i))
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

  /// Whether all sites of a node are members of the region.
  bool are_members(int level, std::int64_t i) const {
    std::int64_t sites = SiteBoxes::width;
    for (int l = 0; l < level; ++l)
      sites *= SiteBoxes::width;
    const std::int64_t begin = i * sites, end = std::min(begin + sites, sites_.size());
    const auto beyond =
        std::upper_bound(members_.begin(), members_.end(), begin,
                         [](std::int64_t rank, const Run& run) { return rank < run.begin; });
    return beyond != members_.begin() && end <= beyond[-1].end;
  }

  void look_at(std::int64_t begin, std::int64_t end) {
    looks_ += end - begin;
    for (std::int64_t r = begin; r != end && found_.size() < enough; ++r)
      if (is_in_conflict(r))
        found_.push_back(static_cast<std::int32_t>(r));
  }

  bool is_in_conflict(std::int64_t rank) {
    for (int i = 0; i < 3; ++i)
      if (i != face_->infinite && face_->vertex(i)->place.site == sites_.id[rank])
        return false;
    Space& space = triangulation_.space();
    return space.has_place(rank) && triangulation_.conflicts(face_, space.place(rank));
  }

  Triangulation<Space>& triangulation_;
  const Sites& sites_;
  const std::vector<Run>& members_; ///< ascending
  FaceOf<Space> face_;
  Vec3 near_{};
  std::vector<std::int32_t> found_;
  std::int64_t looks_ = 0;
};

/// Certifies a face by the cull test. \return whether it still has to be: it has an owned vertex.
template <class Space>
bool is_open(FaceOf<Space> face, const std::vector<HalfSpace>& covered, CullCounts& counts) {
  if (face->certified || !has_owned_vertex(face))
    return false;
  if (Triangulation<Space>::is_infinite(face) ||
      !(is_within_depth(face) || is_covered(face, covered)))
    return true;
  face->certified = true;
  ++counts.by_cull;
  return false;
}

/// The faces that have to be certified yet.
template <class Space>
std::vector<FaceOf<Space>> open_faces(Triangulation<Space>& triangulation,
                                      const std::vector<HalfSpace>& covered, CullCounts& counts) {
  std::vector<FaceOf<Space>> open;
  triangulation.for_each_face([&](FaceOf<Space> face) {
    if (is_open<Space>(face, covered, counts))
      open.push_back(face);
  });
  return open;
}

/// Inserts sites. \return those of the faces around them, the only new ones, that are open.
template <class Space>
std::vector<FaceOf<Space>> insert_all(const std::vector<std::int32_t>& ranks,
                                      Triangulation<Space>& triangulation,
                                      const std::vector<HalfSpace>& covered, CullCounts& counts) {
  std::vector<FaceOf<Space>> around;
  for (const std::int32_t rank : ranks) {
    triangulation.insert({rank, Member::not_owned});
    const auto star = triangulation.last_star();
    around.insert(around.end(), star.begin(), star.end());
  }
  counts.inserted += std::ssize(ranks);
  // A later star may have taken a face of an earlier one. The order is that of the insertions: by
  // address, the counts of predicates would differ from run to run.
  std::vector<FaceOf<Space>> open;
  constexpr std::int32_t listed = 0, unlisted = -1;
  for (const FaceOf<Space> face : around)
    if (face->number == unlisted && is_open<Space>(face, covered, counts)) {
      face->number = listed;
      open.push_back(face);
    }
  for (const FaceOf<Space> face : open)
    face->number = unlisted;
  return open;
}

/// Whether the triangle is one of a closed mesh: finite, and its circumcap below a hemisphere.
/// Empty caps beyond that are the far side of sites that a hemisphere holds.
bool may_stand(FaceOf<Sphere> face, const Sites& sites) {
  if (Triangulation<Sphere>::is_infinite(face))
    return false;
  const auto given = [&](int i) { return sites.given(face->vertex(i)->place.site); };
  return orientation(given(0), given(1), given(2)) > 0;
}
bool may_stand(FaceOf<Plane>, const Sites&) { return true; }

/// Undecided predicates and insertions for each member, beyond which the set as a whole is cheaper:
/// a cap's lattices need a few, clusters that are hard to certify thousands.
constexpr std::int64_t effort = 16;

/// Looks of queries that cost as much as one of those. Where most sites stand along a great circle,
/// each triangle's circumcap runs past all of them, and the queries' looks grow with the square of
/// their number.
constexpr std::int64_t looks_an_effort = 4;

} // namespace

template <class Space>
std::vector<Member> gather(const Sites& sites, const Regions& regions, std::int32_t k) {
  const auto region = static_cast<std::size_t>(k);
  const std::vector<HalfSpace>& covered = regions.covered[region];
  const Vec3& centre = regions.centres[region];
  const double inner = inner_radius(centre, covered, Space::diameter);
  std::vector<Member> members;
  std::size_t count = 0;
  for (const Run& run : regions.members[region])
    count += static_cast<std::size_t>(run.end - run.begin);
  members.reserve(count);
  for (const Run& run : regions.members[region])
    for (std::int32_t r = run.begin; r != run.end; ++r) {
      if (regions.owner[r] != k) {
        members.push_back({r, Member::not_owned});
        continue;
      }
      const double depth = depth_of(sites.unit[r], centre, inner, covered, Space::diameter);
      // Rounded down, by more than the rounding of half-spaces: 1e-14.
      members.push_back({r, static_cast<float>(std::max(0.999999 * depth - 1e-14, 0.0))});
    }
  return members;
}

template <class Space>
bool certify(Triangulation<Space>& triangulation, const Sites& sites, const Regions& regions,
             std::int32_t k, CullCounts& counts) {
  const std::vector<HalfSpace>& covered = regions.covered[static_cast<std::size_t>(k)];
  ConflictQuery<Space> query(triangulation, sites, regions.members[static_cast<std::size_t>(k)]);
  const std::int64_t patience = effort * (std::ssize(triangulation.members()) + 1000);
  std::vector<FaceOf<Space>> open = open_faces(triangulation, covered, counts);
  while (!open.empty()) {
    std::vector<std::int32_t> missing;
    for (const FaceOf<Space> face : open) {
      const std::vector<std::int32_t>& found = query.run(face);
      if (counts.inserted + triangulation.space().counts().filtered +
              query.looks() / looks_an_effort >
          patience)
        return false;
      missing.insert(missing.end(), found.begin(), found.end());
      if (!found.empty())
        continue;
      if (!may_stand(face, sites))
        return false;
      face->certified = true;
      counts.by_query += !triangulation.is_infinite(face);
    }
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    open = insert_all(missing, triangulation, covered, counts); // what they found is gone
  }
  return true;
}

template <class Space> void certify_all(Triangulation<Space>& triangulation) {
  triangulation.for_each_face([](FaceOf<Space> face) { face->certified = true; });
}

template std::vector<Member> gather<Sphere>(const Sites&, const Regions&, std::int32_t);
template std::vector<Member> gather<Plane>(const Sites&, const Regions&, std::int32_t);
template bool certify(Triangulation<Sphere>&, const Sites&, const Regions&, std::int32_t,
                      CullCounts&);
template bool certify(Triangulation<Plane>&, const Sites&, const Regions&, std::int32_t,
                      CullCounts&);
template void certify_all(Triangulation<Sphere>&);
template void certify_all(Triangulation<Plane>&);

} // namespace calotte::delaunay_detail
