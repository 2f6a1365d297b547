// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/cell_fields.h"

#include "base/parallel.h"
#include "base/require.h"
#include "density/hexagons.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte {
namespace voronoi_detail {

DoubleVector relative_density(const Voronoi& voronoi, const Density& density) {
  require(density.uniform() || voronoi.surface.is_sphere(),
          "a plane supports uniform density only");
  if (density.uniform())
    return {};
  DoubleVector rho = evaluate(density, voronoi.cells);
  const double greatest = rho.maxCoeff();
  require(greatest > 0,
          "the density is zero at every cell: make it positive somewhere on the mesh");
  rho /= greatest;
  return rho;
}

double spacing_at(const Voronoi& voronoi, std::int64_t cell) {
  double sum = 0;
  for (const std::int32_t edge : voronoi.edges_on_cell[cell])
    sum += voronoi.dc[edge];
  return sum / static_cast<double>(voronoi.edges_on_cell.count(cell));
}

double quality_at(const Voronoi& voronoi, std::int64_t cell) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  for (const std::int32_t edge : voronoi.edges_on_cell[cell]) {
    const double length = voronoi.dv[edge];
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest > 0 ? shortest / longest : 0;
}

double nominal_spacing(const DoubleVector& area, const DoubleVector& density) {
  double sum = 0; // in the order of the cells: the same bits for any number of threads
  for (Eigen::Index i = 0; i < area.size(); ++i)
    sum += density.size() == 0 ? area[i] : area[i] * std::sqrt(density[i]);
  return density_detail::hexagon_width(sum / static_cast<double>(area.size()));
}

} // namespace voronoi_detail

CellFields cell_fields(const Voronoi& voronoi, const Density& density) {
  using namespace voronoi_detail;
  const std::int64_t n = voronoi.cells.cols();
  CellFields out;
  out.density = relative_density(voronoi, density);
  const bool uniform = out.density.size() == 0;
  if (uniform)
    out.density.resize(n);
  out.area.resize(n);
  out.spacing.resize(n);
  out.quality.resize(n);
  out.degree.resize(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      std::int32_t degree = 0;
      for (const std::int32_t other : voronoi.cells_on_cell[i])
        degree += other >= 0;
      if (uniform)
        out.density[i] = 1;
      out.area[i] = voronoi.cell_area[i];
      out.degree[i] = degree;
      out.spacing[i] = spacing_at(voronoi, i);
      out.quality[i] = quality_at(voronoi, i);
    }
  });
  return out;
}

double nominal_spacing(const CellFields& fields) {
  return voronoi_detail::nominal_spacing(fields.area, fields.density);
}

} // namespace calotte
