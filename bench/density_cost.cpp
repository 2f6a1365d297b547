// SPDX-License-Identifier: GPL-3.0-or-later
#include "density_cost.h"

#include "base/clock.h"
#include "base/lonlat.h"
#include "clouds.h"
#include "density/density_evaluator.h"

#include <calotte/cell_width.h>
#include <calotte/generators.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

namespace calotte::bench {

namespace {

constexpr std::size_t points = 512;

/// Uniform on the sphere, by coordinate, and the density there.
struct alignas(64) Sample {
  std::array<std::array<double, points>, 3> x;
  std::array<double, points> rho;
};

Sample make_sample() {
  Sample sample{};
  const Points3 columns = random_sphere(points, 8);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < points; ++j)
      sample.x[i][j] = columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return sample;
}

void evaluate_rows(const density_detail::DensityEvaluator& density, std::size_t row,
                   Sample& sample) {
  for (std::size_t first = 0; first < points; first += row) {
    const std::size_t count = std::min(row, points - first);
    const auto part = [&](const auto& values) { return std::span(values).subspan(first, count); };
    density(part(sample.x[0]), part(sample.x[1]), part(sample.x[2]),
            std::span(sample.rho).subspan(first, count));
  }
}

/// The widths of a density at the nodes of half a degree.
Density raster_of(const Density& density) {
  constexpr Eigen::Index columns = 720, rows = 361;
  CellWidth raster{Eigen::VectorXd::LinSpaced(columns, -180, 179.5),
                   Eigen::VectorXd::LinSpaced(rows, -90, 90), Eigen::MatrixXd(columns, rows)};
  for (Eigen::Index j = 0; j < rows; ++j) {
    Points3 nodes(3, columns);
    for (Eigen::Index i = 0; i < columns; ++i) {
      const base_detail::Vec3 node =
          base_detail::from_lonlat(raster.longitudes[i], raster.latitudes[j]);
      nodes.col(i) << node.x, node.y, node.z;
    }
    raster.widths.col(j) = evaluate(density, nodes).array().pow(-0.25);
  }
  return density_of(raster);
}

} // namespace

std::vector<DensityCost> density_costs(const std::vector<std::size_t>& rows, int samples) {
  constexpr int repeats = 200; // about half a millisecond, far above the resolution of the clock
  const std::array<std::pair<std::string, density_detail::DensityEvaluator>, 2> evaluators{
      {{"bump", density_detail::DensityEvaluator(x8_density())},
       {"raster", density_detail::DensityEvaluator(raster_of(x8_density()))}}};
  Sample sample = make_sample();
  std::vector<DensityCost> costs;
  for (const auto& [name, evaluator] : evaluators)
    for (const std::size_t row : rows)
      costs.push_back({name, row, {}});
  for (int s = 0; s < samples; ++s)
    for (std::size_t k = 0; k < costs.size(); ++k) {
      const auto& evaluator = evaluators[k / rows.size()].second;
      base_detail::Clock::time_point mark = base_detail::Clock::now();
      for (int r = 0; r < repeats; ++r) {
        evaluate_rows(evaluator, costs[k].row, sample);
        benchmark::DoNotOptimize(sample.rho.data());
        benchmark::ClobberMemory();
      }
      costs[k].nanoseconds.push_back(1e9 * base_detail::lap(mark) / (repeats * points));
    }
  return costs;
}

} // namespace calotte::bench
