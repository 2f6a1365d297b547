// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/gradient_limit.h"

#include "base/elementary.h"
#include "base/lonlat.h"
#include "base/require.h"
#include "base/vec3.h"
#include "curve/box_tree.h"
#include "density/raster_field.h"
#include "domain/outline.h"
#include "domain/surface.h"
#include "exact/space.h"

#include <calotte/widths.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace density_detail;
using base_detail::Vec3;

/// The nodes of a raster of the sphere: the south pole, row by row, the north pole.
class SphereNodes {
public:
  SphereNodes(const RasterField& field, const Raster& widths, double radius)
      : columns_(static_cast<std::int32_t>(widths.x.size())),
        rows_(static_cast<std::int32_t>(field.y().intervals()) - 1), radius_(radius) {
    for (std::int32_t j = 1; j <= rows_; ++j)
      along_.push_back({field.cosine(j), field.sine(j)});
    for (const double longitude : widths.x) {
      const Vec3 at = base_detail::from_lonlat(longitude, 0);
      round_.push_back({at.x, at.y});
    }
    step_ = radius_ * std::numbers::pi / (rows_ + 1);
  }

  std::int32_t size() const { return rows_ * columns_ + 2; }
  std::int32_t north() const { return size() - 1; }
  std::int32_t node(std::int32_t i, std::int32_t j) const { return 1 + j * columns_ + i; }
  double step() const { return step_; }
  bool sees(std::int32_t, std::int32_t) const { return true; }

  double distance(std::int32_t a, std::int32_t b) const {
    const Vec3 apart = position(a) - position(b);
    return radius_ * 2 * base_detail::arc_sine(std::min(1.0, 0.5 * norm(apart)));
  }

  template <class Body> void for_each_neighbour(std::int32_t a, const Body& body) const {
    if (a == 0 || a == north()) {
      for (std::int32_t i = 0; i < columns_; ++i)
        body(node(i, a == 0 ? 0 : rows_ - 1));
      return;
    }
    const std::int32_t j = (a - 1) / columns_, i = (a - 1) % columns_;
    body(node(round(i - 1), j));
    body(node(round(i + 1), j));
    for (const std::int32_t row : {j - 1, j + 1}) {
      if (row < 0 || row == rows_) {
        body(row < 0 ? 0 : north());
        continue;
      }
      for (const std::int32_t column : {i - 1, i, i + 1})
        body(node(round(column), row));
    }
  }

private:
  std::int32_t round(std::int32_t column) const {
    return column < 0 ? column + columns_ : column < columns_ ? column : column - columns_;
  }

  struct Angle {
    double cosine, sine;
  };

  Vec3 position(std::int32_t a) const {
    if (a == 0 || a == north())
      return {0, 0, a == 0 ? -1.0 : 1.0};
    const Angle &latitude = along_[static_cast<std::size_t>((a - 1) / columns_)],
                &longitude = round_[static_cast<std::size_t>((a - 1) % columns_)];
    return {latitude.cosine * longitude.cosine, latitude.cosine * longitude.sine, latitude.sine};
  }

  std::int32_t columns_, rows_;
  double radius_, step_;
  std::vector<Angle> along_, round_; ///< of latitudes, of longitudes
};

/// A tree of an outline's edges, which finds those that cut a straight path.
class EdgeTree {
public:
  explicit EdgeTree(const Outline& outline) : edges_(outline.edges()), tree_(tree_of(edges_)) {}

