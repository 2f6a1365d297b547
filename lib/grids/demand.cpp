// SPDX-License-Identifier: GPL-3.0-or-later
#include "grids/demand.h"

#include "base/parallel.h"
#include "base/points.h"
#include "density/width_rules.h"
#include "exact/space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace calotte::grids_detail {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Sampled positions, and the site that each is for; -1 for none.
struct Samples {
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> sites;

  Points3 points() const {
    Points3 out(3, std::ssize(positions));
    for (std::size_t k = 0; k < positions.size(); ++k)
      set_column(out, static_cast<std::int64_t>(k), positions[k]);
    return out;
  }
};

/// Samples a lattice in each triangle with a site that may change. A position on an edge belongs to
/// the triangle with the lower number.
template <Space S>
Samples lattice(const Mesh& mesh, const S& space, const DoubleVector& own, const Marks& may_change,
                double least) {
  constexpr double densest = 16, most = 4e6;
  const double bound =
      std::min(densest, std::sqrt(2 * most / static_cast<double>(mesh.triangles.cols())));
  Samples samples;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const std::array<std::int32_t, 3> id{mesh.triangles(0, t), mesh.triangles(1, t),
                                         mesh.triangles(2, t)};
    if (std::none_of(id.begin(), id.end(),
                     [&](std::int32_t i) { return may_change[static_cast<std::size_t>(i)] != 0; }))
      continue;
    const double widest = std::max({own[id[0]], own[id[1]], own[id[2]]});
    const int parts =
        static_cast<int>(std::min(bound, std::ceil(widest / std::max(least, 1e-300))));
    const auto is_other = [&](int v) {
      const std::int32_t beyond = mesh.neighbours(v, t);
      return beyond >= 0 && beyond < t;
    };
    const std::array<bool, 3> elsewhere{is_other(0), is_other(1), is_other(2)};
    const Vec3 a = measured_point(space, column(mesh.points, id[0]));
    const Vec3 u = space.offset(a, measured_point(space, column(mesh.points, id[1]))),
               v = space.offset(a, measured_point(space, column(mesh.points, id[2])));
    for (int i = 0; parts > 1 && i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        const int k = parts - i - j; // of the first corner; 0 on the edge across from it
        const bool is_corner = i == parts || j == parts || k == parts;
        if (is_corner || (k == 0 && elsewhere[0]) || (i == 0 && elsewhere[1]) ||
            (j == 0 && elsewhere[2]))
          continue;
        samples.positions.push_back(space.wrapped(a + static_cast<double>(i) / parts * u +
                                                  static_cast<double>(j) / parts * v));
        samples.sites.push_back(id);
      }
  }
  return samples;
}

/// Samples the boundary of a region at steps of a quarter of the local cell width. Each position is
/// for the nearest site.
Samples along_boundary(const Mesh& mesh, const DoubleVector& own, const Surface& region) {
  constexpr std::int64_t most = 1 << 20;
  Samples samples;
  const Locator locator(mesh);
  for (const DoubleMatrix& ring : region.rings()) {
    Points3 corners = Points3::Zero(3, ring.cols());
    corners.topRows(ring.rows()) = ring;
    const Ids nearest = locator.nearest(corners);
    for (Eigen::Index k = 0; k < corners.cols(); ++k) {
      const Vec3 from = column(corners, k), way = column(corners, (k + 1) % corners.cols()) - from;
      const double step = std::max(0.25 * own[nearest[k]], 1e-12);
      const auto parts = std::clamp<std::int64_t>(std::llround(norm(way) / step), 1, most);
      for (std::int64_t p = 0; p < parts && std::ssize(samples.positions) < most; ++p)
        samples.positions.push_back(from +
                                    static_cast<double>(p) / static_cast<double>(parts) * way);
    }
  }
  for (const std::int32_t site : locator.nearest(samples.points()))
    samples.sites.push_back({site, -1, -1});
  return samples;
}

} // namespace

Demand::Demand(const WidthDemand& demand, Way way, const Mesh& mesh, const DoubleVector& own)
    : demand_(demand), own_(own), unit_(mesh.surface.is_sphere() ? 1 / demand.radius_km : 1),
      factor_(way == Way::finer ? 1 / demand.factor : demand.factor),
      nothing_(way == Way::finer ? infinite : 0) {
  if (demand.region)
    sites_.emplace(mesh);
  if (demand.widths)
    widths_ = demand.widths->on_sphere(demand.radius_km);
  if (widths_ && way == Way::finer)
    fine_.emplace(FineWidths{*widths_, unit_});
}

DoubleVector Demand::at(const Points3& points) const {
  if (demand_.region)
    return of_region(points);
  return evaluate(*widths_, points).unaryExpr([&](double width) {
    return Widths::is_demand(width) ? unit_ * width : nothing_;
  });
}

DoubleVector Demand::of_region(const Points3& points) const {
  DoubleVector widths = DoubleVector::Constant(points.cols(), nothing_);
  Marks marks(static_cast<std::size_t>(points.cols()));
  for_each_block(points.cols(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i)
      marks[static_cast<std::size_t>(i)] = demand_.region->contains(points.col(i)) ? 1 : 0;
  });
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (marks[static_cast<std::size_t>(i)] != 0)
      inside.push_back(i);
  widths(inside) = within_region(Points3(points(Eigen::all, inside)));
  return widths;
}

DoubleVector Demand::within_region(const Points3& points) const {
  return factor_ * own_(sites_->nearest(points));
}

DoubleVector Demand::on_cells(const Mesh& mesh, const DoubleVector& own, const Marks& may_change,
                              double gradient) const {
  DoubleVector widths = DoubleVector::Constant(mesh.points.cols(), infinite);
  std::vector<Eigen::Index> sites;
  for (Eigen::Index i = 0; i < widths.size(); ++i)
    if (may_change[static_cast<std::size_t>(i)] != 0)
      sites.push_back(i);
  widths(sites) = at(Points3(mesh.points(Eigen::all, sites)));
  in_space_of(mesh.surface, [&](const Space auto& space) {
    const Samples samples =
        demand_.region ? along_boundary(mesh, own, *demand_.region)
                       : lattice(mesh, space, own, may_change, unit_ * widths_->rule()->least());
    const DoubleVector there =
        demand_.region ? within_region(samples.points()) : at(samples.points());
    for (std::size_t k = 0; k < samples.positions.size(); ++k)
      for (const std::int32_t site : samples.sites[k]) {
        const double width = there[static_cast<Eigen::Index>(k)];
        if (site < 0 || may_change[static_cast<std::size_t>(site)] == 0 || !(width < widths[site]))
          continue;
        const Vec3 way = space.offset(measured_point(space, column(mesh.points, site)),
                                      measured_point(space, samples.positions[k]));
        if (norm(way) < own[site]) // false where the mesh ends far from the position
          widths[site] = std::min(widths[site], width + gradient * norm(way));
      }
  });
  return widths;
}

} // namespace calotte::grids_detail
