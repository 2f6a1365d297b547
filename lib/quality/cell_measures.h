// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "quality/parts.h"
#include "quality/room.h"

#include <calotte/quality.h>

#include <cmath>
#include <limits>
#include <numbers>

/// The parts of cell_measures() that the sphere and the plane share.
namespace calotte::quality_detail {

inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// Measures of n cells and m triangles, none of them set but the degrees, which are 0.
inline CellMeasures unset_measures(Eigen::Index n, Eigen::Index m) {
  CellMeasures out;
  out.spacing = DoubleVector::Constant(n, no_value);
  out.area = out.sigma = out.quality = out.largest_angle = out.off_centroid = out.spacing;
  out.degree = DoubleVector::Zero(n);
  out.triangle_angle = out.triangle_quality = DoubleVector::Constant(m, no_value);
  return out;
}

/// Sets what follows from the triangles: their angles and quality, and by site the number of
/// triangles and their largest angle.
inline void set_angles(const Subject& subject, CellMeasures& out) {
  constexpr double degrees = 180 / std::numbers::pi;
  for (std::int64_t t = 0; t < subject.shapes.size(); ++t) {
    if (!subject.has(t))
      continue;
    TrianglePart part;
    add_triangle(part, subject.shapes[t]);
    out.triangle_angle[t] = degrees * part.angles.max;
    out.triangle_quality[t] = part.quality.max;
    for (const std::int32_t site : subject.triangles.col(t)) {
      ++out.degree[site];
      out.largest_angle[site] = std::fmax(out.largest_angle[site], out.triangle_angle[t]);
    }
  }
}

/// Sets the spacings that the density prescribes, and the least and the greatest dc/h at each site.
inline void set_fits(const Subject& subject, CellMeasures& out) {
  out.prescribed = subject.inverse_spacing.cwiseInverse();
  out.min_dc_over_h = DoubleVector::Constant(out.prescribed.size(), no_value);
  out.max_dc_over_h = out.min_dc_over_h;
  for (std::int64_t t = 0; t < subject.shapes.size(); ++t)
    for (int v = 0; v < 3 && subject.has(t); ++v) {
      const double fit = subject.fit(t, v);
      for (const int end : {next_vertex(v), previous_vertex(v)}) {
        const std::int32_t site = subject.triangles(end, t);
        out.min_dc_over_h[site] = std::fmin(out.min_dc_over_h[site], fit);
        out.max_dc_over_h[site] = std::fmax(out.max_dc_over_h[site], fit);
      }
    }
}

} // namespace calotte::quality_detail
