// SPDX-License-Identifier: GPL-3.0-or-later
#include "laplacian.h"

#include "elementary.h"
#include "parallel.h"
#include "points.h"
#include "stars.h"

#include <calotte/delaunay.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace calotte::detail {
namespace {

/// Of an edge of a triangle, that triangle's share.
struct EdgeShare {
  double weight; ///< (l^2 delta/4 - delta^3/3)/l
  double least;  ///< a thousandth of that of an equilateral triangle
  double area;   ///< of the two half kites, flat
};

EdgeShare share_of(const Mesh& mesh, std::int64_t t, int across) {
  const auto corner = [&](int v) { return column(mesh.points, mesh.triangles(v, t)); };
  const Vec3 a = corner(next_vertex(across)), b = corner(previous_vertex(across)),
             c = corner(across);
  const Vec3 normal = cross(a - c, b - c);
  const double cotangent = dot(a - c, b - c) / norm(normal);
  const double length = norm(a - b), sine = length / norm(a + b) * cotangent;
  const double delta = arc_sine(std::clamp(sine, -1.0, 1.0)), square = length * length;
  return {(square / 4 - delta * delta / 3) * delta / length, 6e-5 * square, length * delta / 2};
}

double share_of_both(const EdgeShare& here, const EdgeShare& beyond) {
  return std::max(here.weight + beyond.weight, here.least + beyond.least);
}

/// The row of a site: neighbours and itself, with what they are multiplied by, ascending.
using Row = std::vector<std::pair<std::int32_t, double>>;

void set_row(const Mesh& mesh, const Stars& stars, const Eigen::VectorXd& rho, std::int32_t i,
             Row& row) {
  row.clear();
  double sum = 0, area = 0;
  Corner before = stars.corners[stars.begin[i + 1] - 1];
  for (std::int32_t s = stars.begin[i]; s != stars.begin[i + 1]; ++s) {
    const Corner corner = stars.corners[s];
    const std::int32_t t = triangle_of(corner);
    const EdgeShare here = share_of(mesh, t, previous_vertex(vertex_of(corner))),
                    beyond = share_of(mesh, triangle_of(before), next_vertex(vertex_of(before)));
    const std::int32_t j = mesh.triangles(next_vertex(vertex_of(corner)), t);
    const double weight = (rho[i] + rho[j]) * share_of_both(here, beyond);
    row.emplace_back(j, -weight);
    sum += weight;
    area += (here.area + beyond.area) / 2;
    before = corner;
  }
  row.emplace_back(i, sum + rho[i] * area * area);
  std::sort(row.begin(), row.end());
}

} // namespace

SparseMatrix graph_laplacian(const Points3& points, const Density& density) {
  const Mesh mesh = delaunay(points);
  const Stars stars = make_stars(mesh);
  const Eigen::Index n = points.cols();
  const Eigen::VectorXd rho = evaluate(density, points);
  SparseMatrix matrix(n, n);
  matrix.resizeNonZeros(stars.corners.size() + n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    Row row;
    for (auto i = static_cast<std::int32_t>(begin); i != end; ++i) {
      std::int32_t place = stars.begin[i] + i;
      matrix.outerIndexPtr()[i] = place;
      set_row(mesh, stars, rho, i, row);
      for (const auto& [j, value] : row) {
        matrix.innerIndexPtr()[place] = j;
        matrix.valuePtr()[place++] = value;
      }
    }
  });
  matrix.outerIndexPtr()[n] = stars.begin[n] + static_cast<std::int32_t>(n);
  return matrix;
}

} // namespace calotte::detail
