// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/periodic.h"

#include "base/message.h"
#include "base/require.h"
#include "mesh/adjacency.h"
#include "mesh/canonical_order.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace calotte::delaunay_detail {
namespace {

/// The sites of a box in the order of their ids, then copies of them.
struct Copies {
  std::vector<Image> images;
  std::vector<std::int32_t> site; ///< of each image
};

/// The copies up to `margin` around the box, at most half of the box: copies in the adjacent boxes
/// suffice.
Copies copies_within(const Points3& sites, const Eigen::Vector2d& period, double margin) {
  Copies copies;
  for (std::int32_t s = 0; s < sites.cols(); ++s) {
    copies.images.push_back({{sites(0, s), sites(1, s)}, 0, 0});
    copies.site.push_back(s);
  }
  const auto near = [&](double x, double length, int i) {
    const double image = x + i * length;
    return image >= -margin && image <= length + margin;
  };
  for (std::int32_t s = 0; s < sites.cols(); ++s)
    for (const int i : {-1, 0, 1})
      for (const int j : {-1, 0, 1})
        if ((i != 0 || j != 0) && near(sites(0, s), period.x(), i) &&
            near(sites(1, s), period.y(), j)) {
          copies.images.push_back({{sites(0, s), sites(1, s)}, i, j});
          copies.site.push_back(s);
        }
  return copies;
}

/// A circumcircle, in units of the longer period.
struct Circle {
  Eigen::Vector2d centre;
  double radius;
};

/// The circumcircle, computed from the corner across from the longest side. Differences of sites
/// come first, so that copies with the same shift have the offsets of their sites to the last
/// digits.
Circle circle_of(const std::array<Image, 3>& corner, const Eigen::Vector2d& period) {
  const double unit = period.maxCoeff();
  const auto side = [&](std::size_t from, std::size_t to) {
    const Image &a = corner[from % 3], &b = corner[to % 3];
    return Eigen::Vector2d((b.site.x - a.site.x) / unit + (b.i - a.i) * (period.x() / unit),
                           (b.site.y - a.site.y) / unit + (b.j - a.j) * (period.y() / unit));
  };
  std::size_t best = 0;
  for (const std::size_t k : {1U, 2U})
    if (side(k + 1, k + 2).squaredNorm() > side(best + 1, best + 2).squaredNorm())
      best = k;
  const Image& a = corner[best];
  const Eigen::Vector2d p = side(best, best + 1), q = side(best, best + 2);
  const double twice_area = p.x() * q.y() - p.y() * q.x();
  const Eigen::Vector2d across = p.squaredNorm() * q - q.squaredNorm() * p;
  const Eigen::Vector2d offset = Eigen::Vector2d(across.y(), -across.x()) / (2 * twice_area);
  const Eigen::Vector2d image(a.site.x / unit + a.i * (period.x() / unit),
                              a.site.y / unit + a.j * (period.y() / unit));
  return {image + offset, offset.norm()};
}

enum class MarginVerdict { all, need_more_margin, too_few };

/// Tests whether the circles of the triangles at the sites of the box are narrower than half of the
/// box and lie within the margin. It runs in doubles with a margin for rounding: a circle wrongly
/// reported as too wide costs time, or rejects a set that is sparse to the last digits.
MarginVerdict judge(const Mesh& mesh, const Copies& copies, std::int64_t sites,
                    const Eigen::Vector2d& period, double margin) {
  constexpr double room = 1e-6;
  const double unit = period.maxCoeff(), rim = margin / unit;
  const Eigen::Vector2d box = period / unit;
  MarginVerdict found = MarginVerdict::all;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    if (mesh.triangles.col(t).minCoeff() >= sites)
      continue;
    if (mesh.neighbours.col(t).minCoeff() < 0)
      return margin < unit / 2 ? MarginVerdict::need_more_margin : MarginVerdict::too_few;
    const auto image = [&](int v) {
      return copies.images[static_cast<std::size_t>(mesh.triangles(v, t))];
    };
    const Circle circle = circle_of({image(0), image(1), image(2)}, period);
    const double radius = circle.radius * (1 + room);
    const bool within = (circle.centre.array() - radius >= -rim).all() &&
                        (circle.centre.array() + radius <= box.array() + rim).all();
    if (!within)
      found = MarginVerdict::need_more_margin;
    if (!(radius < box.minCoeff() / 4) && within)
      return MarginVerdict::too_few;
  }
  return found;
}

/// One copy of each triangle, that whose lowest site is in the box, in canonical order.
Triangles one_copy_each(const Mesh& mesh, std::int64_t sites,
                        const std::vector<std::int32_t>& site) {
  const auto site_of = [&](std::int32_t copy) { return site[static_cast<std::size_t>(copy)]; };
  const auto is_kept = [&](Eigen::Index t) {
    const auto copies = mesh.triangles.col(t);
    return *std::min_element(copies.begin(), copies.end(), [&](std::int32_t a, std::int32_t b) {
      return site_of(a) < site_of(b);
    }) < sites;
  };
  Triangles triangles(3, mesh.triangles.cols()), unknown;
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    if (is_kept(t))
      triangles.col(kept++) = mesh.triangles.col(t);
  triangles.conservativeResize(Eigen::NoChange, kept);
  make_canonical(triangles, unknown, site);
  return triangles;
}

[[noreturn]] void refuse_few(std::int64_t sites) {
  throw Error(ErrorCode::too_few_sites,
              message("a circle wider than half of the periodic box holds none of the {} sites: "
                      "add sites, or put several copies of the box beside each other",
                      sites));
}

/// The mesh of the sites of the box, from `whole`, which contains copies.
Mesh folded(const Mesh& whole, const Copies& copies, const Points3& sites, const Surface& box) {
  Mesh mesh;
  mesh.points = sites;
  mesh.triangles = one_copy_each(whole, sites.cols(), copies.site);
  mesh.neighbours = neighbours_of(mesh.triangles, sites.cols());
  mesh.surface = box;
  if (mesh.triangles.cols() != 2 * sites.cols())
    throw Error(ErrorCode::internal, message("a periodic box of {} sites has {} triangles: "
                                             "please report this input as a bug",
                                             sites.cols(), mesh.triangles.cols()));
  return mesh;
}

} // namespace

Mesh triangulate_periodic(const Points3& sites, const Surface& box,
                          const TriangulateImages& triangulate) {
  const Eigen::Vector2d& period = box.period();
  const double most = period.maxCoeff() / 2, spacing = std::sqrt(period.x()) *
                                                       std::sqrt(period.y()) /
                                                       std::sqrt(static_cast<double>(sites.cols()));
  double margin = std::clamp(6 * spacing, most * 0x1p-20, most);
  for (;; margin = std::min(most, 2 * margin)) {
    const Copies copies = copies_within(sites, period, margin);
    const Mesh whole = triangulate(copies.images, {period.x(), period.y()});
    const MarginVerdict found = judge(whole, copies, sites.cols(), period, margin);
    if (found == MarginVerdict::all)
      return folded(whole, copies, sites, box);
    if (found == MarginVerdict::too_few || margin == most)
      refuse_few(sites.cols());
  }
}

} // namespace calotte::delaunay_detail
