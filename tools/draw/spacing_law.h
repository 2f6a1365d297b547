// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/axes.h"

#include <calotte/density.h>
#include <calotte/mesh.h>

#include <string>
#include <vector>

namespace calotte::tools {

/// How the cells' spacings h follow a density rho: h_i / h_j = (rho_j / rho_i)^(1/4) in the limit
/// of many cells (Jacobsen et al., 2013, Eq. 3, for two dimensions). A cell's h is the mean
/// distance of its site to the neighbours; rho is taken at the site. Cells that an open boundary
/// leaves unbounded are left out.
struct SpacingLaw {
  std::vector<double> lawful; ///< (rho_max / rho_i)^(1/4), rho_max the largest of these cells
  /// h_i over the law's spacing at rho_max, the law being drawn through the median of h rho^(1/4):
  /// an odd cell does not shift it.
  std::vector<double> measured;
  /// The spacing at the minimum of rho over that at its maximum: medians over the hundredth of the
  /// cells at either end.
  double lawful_ratio = 1, measured_ratio = 1;
  double extreme_ratio = 1; ///< the largest spacing over the smallest
  double share = 0;         ///< of the cells, whose spacing is within law_band of the law
};

inline constexpr double law_band = 0.05;

/// \throws Error invalid_argument for a mesh without bounded cells, or a density that is 0 at a
///         site; as evaluate().
SpacingLaw spacing_law(const Mesh& mesh, const Density& density);

/// The layout of the picture of a law, in pixels. The frames share the axis of the spacings by the
/// law.
struct SpacingLawPage {
  int width = 0, height = 0;
  double text = 0; ///< size of the letters
  Frame spacing;   ///< up: measured
  Frame deviation; ///< up: measured / lawful - 1, percent
};

SpacingLawPage spacing_law_page(const SpacingLaw& law, int size);

inline constexpr std::size_t most_dots = 20000;

/// Draws the measured spacings against the lawful, a dot a cell (of at most most_dots, spread
/// evenly over the sites' order), with the law's line and a band of law_band about it; and beneath,
/// the deviations with their running median.
/// \param size width in pixels; in points for SVG and PDF. 64 to 16384
/// \throws Error as spacing_law; invalid_argument, file.
void draw_spacing_law(const std::string& path, const Mesh& mesh, const Density& density,
                      int size = 1200);

} // namespace calotte::tools
