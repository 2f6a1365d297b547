// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>

#include <cstddef>
#include <vector>

namespace calotte::bench {

/// What one evaluation of a density costs on this thread, when points come in rows of some length.
struct DensityCost {
  std::size_t row = 0;
  std::vector<double> nanoseconds; ///< an evaluation, by sample
};

/// \param rows the lengths; they take turns in every sample, over the same points, which fit in the
/// first cache.
std::vector<DensityCost> density_costs(const Density& density, const std::vector<std::size_t>& rows,
                                       int samples);

} // namespace calotte::bench
