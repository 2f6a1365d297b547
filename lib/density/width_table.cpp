// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_table.h"

#include "base/vector_loops.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace calotte::density_detail {
namespace {

/// atan(t) for 0 <= t <= 1 by interpolation of atan(t)/t in t^2 at Chebyshev's points, to 3e-14;
/// summed in pairs, whose chains of operations overlap.
CALOTTE_INLINE double short_arc_tangent(double t) {
  const double w = t * t, w2 = w * w, w4 = w2 * w2;
  const double a = (0.9999999999999338 + w * -0.33333333330339787) +
                   w2 * (0.1999999975982868 + w * -0.14285706427287104);
  const double b = (0.11110973176189942 + w * -0.09089418566830076) +
                   w2 * (0.07681546665977024 + w * -0.06611916904535065);
  const double c = (0.056786249501215025 + w * -0.046931670619414945) +
                   w2 * (0.03535112501867843 + w * -0.022701725480146706);
  const double d = (0.01153639898984693 + w * -0.004244862124323845) +
                   w2 * (0.0009900424629449844 + w * -0.00010883808135986328);
  return t * ((a + w4 * b) + w4 * w4 * (c + w4 * d));
}

/// atan2(opposite, adjacent) of two lengths >= 0, not both 0.
CALOTTE_INLINE double angle_of_legs(double opposite, double adjacent) {
  const bool steep = opposite > adjacent;
  const double low = steep ? adjacent : opposite, high = steep ? opposite : adjacent;
  const double angle = short_arc_tangent(low / (high + 1e-300));
  return steep ? std::numbers::pi / 2 - angle : angle;
}

} // namespace

CALOTTE_VECTOR_WIDTHS
void find_cells(const WidthTable::Grid& grid, const double* x, const double* y, const double* z,
                std::size_t count, GridCells& out) {
  constexpr double pi = std::numbers::pi;
  const WidthTable::Grid g = grid; // writing cannot change it
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < count; ++k) {
    const double east = angle_of_legs(std::abs(y[k]), std::abs(x[k]));
    const double half = x[k] < 0 ? pi - east : east;
    const double longitude = y[k] < 0 ? -half : half;
    const double turned = longitude < g.west ? longitude + 2 * pi : longitude;
    const double north = angle_of_legs(std::abs(z[k]), std::sqrt(x[k] * x[k] + y[k] * y[k]));
    const double latitude = z[k] < 0 ? -north : north;
    std::int32_t i = 0, j = 0;
    double u = 0, v = 0;
    split_position((turned - g.west) * g.inverse_dx, g.columns, i, u);
    split_position((latitude - g.south) * g.inverse_dy, g.rows, j, v);
    out.corner[k] = j * (g.columns + 1) + i;
    out.u[k] = u;
    out.v[k] = v;
  }
}

namespace {

CALOTTE_VECTOR_WIDTHS
void interpolate(const GridCells& cells, const double* low, const double* high, std::size_t count,
                 double* widths) {
  CALOTTE_VECTOR_LOOP
  for (std::size_t k = 0; k < count; ++k) {
    const std::int32_t at = cells.corner[k];
    const double u = cells.u[k];
    const double south = low[at] + u * (low[at + 1] - low[at]),
                 north = high[at] + u * (high[at + 1] - high[at]);
    widths[k] = south + cells.v[k] * (north - south);
  }
}

bool has_equal_steps(const std::vector<double>& values, std::size_t first, std::size_t last) {
  const double step = (values[last] - values[first]) / static_cast<double>(last - first);
  for (std::size_t k = first; k < last; ++k)
    if (std::abs(values[k + 1] - values[k] - step) > 1e-9 * step)
      return false;
  return true;
}

/// Rows at equal steps from row `from` to the pole `to` and beyond, the nearest to the row first.
/// Their values are linear between the row and the pole.
std::vector<std::vector<double>> rows_to_pole(const std::vector<double>& latitudes, double step,
                                              const std::vector<double>& from,
                                              const std::vector<double>& to, std::size_t row,
                                              std::size_t pole) {
  const double gap = std::abs(latitudes[pole] - latitudes[row]);
  std::vector<std::vector<double>> rows;
  for (int k = 1; (k - 1) * step < gap * (1 - 1e-9); ++k) {
    std::vector<double> values(from.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = from[i] + (to[i] - from[i]) * (k * step / gap);
    rows.push_back(std::move(values));
  }
  return rows;
}

} // namespace

std::optional<WidthTable> WidthTable::make(const std::vector<double>& longitudes,
                                           const std::vector<double>& latitudes,
                                           const std::vector<double>& widths) {
  constexpr std::size_t most = std::size_t{1} << 30; // indices are int32
  const std::size_t columns = longitudes.size(), last = latitudes.size() - 1;
  if (last < 3 || !has_equal_steps(longitudes, 0, columns - 1) ||
      !has_equal_steps(latitudes, 1, last - 1))
    return std::nullopt;
  const auto row = [&](std::size_t j) {
    const auto begin = widths.begin() + static_cast<std::ptrdiff_t>(j * columns);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(columns));
  };
  const double step = (latitudes[last - 1] - latitudes[1]) / static_cast<double>(last - 2);
  const auto south = rows_to_pole(latitudes, step, row(1), row(0), 1, 0),
             north = rows_to_pole(latitudes, step, row(last - 1), row(last), last - 1, last);
  WidthTable table;
  for (auto values = south.rbegin(); values != south.rend(); ++values)
    table.widths_.insert(table.widths_.end(), values->begin(), values->end());
  for (std::size_t j = 1; j < last; ++j) {
    const std::vector<double> values = row(j);
    table.widths_.insert(table.widths_.end(), values.begin(), values.end());
  }
  for (const std::vector<double>& values : north)
    table.widths_.insert(table.widths_.end(), values.begin(), values.end());
  if (table.widths_.size() > most)
    return std::nullopt;
  const auto rows = static_cast<std::int32_t>(table.widths_.size() / columns);
  const double turn = longitudes.back() - longitudes.front();
  table.grid_ = {longitudes.front(),
                 static_cast<double>(columns - 1) / turn,
                 latitudes[1] - static_cast<double>(south.size()) * step,
                 1 / step,
                 static_cast<std::int32_t>(columns) - 1,
                 rows - 1};
  return table;
}

void WidthTable::operator()(const double* x, const double* y, const double* z, std::size_t count,
                            double* widths) const {
  GridCells cells;
  for (std::size_t begin = 0; begin < count; begin += GridCells::size) {
    const std::size_t size = std::min(GridCells::size, count - begin);
    find_cells(grid_, x + begin, y + begin, z + begin, size, cells);
    interpolate(cells, widths_.data(), widths_.data() + grid_.columns + 1, size, widths + begin);
  }
}

} // namespace calotte::density_detail
