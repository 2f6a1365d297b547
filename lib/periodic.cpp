// SPDX-License-Identifier: GPL-3.0-or-later
#include "periodic.h"

#include "counts.h"

#include "io/assemble.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace calotte::detail {
namespace {

/// A box's sites, id by id, then copies of them.
struct Copies {
  std::vector<Image> images;
  std::vector<std::int32_t> site; ///< of each image
};

/// The copies up to `margin` around the box.
Copies copies_within(const Points2& sites, const Eigen::Vector2d& period, double margin) {
  Copies copies;
  for (std::int32_t s = 0; s < sites.cols(); ++s) {
    copies.images.push_back({{sites(0, s), sites(1, s)}, 0, 0});
    copies.site.push_back(s);
  }
  const auto near = [&](double x, double length, int i) {
    const double place = x + i * length;
    return place >= -margin && place <= length + margin;
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

enum class Found { all, need_more_margin, too_few };

/// Whether the circles of the triangles at the box's sites are narrower than half of the box, and
/// lie within the margin. In doubles, with room for their rounding: a circle that is wrongly said
/// to be too wide costs time, or a set that is sparse to the last digits.
Found judge(const PlanarMesh& mesh, std::int64_t sites, const Eigen::Vector2d& period,
            double margin) {
  constexpr double room = 1e-6;
  const double widest = period.minCoeff() / 4;
  Found found = Found::all;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    if (mesh.triangles.col(t).minCoeff() >= sites)
      continue;
    if (mesh.neighbours.col(t).minCoeff() < 0)
      return margin < period.maxCoeff() / 2 ? Found::need_more_margin : Found::too_few;
    const Eigen::Vector2d a = mesh.points.col(mesh.triangles(0, t)),
                          p = mesh.points.col(mesh.triangles(1, t)) - a,
                          q = mesh.points.col(mesh.triangles(2, t)) - a;
    const double twice_area = p.x() * q.y() - p.y() * q.x();
    const Eigen::Vector2d across = p.squaredNorm() * q - q.squaredNorm() * p;
    const Eigen::Vector2d offset = Eigen::Vector2d(across.y(), -across.x()) / (2 * twice_area);
    const Eigen::Vector2d centre = a + offset;
    const double radius = offset.norm() * (1 + room);
    const bool within = (centre.array() - radius >= -margin).all() &&
                        (centre.array() + radius <= period.array() + margin).all();
    if (!within)
      found = Found::need_more_margin;
    if (!(radius < widest) && within)
      return Found::too_few;
  }
  return found;
}

/// Of each triangle the copy whose lowest site stands in the box, in canonical order.
Triangles one_copy_each(const PlanarMesh& mesh, std::int64_t sites,
                        const std::vector<std::int32_t>& site) {
  using Triple = std::array<std::int32_t, 3>;
  std::vector<Triple> kept;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    Triple ids{};
    for (int v = 0; v < 3; ++v)
      ids[static_cast<std::size_t>(v)] = site[static_cast<std::size_t>(mesh.triangles(v, t))];
    const auto lowest = std::min_element(ids.begin(), ids.end());
    if (mesh.triangles(static_cast<int>(lowest - ids.begin()), t) >= sites)
      continue;
    std::rotate(ids.begin(), lowest, ids.end());
    kept.push_back(ids);
  }
  std::sort(kept.begin(), kept.end());
  Triangles triangles(3, std::ssize(kept));
  for (std::size_t t = 0; t < kept.size(); ++t)
    for (int v = 0; v < 3; ++v)
      triangles(v, static_cast<Eigen::Index>(t)) = kept[t][static_cast<std::size_t>(v)];
  return triangles;
}

[[noreturn]] void refuse_few(std::int64_t sites) {
  throw Error(ErrorCode::too_few_sites,
              "a circle wider than half of the periodic box holds none of the " +
                  std::to_string(sites) +
                  " sites: add sites, or put several copies of the box beside each other");
}

} // namespace

void require_in_box(const Points2& points, const Eigen::Vector2d& period) {
  require(period.allFinite() && (period.array() > 0).all(),
          "the periodic box is " + std::to_string(period.x()) + " x " + std::to_string(period.y()) +
              "; give two positive lengths");
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite() &&
        ((points.col(i).array() < 0).any() || (points.col(i).array() >= period.array()).any()))
      throw Error(ErrorCode::bad_option,
                  "point " + std::to_string(i) +
                      " is outside the periodic box, which starts at 0 0: add or subtract "
                      "periods",
                  i);
}

PlanarMesh triangulate_periodic(const Points2& sites, const Eigen::Vector2d& period,
                                const TriangulateImages& triangulate) {
  const double most = period.maxCoeff() / 2;
  double margin = std::min(most, 6 * std::sqrt(period.prod() / static_cast<double>(sites.cols())));
  for (;; margin = std::min(most, 2 * margin)) {
    Copies copies = copies_within(sites, period, margin);
    const PlanarMesh whole = triangulate(copies.images, {period.x(), period.y()});
    const Found found = judge(whole, sites.cols(), period, margin);
    if (found == Found::too_few || (found == Found::need_more_margin && margin == most))
      refuse_few(sites.cols());
    if (found == Found::need_more_margin)
      continue;
    PlanarMesh mesh;
    mesh.points = sites;
    mesh.triangles = one_copy_each(whole, sites.cols(), copies.site);
    mesh.neighbours = neighbours_of(mesh.triangles, sites.cols());
    mesh.period = period;
    if (mesh.triangles.cols() != 2 * sites.cols())
      throw Error(ErrorCode::internal, "a periodic box of " + std::to_string(sites.cols()) +
                                           " sites has " + std::to_string(mesh.triangles.cols()) +
                                           " triangles: please report this input as a bug");
    return mesh;
  }
}

} // namespace calotte::detail
