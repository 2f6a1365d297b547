// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/require.h"
#include "curve/curve_squares.h"
#include "curve/hilbert.h"
#include "density/room.h"
#include "exact/space.h"

#include <calotte/density.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace density_detail;

/// The triangles of a mesh, and where to start looking for the one that holds a place.
template <Space S> class Locator {
public:
  Locator(const Mesh& mesh, const S& space)
      : space_(space), vertices_(3, mesh.points.cols()), triangles_(mesh.triangles),
        neighbours_(mesh.neighbours), squares_(mesh.points) {
    for (Eigen::Index i = 0; i < vertices_.cols(); ++i)
      set_column(vertices_, i, space_.coordinates(space_.position(column(mesh.points, i))));
    if (!mesh.closed())
      fit_frames(mesh.points);
    const auto covered = std::ranges::count_if(frames_, &Frame::covered);
    while (4 * cells_a_side_ * cells_a_side_ <
           triangles_.cols() / std::max<std::int64_t>(covered, 1))
      cells_a_side_ *= 2;
    start_.assign(static_cast<std::size_t>(faces * cells_a_side_ * cells_a_side_), -1);
    for (std::int32_t t = 0; t < triangles_.cols(); ++t)
      start_[bucket_of(column(vertices_, triangles_(0, t)))] = t;
    fill_empty();
  }

  /// A triangle, and the weights of its vertices at a place: not negative, with the sum 1.
  struct Place {
    std::int32_t triangle;
    std::array<double, 3> weight;
  };

  /// The walk crosses edges towards x. Where rounding or a boundary stops it, the nearest weights
  /// of the last triangle are used.
  Place place_of(const Vec3& x) const { return place_from(start_[bucket_of(x)], x); }

  const Triangles& triangles() const { return triangles_; }

private:
  static constexpr int faces = CurveSquares<S>::count;

  /// The part of a face that the cells cover; a place beyond is in the nearest cell.
  struct Frame {
    double low_u = -1, low_v = -1, half_u = 1, half_v = 1;
    bool covered = true; ///< holds vertices
  };

  /// Around the vertices of a mesh that covers a part of the faces.
  void fit_frames(const Points3& points) {
    constexpr double least = 1e-12; // half the width
    std::array<CubePoint, faces> low, high;
    low.fill({0, 1, 1});
    high.fill({0, -1, -1});
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const CubePoint place = squares_(space_.wrapped(column(points, i)));
      const auto f = static_cast<std::size_t>(place.face);
      low[f] = {0, std::min(low[f].u, place.u), std::min(low[f].v, place.v)};
      high[f] = {0, std::max(high[f].u, place.u), std::max(high[f].v, place.v)};
    }
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      frames_[f].covered = low[f].u <= high[f].u;
      if (frames_[f].covered)
        frames_[f] = {low[f].u, low[f].v, std::max((high[f].u - low[f].u) / 2, least),
                      std::max((high[f].v - low[f].v) / 2, least)};
    }
  }

  Place place_from(std::int32_t t, const Vec3& x) const {
    for (std::int64_t step = 0; step < triangles_.cols(); ++step) {
      const std::array<double, 3> sides = sides_of(t, x);
      const auto least = std::min_element(sides.begin(), sides.end());
      const std::int32_t beyond =
          *least < 0 ? neighbours_(static_cast<Eigen::Index>(least - sides.begin()), t) : -1;
      if (beyond < 0)
        return {t, weights_of(sides)};
      t = beyond;
    }
    if constexpr (!S::on_sphere) // half a period away a walk may lead round
      t = holder_of(x, t);
    return {t, weights_of(sides_of(t, x))};
  }

  /// Of all triangles; `otherwise` if there is none.
  std::int32_t holder_of(const Vec3& x, std::int32_t otherwise) const {
    for (std::int32_t t = 0; t < triangles_.cols(); ++t) {
      const std::array<double, 3> sides = sides_of(t, x);
      if (*std::min_element(sides.begin(), sides.end()) >= 0)
        return t;
    }
    return otherwise;
  }

  /// Where triangles are larger than the cells, most of these hold no vertex: their walks start at
  /// the triangle of their middle, which a walk from the cell before finds.
  void fill_empty() {
    std::int32_t t = 0;
    for (int face = 0; face < faces; ++face)
      for (std::int64_t row = 0; row < cells_a_side_; ++row)
        for (std::int64_t k = 0; k < cells_a_side_; ++k) {
          const std::int64_t column = row % 2 == 0 ? k : cells_a_side_ - 1 - k; // to and fro
          std::int32_t& start = start_[bucket(face, row, column)];
          const Frame& frame = frames_[static_cast<std::size_t>(face)];
          if (start < 0)
            start =
                place_from(t, squares_.point({face, frame.low_u + (middle(row) + 1) * frame.half_u,
                                              frame.low_v + (middle(column) + 1) * frame.half_v}))
                    .triangle;
          t = start;
        }
  }

  /// Of a row or column of cells, -1 to 1.
  double middle(std::int64_t cell) const {
    return (2 * static_cast<double>(cell) + 1) / static_cast<double>(cells_a_side_) - 1;
  }

  std::size_t bucket(int face, std::int64_t row, std::int64_t column) const {
    return static_cast<std::size_t>((face * cells_a_side_ + row) * cells_a_side_ + column);
  }

  std::size_t bucket_of(const Vec3& x) const {
    const CubePoint place = squares_(space_.wrapped(x));
    const Frame& frame = frames_[static_cast<std::size_t>(place.face)];
    const auto cell = [&](double u) { // 0 to 1 within the frame
      const auto last = static_cast<double>(cells_a_side_ - 1);
      return static_cast<std::int64_t>(
          std::clamp(u * static_cast<double>(cells_a_side_), 0.0, last));
    };
    return bucket(place.face, cell((place.u - frame.low_u) / (2 * frame.half_u)),
                  cell((place.v - frame.low_v) / (2 * frame.half_v)));
  }

  /// For each corner of a triangle the area of x and the edge across from it, up to a factor:
  /// negative beyond that edge. In a periodic plane of the copies of the corners near x.
  std::array<double, 3> sides_of(std::int32_t t, const Vec3& x) const {
    const Vec3 &a = column(vertices_, triangles_(0, t)), &b = column(vertices_, triangles_(1, t)),
               &c = column(vertices_, triangles_(2, t));
    if constexpr (S::on_sphere) {
      return {S::area_term(x, b, c), S::area_term(x, c, a), S::area_term(x, a, b)};
    } else {
      const Vec3 to_a = space_.offset(x, a), to_b = to_a + space_.offset(a, b),
                 to_c = to_a + space_.offset(a, c);
      return {cross(to_b, to_c).z, cross(to_c, to_a).z, cross(to_a, to_b).z};
    }
  }

  static std::array<double, 3> weights_of(std::array<double, 3> sides) {
    double sum = 0;
    for (double& side : sides)
      sum += side = std::max(side, 0.0);
    for (double& side : sides)
      side = sum > 0 ? side / sum : 1.0 / 3;
    return sides;
  }

  S space_;
  Points3 vertices_;
  Triangles triangles_, neighbours_;
  CurveSquares<S> squares_; ///< around the sites
  std::array<Frame, faces> frames_{};
  std::int64_t cells_a_side_ = 1;   ///< of a frame
  std::vector<std::int32_t> start_; ///< a triangle near each cell
};

