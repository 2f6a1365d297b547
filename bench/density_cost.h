// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>

#include <cstddef>
#include <string>
#include <vector>

namespace calotte::bench {

/// Time of one evaluation of a density on the current thread, for rows of several lengths.
struct DensityCost {
  std::string density; ///< its name
  std::size_t row = 0;
  std::vector<double> nanoseconds; ///< an evaluation, by sample
};

/// The x8 bump, and the same density as a raster of cell widths of half a degree.
/// \param rows the lengths; they and the densities alternate in every sample, over the same points,
///        which fit in the first-level cache.
std::vector<DensityCost> density_costs(const std::vector<std::size_t>& rows, int samples);

} // namespace calotte::bench
