// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cvt.h>
#include <calotte/generators.h>

#include "base/require.h"
#include "cvt/room.h"

#include <optional>

namespace calotte {
namespace {

/// The level of the bisected icosahedron of n = 10 * 4^level + 2 points.
std::optional<int> icosahedral_level(std::int64_t n) {
  int level = 0;
  std::int64_t tens = n - 2;
  for (; tens % 4 == 0 && tens > 10; tens /= 4)
    ++level;
  return tens == 10 ? std::optional(level) : std::nullopt;
}

} // namespace

Continuation continuation(std::int64_t cells, const Density& density, std::uint64_t seed) {
  base_detail::require_count(cells, 12, "the number of cells");
  evaluate(density, bisected_icosahedron(
                        0)); // throws for an ill-formed density, even if the start does not use it
  const std::int64_t least = density.uniform() ? 12 : 642;
  Continuation result;
  std::int64_t n = cells;
  for (; (n - 2) % 4 == 0 && (n - 2) / 4 + 2 >= least; n = (n - 2) / 4 + 2)
    ++result.bisections;
  const std::optional<int> level = icosahedral_level(n);
  result.icosahedral = level.has_value();
  if (level)
    result.start = bisected_icosahedron(*level);
  else
    result.start =
        density.uniform() ? fibonacci_sphere(n) : random_sphere(n, site_density(density), seed);
  return result;
}

} // namespace calotte