template <Space S>
Density::Callable interpolation(const Mesh& mesh, const S& space, const DoubleVector& density) {
  constexpr double least = 1e-150; // a density that is 0 has no cell width
  const auto locator = std::make_shared<const Locator<S>>(mesh, space);
  const auto widths = std::make_shared<const DoubleVector>(density.array().max(least).pow(-0.25));
  return [locator, widths](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index j = 0; j < x.cols(); ++j) {
      const auto place = locator->place_of({x(0, j), x(1, j), x(2, j)});
      double width = 0;
      for (std::size_t i = 0; i < 3; ++i)
        width += place.weight[i] *
                 (*widths)[locator->triangles()(static_cast<Eigen::Index>(i), place.triangle)];
      rho[j] = 1 / (width * width * width * width);
    }
  };
}

} // namespace

Density interpolated_density(const Mesh& mesh, const DoubleVector& density) {
  base_detail::require(density.size() == mesh.points.cols(),
                       "the density has " + std::to_string(density.size()) +
                           " values; give one for each of the mesh's " +
                           std::to_string(mesh.points.cols()) + " sites");
  base_detail::require(mesh.triangles.cols() > 0,
                       "the mesh has no triangle; triangulate its points");
  for (Eigen::Index i = 0; i < density.size(); ++i)
    base_detail::require(density[i] >= 0 && std::isfinite(density[i]),
                         "the density is " + std::to_string(density[i]) + " at site " +
                             std::to_string(i) + "; give finite numbers that are not negative");
  Density result;
  result.kind = Density::Kind::callable;
  result.callable = in_space_of(mesh.surface, [&](const Space auto& space) {
    require_positions(space, mesh.points, "site");
    return interpolation(mesh, space, density);
  });
  return result;
}

} // namespace calotte
