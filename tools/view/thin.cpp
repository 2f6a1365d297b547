// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/text.h"
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

/// The bits of a coordinate of 21 bits, two positions apart.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32U) & 0x1f00000000ffffU;
  x = (x | x << 16U) & 0x1f0000ff0000ffU;
  x = (x | x << 8U) & 0x100f00f00f00f00fU;
  x = (x | x << 4U) & 0x10c30c30c30c30c3U;
  return (x | x << 2U) & 0x1249249249249249U;
}

constexpr unsigned bits = 21; ///< of a coordinate

/// Sites along a Z-order curve.
class Curve {
public:
  Curve(const Points3& points, std::int64_t sites) : points_(points) {
    low_ = points.rowwise().minCoeff();
    const double side = (points.rowwise().maxCoeff() - low_).maxCoeff();
    unit_ = side > 0 ? ((1U << bits) - 1) / side : 0;
    for (std::int32_t i = 0; i < sites; ++i)
      keys_.emplace_back(key_of((unit_ * (points.col(i) - low_)).array()), i);
    std::sort(keys_.begin(), keys_.end());
  }

  std::int32_t operator[](std::int64_t k) const {
    return keys_[static_cast<std::size_t>(k)].second;
  }

  /// Whether there is a site within a distance of a point.
  bool reaches(const Eigen::Vector3d& point, double distance) const {
    // A cube of the curve at least as wide, so that two in each direction hold what is near.
    unsigned level = 0;
    while (level < bits && static_cast<double>(1U << level) < unit_ * 2 * distance)
      ++level;
    const double most = (1U << bits) - 1;
    const Eigen::Array3d middle = (unit_ * (point - low_)).array();
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3d way(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const Eigen::Array3d at = (middle + unit_ * distance * way).max(0).min(most);
      if (holds(key_of(at) >> 3 * level << 3 * level, level, point, distance))
        return true;
    }
    return false;
  }

private:
  static std::uint64_t key_of(const Eigen::Array3d& at) {
    return spread(static_cast<std::uint64_t>(at.x())) |
           spread(static_cast<std::uint64_t>(at.y())) << 1U |
           spread(static_cast<std::uint64_t>(at.z())) << 2U;
  }

  bool holds(std::uint64_t first, unsigned level, const Eigen::Vector3d& point,
             double distance) const {
    const std::uint64_t last = first + ((std::uint64_t{1} << 3 * level) - 1);
    for (auto next = std::lower_bound(keys_.begin(), keys_.end(), std::pair(first, INT32_MIN));
         next != keys_.end() && next->first <= last; ++next)
      if ((points_.col(next->second) - point).squaredNorm() <= distance * distance)
        return true;
    return false;
  }