  /// Whether a straight path passes from one side of an edge to the other. A path that ends on an
  /// edge, or runs along it, does not.
  bool cut(const Vec2& from, const Vec2& to) const {
    const double dx = to.x - from.x, dy = to.y - from.y;
    bool found = false;
    const auto may_meet = [&](const Box3& box) {
      if (found || std::max(from.x, to.x) < box.low.x || std::min(from.x, to.x) > box.high.x ||
          std::max(from.y, to.y) < box.low.y || std::min(from.y, to.y) > box.high.y)
        return false;
      const double x = 0.5 * (box.low.x + box.high.x), y = 0.5 * (box.low.y + box.high.y),
                   reach = std::abs(dx) * (box.high.y - y) + std::abs(dy) * (box.high.x - x);
      // The margin is twice the rounding error, and positive for a box without width.
      return std::abs(dx * (y - from.y) - dy * (x - from.x)) <=
             2 * reach + 1e-9 * (std::abs(dx) + std::abs(dy)) *
                             (std::abs(x - from.x) + std::abs(y - from.y));
    };
    tree_.visit(may_meet, [&](std::int32_t e) {
      const Outline::Edge& edge = edges_[static_cast<std::size_t>(e)];
      const bool from_left = orientation(from, to, edge.from) >= 0,
                 to_left = orientation(from, to, edge.to) >= 0;
      found = found ||
              (from_left != to_left &&
               orientation(edge.from, edge.to, from) * orientation(edge.from, edge.to, to) < 0);
    });
    return found;
  }

private:
  static BoxTree tree_of(const std::vector<Outline::Edge>& edges) {
    std::vector<Box3> boxes;
    std::vector<std::uint64_t> along; // the rings, which keep neighbours together
    for (const Outline::Edge& edge : edges) {
      boxes.push_back({{std::min(edge.from.x, edge.to.x), std::min(edge.from.y, edge.to.y), 0},
                       {std::max(edge.from.x, edge.to.x), std::max(edge.from.y, edge.to.y), 0}});
      along.push_back(along.size());
    }
    return {boxes, along};
  }

  const std::vector<Outline::Edge>& edges_;
  BoxTree tree_;
};

/// The nodes of a raster of the plane, row by row. The reflex corners of the boundary follow, at
/// which shortest paths bend; they have no values of their own.
class PlaneNodes {
public:
  PlaneNodes(const Raster& widths, const Surface& surface)
      : x_(axis_of(widths.x)), y_(axis_of(widths.y)),
        columns_(static_cast<std::int32_t>(x_.intervals()) + 1),
        rows_(static_cast<std::int32_t>(y_.intervals()) + 1), period_(surface.period()),
        outline_(outline_of<Plane>(surface)),
        sides_(static_cast<std::size_t>(raster_size()), Side::inside) {
    if (outline_ == nullptr)
      return;
    edge_tree_.emplace(*outline_);
    base_detail::for_each_block(raster_size(),
                                [&](std::int64_t, std::int64_t from, std::int64_t to) {
                                  for (std::int64_t a = from; a != to; ++a)
                                    sides_[static_cast<std::size_t>(a)] =
                                        outline_->side(position(static_cast<std::int32_t>(a)));
                                });
    add_corners();
  }

  std::int32_t raster_size() const { return rows_ * columns_; }
  std::int32_t size() const {
    return raster_size() + static_cast<std::int32_t>(outwards_ ? 0 : corners_.size());
  }
  bool inside(std::int32_t a) const { return side(a) != Side::outside; }
  bool all_inside() const { return outline_ == nullptr; }
  bool none_inside() const {
    return std::count(sides_.begin(), sides_.end(), Side::outside) == std::ssize(sides_);
  }
  double step() const {
    return std::min((x_[columns_ - 1] - x_[0]) / (columns_ - 1),
                    (y_[rows_ - 1] - y_[0]) / (rows_ - 1));
  }

  /// From now on only nodes outside the domain take values. They take them from any node, and the
  /// boundary blocks no path.
  void turn_outside() { outwards_ = true; }

  bool sees(std::int32_t a, std::int32_t b) const {
    if (outwards_ || !edge_tree_)
      return true;
    const Vec2 from = position(a), to = position(b);
    if (edge_tree_->cut(from, to))
      return false;
    // A path between two points of the boundary may pass through an island without crossing an
    // edge.
    return side(a) != Side::boundary || side(b) != Side::boundary ||
           outline_->side({0.5 * (from.x + to.x), 0.5 * (from.y + to.y)}) != Side::outside;
  }

  double distance(std::int32_t a, std::int32_t b) const {
    const Vec2 from = position(a), to = position(b);
    double dx = to.x - from.x, dy = to.y - from.y;
    if (period_.x() > 0)
      dx = std::remainder(dx, period_.x());
    if (period_.y() > 0)
      dy = std::remainder(dy, period_.y());
    return std::sqrt(dx * dx + dy * dy);
  }

