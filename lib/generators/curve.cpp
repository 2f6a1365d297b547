// SPDX-License-Identifier: GPL-3.0-or-later
#include "generators/curve.h"

#include "base/circle.h"
#include "base/elementary.h"
#include "density/hexagons.h"
#include "domain/along_boundary.h"

#include <calotte/surface.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::generators_detail {

using domain_detail::left_of;

namespace {

/// The length of a segment; on the sphere an angle.
template <Space S> double length_of(const Segment& segment) {
  const double chord = norm(segment.to - segment.from);
  return S::on_sphere ? 2 * base_detail::arc_sine(std::min(1.0, chord / 2)) : chord;
}

template <Space S> Vec3 point_at(const Segment& segment, double along) {
  if (along == 0)
    return segment.from;
  const Vec3 chord = segment.to - segment.from;
  if constexpr (S::on_sphere) {
    const CosSin way = cos_sin_of_angle(along);
    return normalised(way.cos * segment.from +
                      way.sin * normalised(chord - dot(chord, segment.from) * segment.from));
  } else {
    return segment.from + (along / length_of<S>(segment)) * chord;
  }
}

} // namespace

template <Space S>
Curve<S>::Curve(const DemandedSpacing& spacing, double longest, std::vector<Segment> segments,
                bool closed)
    : spacing_(spacing), segments_(std::move(segments)), closed_(closed) {
  for (std::size_t k = 0; k < segments_.size(); ++k)
    measure(k, longest);
  marks_.push_back({corners_.back(), segments_.size() - 1, length_of<S>(segments_.back())});
}

/// The number of demanded edges per unit of length.
template <Space S> double Curve<S>::rate_at(std::size_t segment, double along) const {
  const double spacing = spacing_.at(point_at<S>(segments_[segment], along));
  return 1 / hexagon_width(spacing * spacing);
}

template <Space S> void Curve<S>::measure(std::size_t segment, double longest) {
  constexpr double step = 0.1;
  const double length = length_of<S>(segments_[segment]);
  double rate = rate_at(segment, 0), edges = corners_.back();
  for (double along = 0; along < length;) {
    marks_.push_back({edges, segment, along});
    const double next = std::min({length, along + step / rate, along + longest});
    const double there = rate_at(segment, next);
    edges += (next - along) * (rate + there) / 2;
    rate = there;
    along = next;
  }
  corners_.push_back(edges);
}

template <Space S> typename Curve<S>::Position Curve<S>::position(double edges) const {
  const auto after = std::upper_bound(marks_.begin(), marks_.end() - 1, edges,
                                      [](double e, const Mark& mark) { return e < mark.edges; });
  const Mark &mark = *(after - 1), &next = *after;
  const Segment& segment = segments_[mark.segment];
  const double end = next.segment == mark.segment ? next.along : length_of<S>(segment);
  const double share =
      next.edges > mark.edges ? (edges - mark.edges) / (next.edges - mark.edges) : 0;
  if (!closed_ && after == marks_.end() - 1 && share >= 1)
    return {segment.to, mark.segment};
  return {point_at<S>(segment, mark.along + std::clamp(share, 0.0, 1.0) * (end - mark.along)),
          mark.segment};
}

template <Space S> std::vector<double> Curve<S>::kept_corners() const {
  constexpr double straight = 0.94; // cosine of 20 degrees
  constexpr double apart = 2.0 / 3;
  struct Corner {
    double cosine, edges;
  };
  std::vector<Corner> corners;
  for (std::size_t k = closed_ ? 0 : 1; k < segments_.size(); ++k) {
    const double cosine =
        dot(left_of<S>(segments_[k == 0 ? segments_.size() - 1 : k - 1]), left_of<S>(segments_[k]));
    if (cosine < straight)
      corners.push_back({cosine, corners_[k]});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.cosine < b.cosine; });
  std::vector<double> kept;
  if (!closed_)
    kept = {0, edges()};
  for (const Corner& corner : corners) {
    const bool near = std::any_of(kept.begin(), kept.end(), [&](double other) {
      const double distance = std::abs(other - corner.edges);
      return std::min(distance, closed_ ? edges() - distance : distance) < apart;
    });
    if (!near)
      kept.push_back(corner.edges);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

template <Space S> std::vector<double> Curve<S>::stops(bool dense) const {
  constexpr double fewest = 3; // stops of a closed curve
  // Between the ends of longer edges, other generators could lie. On a boundary that must not
  // happen. Along a line it may: shapes beside fixed generators are better if these are not dense.
  const double wide = dense ? 1 : 1.1, slack = dense ? 0.25 : 0.5;
  const auto number = [&](double edges) { return std::max(1.0, std::ceil(edges / wide - slack)); };
  std::vector<double> corners = kept_corners();
  if (corners.empty())
    corners.push_back(0);
  const auto to_next = [&](std::size_t k) { // cyclic
    return k + 1 < corners.size() ? corners[k + 1] - corners[k] : edges() - corners[k] + corners[0];
  };
  if (closed_) {
    double sum = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)
      sum += number(to_next(k));
    if (sum < fewest)
      corners.resize(1);
  }
  std::vector<double> stops;
  for (std::size_t k = 0; k < corners.size() - (closed_ ? 0 : 1); ++k) {
    const double count = std::max(number(to_next(k)), closed_ && corners.size() == 1 ? fewest : 1);
    for (double j = 0; j < count; ++j)
      stops.push_back(corners[k] + j / count * to_next(k));
  }
  if (!closed_)
    stops.push_back(edges());
  for (double& stop : stops)
    stop = stop < edges() || !closed_ ? stop : stop - edges();
  std::sort(stops.begin(), stops.end());
  return stops;
}

template <Space S> double longest_step(const Surface& surface) {
  constexpr double share = 0.005; // of the extent; on the sphere of 2
  if constexpr (S::on_sphere)
    return 2 * share;
  else
    return share * std::sqrt(surface.area());
}

template class Curve<Sphere>;
template class Curve<Plane>;
template double longest_step<Sphere>(const Surface& surface);
template double longest_step<Plane>(const Surface& surface);

} // namespace calotte::generators_detail
