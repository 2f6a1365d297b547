// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/voronoi.h>

#include "base/matrix_memory.h"
#include "base/parallel.h"
#include "base/require.h"
#include "density/hexagons.h"
#include "voronoi/room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte {
namespace {

/// The density divided by its maximum; empty if it is uniform.
/// \throws Error bad_option.
Eigen::VectorXd relative_density(const Voronoi& voronoi, const Density& density) {
  base_detail::require(density.uniform() || voronoi.on_sphere,
                       "a plane supports uniform density only");
  if (density.uniform())
    return {};
  Eigen::VectorXd rho = evaluate(density, voronoi.cells);
  const double greatest = rho.maxCoeff();
  base_detail::require(greatest > 0,
                       "the density is zero at every cell: make it positive somewhere on the mesh");
  rho /= greatest;
  return rho;
}

} // namespace

CellFields cell_fields(const Voronoi& voronoi, const Density& density) {
  const std::int64_t n = voronoi.cells.cols();
  CellFields out;
  out.density = relative_density(voronoi, density);
  const bool uniform = out.density.size() == 0;
  if (uniform)
    base_detail::make_room(out.density, n, 1);
  base_detail::make_room(out.area, n, 1);
  base_detail::make_room(out.spacing, n, 1);
  base_detail::make_room(out.quality, n, 1);
  base_detail::make_room(out.degree, n, 1);
  base_detail::for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      double sum = 0, shortest = std::numeric_limits<double>::infinity(), longest = 0;
      std::int32_t degree = 0;
      for (std::int64_t place = voronoi.begin[i]; place != voronoi.begin[i + 1]; ++place) {
        const std::int32_t e = voronoi.edges_on_cell[place];
        sum += voronoi.dc[e];
        shortest = std::min(shortest, voronoi.dv[e]);
        longest = std::max(longest, voronoi.dv[e]);
        degree += voronoi.cells_on_cell[place] >= 0;
      }
      if (uniform)
        out.density[i] = 1;
      out.area[i] = voronoi.cell_area[i];
      out.degree[i] = degree;
      out.spacing[i] = sum / static_cast<double>(voronoi.begin[i + 1] - voronoi.begin[i]);
      out.quality[i] = longest > 0 ? shortest / longest : 0;
    }
  });
  return out;
}

double nominal_spacing(const CellFields& fields) {
  const double n = static_cast<double>(fields.area.size());
  double sum = 0; // in the order of the cells: the same bits for any number of threads
  for (Eigen::Index i = 0; i < fields.area.size(); ++i)
    sum += fields.area[i] * std::sqrt(fields.density[i]);
  return density_detail::hexagon_width(sum / n);
}

} // namespace calotte