  template <class Body> void for_each_neighbour(std::int32_t a, const Body& body) const {
    if (a >= raster_size())
      return for_each_beside_corner(a, body);
    const std::int32_t i = a % columns_, j = a / columns_;
    for (const std::int32_t down : {-1, 0, 1})
      for (const std::int32_t right : {-1, 0, 1}) {
        const std::int32_t column = wrapped(i + right, columns_, period_.x() > 0),
                           row = wrapped(j + down, rows_, period_.y() > 0);
        if ((down == 0 && right == 0) || column < 0 || row < 0)
          continue;
        const std::int32_t b = row * columns_ + column;
        if (outwards_ ? !inside(b) : inside(a) && inside(b) && sees(a, b))
          body(b);
      }
    if (corners_.empty() || outwards_ || !inside(a))
      return;
    for (const std::int32_t row : {j - 1, j})
      for (const std::int32_t column : {i - 1, i})
        if (row >= 0 && column >= 0 && row + 1 < rows_ && column + 1 < columns_)
          for (const std::int32_t corner : corners_in_[row * (columns_ - 1) + column])
            if (sees(a, corner))
              body(corner);
  }

private:
  struct Corner {
    Vec2 position;
    std::int32_t before, after; ///< along the ring, if paths bend there, too; else -1
  };

  static Axis axis_of(const DoubleVector& values) {
    return Axis(std::vector<double>(values.begin(), values.end()));
  }

  void add_corners() {
    for (const std::vector<Vec3>& ring : outline_->rings()) {
      const std::size_t n = ring.size();
      const auto at = [&](std::size_t k) { return Vec2{ring[k % n].x, ring[k % n].y}; };
      std::vector<std::int32_t> of_ring(n, -1);
      for (std::size_t k = 0; k < n; ++k)
        if (orientation(at(k + n - 1), at(k), at(k + 1)) < 0) {
          of_ring[k] = raster_size() + static_cast<std::int32_t>(corners_.size());
          corners_.push_back({at(k), -1, -1});
        }
      for (std::size_t k = 0; k < n; ++k)
        if (of_ring[k] >= 0) {
          Corner& corner = corners_[static_cast<std::size_t>(of_ring[k] - raster_size())];
          corner.before = of_ring[(k + n - 1) % n], corner.after = of_ring[(k + 1) % n];
        }
    }
    std::vector<std::pair<std::int32_t, std::int32_t>> of_box;
    for (std::size_t k = 0; k < corners_.size(); ++k)
      of_box.emplace_back(box_of(corners_[k].position),
                          raster_size() + static_cast<std::int32_t>(k));
    std::sort(of_box.begin(), of_box.end());
    corners_in_.begin.assign(static_cast<std::size_t>((rows_ - 1) * (columns_ - 1)) + 1, 0);
    for (const auto& [box, corner] : of_box) {
      ++corners_in_.begin[static_cast<std::size_t>(box) + 1];
      corners_in_.items.push_back(corner);
    }
    std::partial_sum(corners_in_.begin.begin(), corners_in_.begin.end(), corners_in_.begin.begin());
  }

  std::int32_t box_of(const Vec2& position) const {
    return static_cast<std::int32_t>(y_.interval(position.y) * (columns_ - 1) +
                                     x_.interval(position.x));
  }

  template <class Body> void for_each_beside_corner(std::int32_t a, const Body& body) const {
    const Corner& corner = corners_[static_cast<std::size_t>(a - raster_size())];
    const std::int32_t box = box_of(corner.position), j = box / (columns_ - 1),
                       i = box % (columns_ - 1);
    for (const std::int32_t row : {j, j + 1})
      for (const std::int32_t column : {i, i + 1})
        if (const std::int32_t b = row * columns_ + column; inside(b) && sees(a, b))
          body(b);
    for (const std::int32_t b : {corner.before, corner.after})
      if (b >= 0)
        body(b);
  }

  Side side(std::int32_t a) const {
    return a < raster_size() ? sides_[static_cast<std::size_t>(a)] : Side::boundary;
  }

  /// The index within the raster; -1 beyond it.
  static std::int32_t wrapped(std::int32_t i, std::int32_t count, bool periodic) {
    if (i >= 0 && i < count)
      return i;
    return periodic ? (i + count) % count : -1;
  }

  Vec2 position(std::int32_t a) const {
    return a < raster_size() ? Vec2{x_[a % columns_], y_[a / columns_]}
                             : corners_[static_cast<std::size_t>(a - raster_size())].position;
  }

