// SPDX-License-Identifier: GPL-3.0-or-later
#include "voronoi/spacing_fit.h"

#include "base/parallel.h"
#include "density/hexagons.h"
#include "voronoi/cell_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace calotte {
namespace voronoi_detail {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool has_all_neighbours(const Voronoi& voronoi, std::int64_t cell) {
  const auto neighbours = voronoi.cells_on_cell[cell];
  return std::none_of(neighbours.begin(), neighbours.end(), [](std::int32_t id) { return id < 0; });
}

/// Whether a cell is whole, so that its area gives its spacing.
bool is_whole(const Voronoi& voronoi, std::int64_t cell) {
  return voronoi.cell_area[cell] > 0 && has_all_neighbours(voronoi, cell);
}

/// The passes of smoothing whose weight extends over two cells.
constexpr int two_cells = 8;

/// Smooths the logarithms of cells: several times, each is replaced by the mean of itself and of
/// its neighbours' mean. The variance of the resulting weight grows by half a spacing squared in
/// each pass. Cells without a number keep none.
void smooth(const Voronoi& voronoi, int passes, DoubleVector& logarithms) {
  DoubleVector next(logarithms.size());
  for (int pass = 0; pass < passes; ++pass) {
    base_detail::for_each_block(
        logarithms.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          for (std::int64_t i = begin; i != end; ++i) {
            double sum = 0;
            int count = 0;
            for (const std::int32_t j : voronoi.cells_on_cell[i]) {
              if (j < 0 || std::isnan(logarithms[j]))
                continue;
              sum += logarithms[j];
              ++count;
            }
            next[i] = count == 0 ? logarithms[i] : (logarithms[i] + sum / count) / 2;
          }
        });
    logarithms.swap(next);
  }
}

/// The quantiles of some numbers at given shares. NaN does not count; 0 without numbers.
template <std::size_t n>
std::array<double, n> quantiles(const DoubleVector& of, const std::array<double, n>& shares) {
  std::vector<double> known;
  std::copy_if(of.begin(), of.end(), std::back_inserter(known),
               [](double value) { return !std::isnan(value); });
  std::array<double, n> values{};
  for (std::size_t k = 0; k < n && !known.empty(); ++k) {
    const auto at = known.begin() +
                    static_cast<std::ptrdiff_t>(shares[k] * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), at, known.end());
    values[k] = *at;
  }
  return values;
}

/// The logarithms of the cells' spacings; no number for cells that are not whole.
DoubleVector log_spacings(const Voronoi& voronoi) {
  DoubleVector logarithms(voronoi.cells.cols());
  for (Eigen::Index i = 0; i < logarithms.size(); ++i)
    logarithms[i] = is_whole(voronoi, i)
                        ? std::log(density_detail::hexagon_width(voronoi.cell_area[i]))
                        : unknown;
  return logarithms;
}

/// The standard deviation of the numbers.
double deviation(const DoubleVector& of) {
  double count = 0, sum = 0, squares = 0;
  for (const double value : of)
    if (!std::isnan(value))
      ++count, sum += value, squares += value * value;
  return count > 0 ? std::sqrt(std::max(squares / count - sum / count * (sum / count), 0.0)) : 0;
}

/// Gives cells along a boundary the mean of their neighbours, from the inside outwards.
void extend(const Voronoi& voronoi, DoubleVector& logarithms) {
  for (bool grew = true; grew;) {
    grew = false;
    const DoubleVector before = logarithms;
    for (Eigen::Index i = 0; i < logarithms.size(); ++i) {
      if (!std::isnan(before[i]))
        continue;
      double sum = 0;
      int count = 0;
      for (const std::int32_t j : voronoi.cells_on_cell[i])
        if (j >= 0 && !std::isnan(before[j]))
          sum += before[j], ++count;
      if (count > 0)
        logarithms[i] = sum / count, grew = true;
    }
  }
}

} // namespace

double nominal_spacing(const Voronoi& voronoi, const DoubleVector& density) {
  const auto mean_over = [&](const auto& counts) {
    double sum = 0, count = 0; // in the order of the cells: the same bits for any number of threads
    for (Eigen::Index i = 0; i < voronoi.cell_area.size(); ++i)
      if (counts(i)) {
        sum += density.size() == 0 ? voronoi.cell_area[i]
                                   : voronoi.cell_area[i] * std::sqrt(density[i]);
        ++count;
      }
    return sum / count;
  };
  const double inner = mean_over([&](Eigen::Index i) { return has_all_neighbours(voronoi, i); });
  return density_detail::hexagon_width(
      inner > 0 ? inner : mean_over([&](Eigen::Index i) { return voronoi.cell_area[i] > 0; }));
}

SpacingFit spacing_fit(const Voronoi& voronoi, const DoubleVector& density, double nominal) {
  constexpr std::array<double, 3> shares{0.5, 0.05, 0.95};
  DoubleVector logarithms = log_spacings(voronoi);
  SpacingFit fit;
  for (Eigen::Index i = 0; i < logarithms.size(); ++i) {
    const double rho = density.size() == 0 ? 1 : density[i];
    logarithms[i] = rho > 0 ? logarithms[i] - std::log(nominal) + std::log(rho) / 4 : unknown;
    fit.cells += std::isnan(logarithms[i]) ? 0 : 1;
  }
  smooth(voronoi, two_cells, logarithms);
  const auto [median, low, high] = quantiles(logarithms, shares);
  fit.median = std::exp(median), fit.low = std::exp(low), fit.high = std::exp(high);
  return fit;
}

DoubleVector smoothed_log_spacings(const Voronoi& voronoi, int passes) {
  DoubleVector logarithms = log_spacings(voronoi);
  smooth(voronoi, passes, logarithms);
  return logarithms;
}

} // namespace voronoi_detail

DoubleVector spacing_density(const Voronoi& voronoi) {
  using namespace voronoi_detail;
  constexpr double uniform = 1.1; // ratio of spacings
  constexpr std::array<double, 2> shares{0.05, 0.95};
  DoubleVector logarithms = log_spacings(voronoi);
  const double scatter = deviation(logarithms);
  smooth(voronoi, two_cells, logarithms);
  const auto [low, high] = quantiles(logarithms, shares);
  if (high - low <= std::log(uniform) || deviation(logarithms) < scatter / 2)
    return {};
  extend(voronoi, logarithms);
  double least = std::numeric_limits<double>::infinity();
  for (const double value : logarithms)
    least = std::isnan(value) ? least : std::min(least, value);
  for (double& value : logarithms)
    value = std::isnan(value) ? 1 : std::exp(4 * (least - value));
  return logarithms;
}

} // namespace calotte
