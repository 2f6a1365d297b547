// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/view_mesh.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

constexpr std::size_t worst_kept = 10;

/// The bits of a coordinate of 21 bits, two places apart.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32U) & 0x1f00000000ffffU;
  x = (x | x << 16U) & 0x1f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

/// The cells along a Z-order curve.
std::vector<std::int32_t> along_curve(const Points3& points, std::int64_t cells) {
  const Eigen::Vector3d low = points.rowwise().minCoeff();
  const double side = (points.rowwise().maxCoeff() - low).maxCoeff();
  const double unit = side > 0 ? ((1U << 21U) - 1) / side : 0;
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys;
  for (std::int32_t i = 0; i < cells; ++i) {
    const Eigen::Vector3d place = unit * (points.col(i) - low);
    keys.emplace_back(spread(static_cast<std::uint64_t>(place.x())) |
                          spread(static_cast<std::uint64_t>(place.y())) << 1U |
                          spread(static_cast<std::uint64_t>(place.z())) << 2U,
                      i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int32_t> order;
  for (const auto& [key, cell] : keys)
    order.push_back(cell);
  return order;
}

/// How bad a value is: the larger, the worse.
double badness(const Quantity& quantity, double value) {
  if (!std::isfinite(value))
    return -HUGE_VAL;
  switch (quantity.worst) {
  case Worst::low:
    return -value;
  case Worst::high:
    return value;
  case Worst::far_from_reference:
    return std::abs(value - quantity.reference);
  case Worst::none:
    break;
  }
  return -HUGE_VAL;
}

void add_worst(const Quantity& quantity, std::vector<std::int32_t>& cells) {
  if (quantity.on_triangles || quantity.worst == Worst::none)
    return;
  std::vector<std::int32_t> all(static_cast<std::size_t>(quantity.values.size()));
  std::iota(all.begin(), all.end(), 0);
  const std::size_t count = std::min(worst_kept, all.size());
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
                    [&](std::int32_t a, std::int32_t b) {
                      const double of_a = badness(quantity, quantity.values[a]),
                                   of_b = badness(quantity, quantity.values[b]);
                      return of_a > of_b || (of_a == of_b && a < b);
                    });
  cells.insert(cells.end(), all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
}

/// The cells to keep, in rising order.
std::vector<std::int32_t> kept_cells(const ViewMesh& mesh, std::int64_t most) {
  std::vector<std::int32_t> kept;
  for (const Quantity& quantity : mesh.quantities)
    add_worst(quantity, kept);
  const std::vector<std::int32_t> order = along_curve(mesh.points, mesh.cells);
  const std::int64_t others = std::max<std::int64_t>(12, most - std::ssize(kept));
  for (std::int64_t k = 0; k < others; ++k)
    kept.push_back(order[static_cast<std::size_t>(k * mesh.cells / others)]);
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

/// Whether the circumcentre of a triangle lies beyond a side without neighbour.
bool bulges_out(const Mesh& mesh, Eigen::Index t, const std::vector<bool>& left_out) {
  for (Eigen::Index v = 0; v < 3; ++v) {
    const std::int32_t across = mesh.neighbours(v, t);
    if (across >= 0 && !left_out[static_cast<std::size_t>(across)])
      continue;
    const Eigen::Vector3d apex = mesh.points.col(mesh.triangles(v, t)),
                          next = mesh.points.col(mesh.triangles((v + 1) % 3, t)),
                          last = mesh.points.col(mesh.triangles((v + 2) % 3, t));
    if ((next - apex).dot(last - apex) < 0) // opposite the side, an obtuse angle
      return true;
  }
  return false;
}

/// The triangles of an open mesh without those that fill bays of its boundary: cells at them would
/// reach far beyond the sites.
Triangles without_bays(const Mesh& mesh) {
  std::vector<bool> left_out(static_cast<std::size_t>(mesh.triangles.cols()));
  std::vector<std::int32_t> open(left_out.size());
  std::iota(open.begin(), open.end(), 0);
  while (!open.empty()) {
    const std::int32_t t = open.back();
    open.pop_back();
    if (t < 0 || left_out[static_cast<std::size_t>(t)] || !bulges_out(mesh, t, left_out))
      continue;
    left_out[static_cast<std::size_t>(t)] = true;
    for (const std::int32_t across : mesh.neighbours.col(t))
      open.push_back(across);
  }
  Triangles kept(3, std::count(left_out.begin(), left_out.end(), false));
  for (Eigen::Index t = 0, next = 0; t < mesh.triangles.cols(); ++t)
    if (!left_out[static_cast<std::size_t>(t)])
      kept.col(next++) = mesh.triangles.col(t);
  return kept;
}

/// The triangulation of the points, its corners by column, although equal columns are one site.
Triangles triangles_of(const Points3& points) {
  const Mesh mesh = spherical_delaunay(points);
  std::vector<std::int32_t> column(static_cast<std::size_t>(mesh.points.cols()));
  for (auto i = std::ssize(mesh.site_of_input); i-- > 0;)
    column[static_cast<std::size_t>(mesh.site_of_input[static_cast<std::size_t>(i)])] =
        static_cast<std::int32_t>(i);
  return without_bays(mesh).unaryExpr(
      [&](std::int32_t site) { return column[static_cast<std::size_t>(site)]; });
}

/// \throws Error bad_option where so few sites do not fill a periodic box.
PlanarMesh periodic_triangles(const Points2& places, const Eigen::Vector2d& period) {
  try {
    return periodic_delaunay(places, period);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_few_sites)
      throw;
    throw Error(ErrorCode::bad_option, std::to_string(places.cols()) +
                                           " cells are too few for the periodic box; give a "
                                           "greater number to --most-cells");
  }
}

} // namespace

void thin(ViewMesh& mesh, const PlanarDomain& domain, std::int64_t most) {
  mesh.number = kept_cells(mesh, most);
  const auto n = std::ssize(mesh.number);
  Points3 points(3, n);
  for (std::int64_t i = 0; i < n; ++i)
    points.col(i) = mesh.points.col(mesh.number[static_cast<std::size_t>(i)]);
  std::erase_if(mesh.quantities, [](const Quantity& quantity) { return quantity.on_triangles; });
  for (Quantity& quantity : mesh.quantities) {
    Eigen::VectorXd values(n);
    for (std::int64_t i = 0; i < n; ++i)
      values[i] = quantity.values[mesh.number[static_cast<std::size_t>(i)]];
    quantity.values = std::move(values);
  }
  mesh.cells = n;
  mesh.shapes.reset();
  if (mesh.on_sphere) {
    mesh.triangles = triangles_of(points);
    mesh.points = std::move(points);
  } else {
    const Points2 places = points.topRows<2>();
    set_plane(mesh,
              domain.periodic() ? periodic_triangles(places, domain.period)
                                : planar_delaunay(places),
              domain);
  }
  mesh.notice += "The page shows " + std::to_string(n) + " of " + std::to_string(mesh.total) +
                 " cells, evenly spread, and the worst ones; they are drawn larger. The table is "
                 "of all cells. ";
}

} // namespace calotte::tools