  const Points3& points_;
  Eigen::Vector3d low_;
  double unit_ = 0; ///< steps of a coordinate in a unit
  std::vector<std::pair<std::uint64_t, std::int32_t>> keys_;
};

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
std::vector<std::int32_t> kept_cells(const ViewMesh& mesh, const Curve& order, std::int64_t most) {
  std::vector<std::int32_t> kept;
  for (const Quantity& quantity : mesh.quantities)
    add_worst(quantity, kept);
  const std::int64_t others = std::max<std::int64_t>(12, most - std::ssize(kept));
  for (std::int64_t k = 0; k < others; ++k)
    kept.push_back(order[k * mesh.cells / others]);
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

/// How far each cell of a mesh of the sphere may reach from its site; none for a mesh that covers
/// the sphere.
DoubleVector reaches_of(const ViewMesh& mesh) {
  DoubleVector reach = DoubleVector::Zero(mesh.cells);
  if (mesh.triangles.cols() == 2 * mesh.cells - 4)
    return {};
  if (mesh.shapes) {
    const Polygons& cells = *mesh.shapes;
    for (std::int64_t i = 0; i < mesh.cells; ++i)
      for (const std::int32_t corner : cells.ids[i])
        reach[i] = std::max(reach[i],
                            (cells.corners.col(corner).normalized() - mesh.points.col(i)).norm());
    return reach;
  }
  for (const auto& triangle : mesh.triangles.colwise())
    for (int v = 0; v < 3; ++v) {
      const std::int32_t a = triangle[v], b = triangle[(v + 1) % 3];
      const double side = (mesh.points.col(a) - mesh.points.col(b)).norm();
      reach[a] = std::max(reach[a], side);
      reach[b] = std::max(reach[b], side);
    }
  return reach;
}

/// Whether the cells of a mesh cover a triangle of some of its sites: its middle and those of its
/// sides are as near a site as the cells of the corners reach.
bool is_covered(const Eigen::Vector3i& sites, const ViewMesh& mesh, const Curve& curve,
                const DoubleVector& reach) {
  const Eigen::Vector3d a = mesh.points.col(sites[0]), b = mesh.points.col(sites[1]),
                        c = mesh.points.col(sites[2]);
  const double near = reach(sites).maxCoeff();
  const auto covered = [&](const Eigen::Vector3d& point) {
    return curve.reaches(point.normalized(), near);
  };
  return covered(a + b + c) && covered(a + b) && covered(b + c) && covered(c + a);
}

/// Leaves out the triangles that fill bays of the boundary that the others have: cells at them
/// would reach far beyond the sites.
void leave_out_bays(const Mesh& mesh, std::vector<bool>& left_out) {
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
}

/// The triangulation of kept sites, its corners by column, although equal columns are one site;
/// without triangles that the cells of the whole mesh do not cover.
Triangles triangles_of(const Points3& points, const ViewMesh& whole, const Curve& curve) {
  const Mesh mesh = delaunay(points);
  std::vector<std::int32_t> column(static_cast<std::size_t>(mesh.points.cols()));
  for (auto i = std::ssize(mesh.site_of_input); i-- > 0;)
    column[static_cast<std::size_t>(mesh.site_of_input[static_cast<std::size_t>(i)])] =
        static_cast<std::int32_t>(i);
  const Triangles corners = mesh.triangles.unaryExpr(
      [&](std::int32_t site) { return column[static_cast<std::size_t>(site)]; });
  std::vector<bool> left_out(static_cast<std::size_t>(corners.cols()));
  if (const DoubleVector reach = reaches_of(whole); reach.size() > 0)
    for (Eigen::Index t = 0; t < corners.cols(); ++t)
      left_out[static_cast<std::size_t>(t)] =
          !is_covered(corners.col(t).unaryExpr([&](std::int32_t i) {
            return whole.number[static_cast<std::size_t>(i)];
          }),
                      whole, curve, reach);
  leave_out_bays(mesh, left_out);
  Triangles kept(3, std::count(left_out.begin(), left_out.end(), false));
  for (Eigen::Index t = 0, next = 0; t < corners.cols(); ++t)
    if (!left_out[static_cast<std::size_t>(t)])
      kept.col(next++) = corners.col(t);
  return kept;
}

/// \throws Error invalid_argument where so few sites do not fill a periodic box.
Mesh planar_mesh(const Points3& points, const Surface& surface) {
  try {
    return delaunay(points, surface);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_few_sites || !surface.is_box())
      throw;
    refuse(message("{} cells are too few for the periodic box; give a greater number to "
                   "--most-cells",
                   points.cols()));
  }
}

} // namespace

void thin(ViewMesh& mesh, const Surface& surface, std::int64_t most) {
  const Curve curve(mesh.points, mesh.cells);
  mesh.number = kept_cells(mesh, curve, most);
  const auto n = std::ssize(mesh.number);
  Points3 points(3, n);
  for (std::int64_t i = 0; i < n; ++i)
    points.col(i) = mesh.points.col(mesh.number[static_cast<std::size_t>(i)]);
  std::erase_if(mesh.quantities, [](const Quantity& quantity) { return quantity.on_triangles; });
  for (Quantity& quantity : mesh.quantities) {
    DoubleVector values(n);
    for (std::int64_t i = 0; i < n; ++i)
      values[i] = quantity.values[mesh.number[static_cast<std::size_t>(i)]];
    quantity.values = std::move(values);
  }
  if (surface.is_sphere())
    mesh.triangles = triangles_of(points, mesh, curve);
  mesh.cells = n;
  mesh.shapes.reset();
  if (surface.is_sphere())
    mesh.points = std::move(points);
  else
    set_plane(mesh, planar_mesh(points, surface));
  mesh.notice +=
      message("The page shows {} of {} cells, evenly spread, and the worst ones; they are "
              "drawn larger. The table is of all cells. ",
              n, mesh.total);
}

} // namespace calotte::tools