  Axis x_, y_;
  std::int32_t columns_, rows_;
  Eigen::Vector2d period_;
  const Outline* outline_; ///< null without one
  std::optional<EdgeTree> edge_tree_;
  std::vector<Side> sides_;
  std::vector<Corner> corners_;
  Lists<std::vector<std::int32_t>, std::vector<std::int64_t>> corners_in_; ///< by box of the raster
  bool outwards_ = false;
};

} // namespace

void density_detail::require_gradient(double gradient) {
  base_detail::require(gradient > 0 && std::isfinite(gradient),
                       "the limit of the gradient must be positive; give it in km per km");
}

namespace {

bool has_demand(const std::vector<double>& widths) {
  return std::ranges::any_of(widths, [](double width) { return Widths::is_demand(width); });
}

Raster limited_in_plane(const Raster& widths, double gradient, const Surface& surface) {
  PlaneNodes nodes(widths, surface);
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto given = widths.values.reshaped();
  std::vector<double> values(given.begin(), given.end());
  if (nodes.none_inside()) {
    nodes.turn_outside();
  } else if (!nodes.all_inside()) {
    for (std::int32_t a = 0; a < nodes.raster_size(); ++a)
      if (!nodes.inside(a))
        values[static_cast<std::size_t>(a)] = none;
    values.resize(static_cast<std::size_t>(nodes.size()), none);
    if (has_demand(values))
      values = GradientLimit<PlaneNodes>(nodes, std::move(values), gradient).result();
    nodes.turn_outside();
    values.resize(static_cast<std::size_t>(nodes.size()));
    for (std::int32_t a = 0; a < nodes.size(); ++a)
      if (!nodes.inside(a))
        values[static_cast<std::size_t>(a)] = given[a];
  }
  if (has_demand(values))
    values = GradientLimit<PlaneNodes>(nodes, std::move(values), gradient).result();
  Raster result = widths;
  result.values =
      Eigen::Map<const DoubleMatrix>(values.data(), widths.values.rows(), widths.values.cols());
  return result;
}

Raster limited_on_sphere(const Raster& widths, double gradient, double radius_km) {
  const RasterField field(widths);
  const SphereNodes nodes(field, widths, radius_km);
  const std::int64_t columns = widths.x.size(), rows = field.y().intervals() - 1;
  std::vector<double> values(static_cast<std::size_t>(nodes.size()));
  // A row at a pole is one node. A pole without a row is a node without a value, through which
  // paths pass.
  const bool south = widths.y[0] == -90, north = widths.y[widths.y.size() - 1] == 90;
  constexpr double none = std::numeric_limits<double>::infinity();
  values.front() = south ? widths.values.col(0).minCoeff() : none;
  values.back() = north ? widths.values.rightCols<1>().minCoeff() : none;
  for (std::int64_t j = 0; j < rows; ++j)
    for (std::int64_t i = 0; i < columns; ++i)
      values[static_cast<std::size_t>(1 + j * columns + i)] = field.value(i, j + 1);
  if (!has_demand(values))
    return widths;
  const std::vector<double> limited =
      GradientLimit<SphereNodes>(nodes, std::move(values), gradient).result();
  Raster result = widths;
  for (Eigen::Index j = 0; j < widths.y.size(); ++j)
    for (Eigen::Index i = 0; i < columns; ++i) {
      const std::int64_t row = j - (south ? 1 : 0);
      const std::size_t node = row < 0      ? 0
                               : row < rows ? static_cast<std::size_t>(1 + row * columns + i)
                                            : limited.size() - 1;
      result.values(i, j) = std::min(widths.values(i, j), limited[node]);
    }
  return result;
}

} // namespace

Raster limit_gradient(const Raster& widths, double gradient, const Surface& surface,
                      double radius_km) {
  require_gradient(gradient);
  require_kind(widths.of_plane, surface);
  require_radius(radius_km);
  require_values(widths, "cell width", positive);
  double most = 0;
  for (const double width : widths.values.reshaped())
    most = Widths::is_demand(width) ? std::max(most, width) : most;
  require_ratio(most, widths.values.minCoeff());
  return widths.of_plane ? limited_in_plane(widths, gradient, surface)
                         : limited_on_sphere(widths, gradient, radius_km);
}

} // namespace calotte
