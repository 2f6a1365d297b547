// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/points.h"
#include "curve/curve_squares.h"
#include "curve/hilbert.h"
#include "exact/space.h"
#include "mesh/room.h"

#include <calotte/mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace calotte::mesh_detail {

/// The triangles in which to start a search: squares over a mesh, and a triangle near the middle of
/// each. From there a walk in rounded arithmetic leads to the triangle at a point, for loops over
/// many points of a density. LocatorIn, which is exact, starts there, too.
///
/// It refers to the mesh, which must outlive it.
template <Space S> class TriangleGrid {
public:
  /// \param known number of triangles, evenly spaced in their order, that the squares are made
  ///        from: all, or a few where the grid serves a single search.
  /// \pre 0 < known <= triangles of the mesh; its points have positions.
  TriangleGrid(const Mesh& mesh, const S& space, std::int64_t known)
      : mesh_(mesh), space_(space), squares_(mesh.points) {
    const std::int64_t count = mesh.triangles.cols();
    if (!mesh.closed())
      fit_frames(count / known);
    const auto covered = std::ranges::count_if(frames_, &Frame::covered);
    while (4 * cells_a_side_ * cells_a_side_ < known / std::max<std::int64_t>(covered, 1))
      cells_a_side_ *= 2;
    start_.assign(static_cast<std::size_t>(faces * cells_a_side_ * cells_a_side_), -1);
    for (std::int64_t k = 0; k < known; ++k) {
      const auto t = static_cast<std::int32_t>(k * count / known);
      start_[bucket_of(vertex(t, 0))] = t;
    }
    fill_empty();
  }

  /// A triangle, and the weights of its vertices at a point: >= 0, with the sum 1.
  struct Location {
    std::int32_t triangle;
    std::array<double, 3> weight;
  };

  /// The walk crosses edges towards x. Where rounding or a boundary stops it, the nearest weights
  /// of the last triangle are used.
  /// \pre on the sphere x and the points of the mesh are unit vectors.
  Location locate(const Vec3& x) const { return locate_from(start(x), x); }

  /// A triangle near a point; on the sphere, near a direction of any norm.
  std::int32_t start(const Vec3& x) const { return start_[bucket_of(x)]; }

  /// The key of a point along the curve through the squares.
  std::uint64_t key_of(const Vec3& x) const { return curve_key(squares_(x)); }

  std::int64_t cells() const { return std::ssize(start_); }

private:
  static constexpr int faces = CurveSquares<S>::count;

  /// The part of a face that the cells cover. A point beyond it is in the nearest cell.
  struct Frame {
    double low_u = -1, low_v = -1, half_u = 1, half_v = 1;
    bool covered = true; ///< contains vertices
  };

  /// Fits the frames to every `step`-th vertex, for a mesh that covers a part of the faces.
  void fit_frames(std::int64_t step) {
    constexpr double least = 1e-12; // half the width
    std::array<CubePoint, faces> low, high;
    low.fill({0, 1, 1});
    high.fill({0, -1, -1});
    for (Eigen::Index i = 0; i < mesh_.points.cols(); i += step) {
      const CubePoint at = squares_(space_.wrapped(column(mesh_.points, i)));
      const auto f = static_cast<std::size_t>(at.face);
      low[f] = {0, std::min(low[f].u, at.u), std::min(low[f].v, at.v)};
      high[f] = {0, std::max(high[f].u, at.u), std::max(high[f].v, at.v)};
    }
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      frames_[f].covered = low[f].u <= high[f].u;
      if (frames_[f].covered)
        frames_[f] = {low[f].u, low[f].v, std::max((high[f].u - low[f].u) / 2, least),
                      std::max((high[f].v - low[f].v) / 2, least)};
    }
  }

  Location locate_from(std::int32_t t, const Vec3& x) const {
    const std::int64_t count = mesh_.triangles.cols();
    for (std::int64_t step = 0; step < count; ++step) {
      const std::array<double, 3> sides = sides_of(t, x);
      const auto least = std::min_element(sides.begin(), sides.end());
      const std::int32_t beyond =
          *least < 0 ? mesh_.neighbours(static_cast<Eigen::Index>(least - sides.begin()), t) : -1;
      if (beyond < 0)
        return {t, weights_of(sides)};
      t = beyond;
    }
    if constexpr (!S::on_sphere) // half a period away a walk may run in a circle
      t = find_containing(x, t);
    return {t, weights_of(sides_of(t, x))};
  }

  /// Searches all triangles for one that contains x; `otherwise` if there is none.
  std::int32_t find_containing(const Vec3& x, std::int32_t otherwise) const {
    for (std::int32_t t = 0; t < mesh_.triangles.cols(); ++t) {
      const std::array<double, 3> sides = sides_of(t, x);
      if (*std::min_element(sides.begin(), sides.end()) >= 0)
        return t;
    }
    return otherwise;
  }

  /// Where triangles are larger than the cells, most cells contain no vertex. Their walks start at
  /// the triangle of their middle, which a walk from the previous cell finds.
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
                locate_from(t, squares_.point({face, frame.low_u + (middle(row) + 1) * frame.half_u,
                                               frame.low_v + (middle(column) + 1) * frame.half_v}))
                    .triangle;
          t = start;
        }
  }

  /// The middle of a row or column of cells, from -1 to 1.
  double middle(std::int64_t cell) const {
    return (2 * static_cast<double>(cell) + 1) / static_cast<double>(cells_a_side_) - 1;
  }

  std::size_t bucket(int face, std::int64_t row, std::int64_t column) const {
    return static_cast<std::size_t>((face * cells_a_side_ + row) * cells_a_side_ + column);
  }

  std::size_t bucket_of(const Vec3& x) const {
    const CubePoint at = squares_(space_.wrapped(x));
    const Frame& frame = frames_[static_cast<std::size_t>(at.face)];
    const auto cell = [&](double u) { // 0 to 1 within the frame; 0 for NaN
      const auto last = static_cast<double>(cells_a_side_ - 1);
      return static_cast<std::int64_t>(
          std::min(std::max(0.0, u * static_cast<double>(cells_a_side_)), last));
    };
    return bucket(at.face, cell((at.u - frame.low_u) / (2 * frame.half_u)),
                  cell((at.v - frame.low_v) / (2 * frame.half_v)));
  }

  const Vec3& vertex(std::int64_t t, int v) const {
    return column(mesh_.points, mesh_.triangles(v, t));
  }

  /// For each corner of a triangle, the signed area of x and the edge across from the corner, up to
  /// a factor: negative if x is beyond that edge. In a periodic plane the corners are the copies
  /// near x.
  std::array<double, 3> sides_of(std::int32_t t, const Vec3& x) const {
    const Vec3 &a = vertex(t, 0), &b = vertex(t, 1), &c = vertex(t, 2);
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

  const Mesh& mesh_;
  S space_;
  CurveSquares<S> squares_; ///< around the sites
  std::array<Frame, faces> frames_{};
  std::int64_t cells_a_side_ = 1;   ///< of a frame
  std::vector<std::int32_t> start_; ///< a triangle near each cell
};

} // namespace calotte::mesh_detail
