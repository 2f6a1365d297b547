// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/run_region.h"

#include "options/numbers.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/limited_area.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace calotte::tools {
namespace {

[[noreturn]] void refuse(const std::string& problem) {
  throw Error(ErrorCode::bad_option, problem);
}

/// \throws Error bad_option for a region that is smaller than a cell.
void require_cell_inside(const RegionWords& words, const WidthWords& width_words,
                         const CellWidth& widths, const RunRegion& region) {
  const double inside = implied_cells(widths, region.region, width_words.radius);
  if (!(inside >= 1))
    refuse("--region " + words.region + ": the region has room for " + formatted("%.2g", inside) +
           " cells only, without those of the rings; give smaller widths or a larger region");
}

} // namespace

Region asked_region(const RegionWords& words, const WidthWords& width_words) {
  return words.region.empty() ? Region{}
                              : region_of(words.region, words.inside, width_words.radius);
}

std::optional<RunRegion> region_of_run(const RegionWords& words, Region asked,
                                       const WidthWords& width_words,
                                       const std::optional<CellWidth>& widths) {
  if (words.region.empty())
    return std::nullopt;
  if (!words.limited_area)
    return RunRegion{asked, asked};
  if (!widths)
    refuse("--limited-area requires cell widths, from which the rings around the region follow; "
           "give --cell-width");
  Region meshed = with_rings(asked, *widths, width_words.radius);
  require_covering(*widths, meshed);
  return RunRegion{std::move(asked), std::move(meshed)};
}

int cells_of_region(const RegionWords& words, const WidthWords& width_words,
                    const Resolution& resolution, const RunRegion& region) {
  constexpr double least = 40, most = 1 << 30;
  const double implied =
      std::round(implied_cells(*resolution.widths, region.meshed, width_words.radius));
  if (!(implied >= least && implied <= most))
    refuse("--region " + words.region + ": the widths require " + formatted("%.4g", implied) +
           " cells, but a grid has 40 to 1073741824; give other widths or a larger region");
  if (words.limited_area) // whose rings lie around the cells inside
    require_cell_inside(words, width_words, *resolution.widths, region);
  double cells = implied;
  for (int k = 0; k < 3 && ends_at_boundary(words); ++k) // whose generators have half a cell
    cells = implied +
            static_cast<double>(
                boundary_points(region.meshed, static_cast<std::int64_t>(cells), resolution.density)
                    .cols() /
                2);
  return static_cast<int>(std::min(cells, most));
}

std::string doubt_of_boundary(const Mesh& mesh, std::int64_t first, std::int64_t count) {
  std::int64_t outer = 0, away = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v) {
      if (mesh.neighbours(v, t) >= 0)
        continue;
      const std::int32_t a = mesh.triangles((v + 1) % 3, t), b = mesh.triangles((v + 2) % 3, t);
      ++outer;
      away += std::min(a, b) < first || std::max(a, b) >= first + count;
    }
  if (away == 0 && outer == count)
    return "";
  return "the mesh leaves the boundary of the region in places: its " + std::to_string(outer) +
         " outer edges do not join the " + std::to_string(count) +
         " generators on the boundary; where the region or what it leaves out is narrower than "
         "its cells, give more cells";
}

} // namespace calotte::tools
