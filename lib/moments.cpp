// SPDX-License-Identifier: GPL-3.0-or-later
#include "moments.h"

#include "elementary.h"
#include "parallel.h"
#include "points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte::detail {
namespace {

constexpr int lanes = 64; ///< triangles that are worked on at a time, each quantity in a row

using Row = std::array<double, lanes>;
using Rows3 = std::array<Row, 3>;

/// Corners of up to `lanes` triangles.
struct Corners {
  std::array<Rows3, 3> corner; ///< [vertex][x, y, z][lane]
  int count = 0;
};

/// What each edge, named by the vertex across from it, gives to both of its ends.
struct EdgeTerms {
  Rows3 pull; ///< delta / (2 |a-b|): the first moment's part is that times (a - b) for a
  Rows3 area;
  Rows3 energy;
};

Corners gather(const Mesh& mesh, std::int64_t begin, std::int64_t end) {
  Corners corners;
  corners.count = static_cast<int>(end - begin);
  for (int lane = 0; lane < lanes; ++lane) { // the last triangle fills the lanes that are left
    const Eigen::Index t = std::min(begin + lane, end - 1);
    for (std::size_t v = 0; v < 3; ++v)
      for (std::size_t x = 0; x < 3; ++x)
        corners.corner[v][x][static_cast<std::size_t>(lane)] = mesh.points(
            static_cast<Eigen::Index>(x), mesh.triangles(static_cast<Eigen::Index>(v), t));
  }
  return corners;
}

/// What the kernels need of triangles: loops over the lanes of one quantity become vector code.
struct TriangleRows {
  Rows3 square;    ///< of the side across from each vertex
  Rows3 cotangent; ///< of the angle at each vertex
  Row height;      ///< the normal (b - a) x (c - a) times a
};

CALOTTE_VECTOR_WIDTHS
void triangle_rows(const Corners& corners, TriangleRows& out) {
  const auto& [p, q, r] = corners.corner;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const Vec3 a{p[0][lane], p[1][lane], p[2][lane]}, b{q[0][lane], q[1][lane], q[2][lane]},
        c{r[0][lane], r[1][lane], r[2][lane]};
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const Vec3 normal = cross(ca, ab);
    const double scale = 1 / std::sqrt(dot(normal, normal));
    out.square[0][lane] = dot(bc, bc);
    out.square[1][lane] = dot(ca, ca);
    out.square[2][lane] = dot(ab, ab);
    out.cotangent[0][lane] = -dot(ca, ab) * scale;
    out.cotangent[1][lane] = -dot(ab, bc) * scale;
    out.cotangent[2][lane] = -dot(bc, ca) * scale;
    out.height[lane] = dot(normal, a);
  }
}

/// An edge's half, from its end to its middle, and the signed arc from there to the circumcentre.
struct HalfEdge {
  double sine, cosine; ///< of half of the edge's arc
  double arc, sine_of_arc;
};

CALOTTE_INLINE HalfEdge half_edge(double square, double cotangent) {
  const double sine = 0.5 * std::sqrt(square), cosine = std::sqrt(1 - 0.25 * square);
  // Rounding can pass 1 where the circumcap is a hemisphere.
  const double raw = sine / cosine * cotangent, low = raw < -1 ? -1 : raw;
  const double sine_of_arc = low > 1 ? 1 : low;
  return {sine, cosine, arc_sine(sine_of_arc), sine_of_arc};
}

/// atan(sqrt(z))/sqrt(z) - 1 for 0 <= z <= 1/16, by its series.
CALOTTE_INLINE double arc_tangent_excess(double z) {
  return -z *
         (1.0 / 3 -
          z * (1.0 / 5 -
               z * (1.0 / 7 -
                    z * (1.0 / 9 -
                         z * (1.0 / 11 -
                              z * (1.0 / 13 -
                                   z * (1.0 / 15 -
                                        z * (1.0 / 17 -
                                             z * (1.0 / 19 -
                                                  z * (1.0 / 21 -
                                                       z * (1.0 / 23 - z * (1.0 / 25))))))))))));
}

/// Energy of half a kite about its site: twice its area less arc/2 times the sine of the edge's
/// half. With p, q the tangents of half of both arcs these are 2 atan(p q) and 2 p atan(q)/(1 +
/// p^2), whose first terms cancel: they agree to the square of the spacing. Where the arc is small
/// the series are subtracted term by term.
CALOTTE_INLINE double half_energy(const HalfEdge& half) {
  const double p = half.sine / (1 + half.cosine);
  const double q = half.sine_of_arc / (1 + std::sqrt(1 - half.sine_of_arc * half.sine_of_arc));
  const double c = 1 / (1 + p * p);
  const bool small = q * q < 1.0 / 16;
  const double z = small ? q * q : 0;
  const double by_series =
      p * q * (p * p * c + arc_tangent_excess(z * p * p) - c * arc_tangent_excess(z));
  const double direct = arc_tangent(p * q) - 0.5 * half.arc * p * c;
  return 4 * (small ? by_series : direct);
}

CALOTTE_VECTOR_WIDTHS
void pull_and_energy(const Row& square, const Row& cotangent, Row& pull, Row& energy) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const HalfEdge half = half_edge(square[lane], cotangent[lane]);
    pull[lane] = 0.25 * half.arc / half.sine;
    energy[lane] = half_energy(half);
  }
}

CALOTTE_VECTOR_WIDTHS
void half_area(const Row& square, const Row& cotangent, Row& area) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const HalfEdge half = half_edge(square[lane], cotangent[lane]);
    const double tangent =
        half.sine_of_arc / (1 + std::sqrt(1 - half.sine_of_arc * half.sine_of_arc));
    area[lane] = 2 * arc_tangent(half.sine / (1 + half.cosine) * tangent);
  }
}

struct SiteTerms {
  double mass = 0;
  Vec3 first{0, 0, 0};
  double energy = 0;
};

/// Terms of each triangle's three vertices, triangle by triangle.
using TriangleTerms = Array<std::array<SiteTerms, 3>>;

/// Sums each site's terms over its star.
Moments sum_over_stars(const Mesh& mesh, const Stars& stars, const TriangleTerms& terms) {
  const std::int64_t n = mesh.points.cols();
  Moments moments{Array<double>(n), Array<Vec3>(n), Array<double>(n)};
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      SiteTerms sum;
      for (std::int64_t s = stars.begin[i]; s != stars.begin[i + 1]; ++s) {
        const Corner corner = stars.corners[s];
        const SiteTerms& term =
            terms[triangle_of(corner)][static_cast<std::size_t>(vertex_of(corner))];
        sum.mass += term.mass;
        sum.first = sum.first + term.first;
        sum.energy += term.energy;
      }
      moments.mass[i] = sum.mass;
      moments.first[i] = sum.first;
      moments.energy[i] = sum.energy;
    }
  });
  return moments;
}

Vec3 point(const Mesh& mesh, Eigen::Index vertex, Eigen::Index triangle) {
  return column(mesh.points, mesh.triangles(vertex, triangle));
}

// ---- General densities

/// Six half kites of a triangle: two for each edge, one for each of its ends.
struct HalfKite {
  int site; ///< the vertex whose cell it is part of
  Vec3 a, b, c;
};

std::array<HalfKite, 6> half_kites(const std::array<Vec3, 3>& vertex) {
  const Vec3 normal = cross(vertex[1] - vertex[0], vertex[2] - vertex[0]);
  const Vec3 centre = (1 / norm(normal)) * normal;
  std::array<HalfKite, 6> halves;
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t i = (e + 1) % 3, j = (e + 2) % 3;
    const Vec3 sum = vertex[i] + vertex[j];
    const Vec3 middle = (1 / norm(sum)) * sum;
    halves[2 * e] = {static_cast<int>(i), vertex[i], middle, centre};
    halves[2 * e + 1] = {static_cast<int>(j), middle, vertex[j], centre};
  }
  return halves;
}

/// A node of the rule on a part of a half kite.
struct Sample {
  Vec3 x; ///< on the sphere
  double weight;
  std::int32_t owner; ///< 3 times the triangle's number in its block, plus the vertex
};

/// The nodes on a flat triangle a, b, c, cut into divisions^2 parts.
class Cutter {
public:
  Cutter(const QuadratureRule& rule, int divisions) : rule_(rule), divisions_(divisions) {}

  void cut(const HalfKite& half, std::int32_t owner, std::vector<Sample>& out) const {
    const double determinant = dot(half.a, cross(half.b, half.c));
    const double step = 1.0 / divisions_;
    const double weight = 0.5 * determinant * step * step;
    const Vec3 u = step * (half.b - half.a), v = step * (half.c - half.a);
    for (int i = 0; i < divisions_; ++i)
      for (int j = 0; i + j < divisions_; ++j) {
        const Vec3 corner = half.a + i * u + j * v;
        add(corner, u, v, weight, owner, out);
        if (i + j + 1 < divisions_)
          add(corner + u + v, -u, -v, weight, owner, out);
      }
  }

private:
  void add(const Vec3& corner, const Vec3& u, const Vec3& v, double weight, std::int32_t owner,
           std::vector<Sample>& out) const {
    for (const QuadratureRule::Node& node : rule_.nodes) {
      const Vec3 p = corner + node.b * u + node.c * v;
      const double scale = 1 / norm(p);
      out.push_back({scale * p, weight * node.weight * scale * scale * scale, owner});
    }
  }

  const QuadratureRule& rule_;
  int divisions_;
};

} // namespace

Pulls edge_pulls(const Mesh& mesh) {
  const std::int64_t m = mesh.triangles.cols();
  Pulls pulls{Array<double>(4 * m), 0};
  std::vector<double> energy(static_cast<std::size_t>(block_count(m)), 0);
  for_each_block(m, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    TriangleRows rows;
    EdgeTerms edges;
    for (std::int64_t first = begin; first < end; first += lanes) {
      const Corners corners = gather(mesh, first, std::min<std::int64_t>(first + lanes, end));
      triangle_rows(corners, rows);
      for (std::size_t e = 0; e < 3; ++e)
        pull_and_energy(rows.square[e], rows.cotangent[e], edges.pull[e], edges.energy[e]);
      for (int lane = 0; lane < corners.count; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        double* row = pulls.values.begin() + 4 * (first + lane);
        for (std::size_t e = 0; e < 3; ++e)
          row[e] = edges.pull[e][l];
        row[3] = rows.height[l];
        energy[static_cast<std::size_t>(block)] += // of both ends
            2 * (edges.energy[0][l] + edges.energy[1][l] + edges.energy[2][l]);
      }
    }
  });
  for (const double part : energy) // in the order of the blocks: the same for any threads
    pulls.energy += part;
  return pulls;
}

Array<Vec3> uniform_first_moments(const Mesh& mesh, const Stars& stars, const Pulls& pulls) {
  const std::int64_t n = mesh.points.cols();
  Array<Vec3> moments(n);
  for_each_block(n, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i != end; ++i) {
      const Vec3 x = column(mesh.points, i);
      Vec3 sum{0, 0, 0};
      Corner before = stars.corners[stars.begin[i + 1] - 1];
      for (std::int64_t s = stars.begin[i]; s != stars.begin[i + 1]; ++s) {
        const Corner corner = stars.corners[s];
        const std::int32_t t = triangle_of(corner);
        const int v = vertex_of(corner);
        const double pull =
            pulls[4 * std::int64_t{t} + previous_vertex(v)] +
            pulls[4 * std::int64_t{triangle_of(before)} + next_vertex(vertex_of(before))];
        sum = sum + pull * (x - column(mesh.points, mesh.triangles(next_vertex(v), t)));
        before = corner;
      }
      moments[i] = sum;
    }
  });
  return moments;
}

Moments uniform_moments(const Mesh& mesh, const Stars& stars) {
  const std::int64_t m = mesh.triangles.cols();
  TriangleTerms terms(m);
  for_each_block(m, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    TriangleRows rows;
    EdgeTerms edges;
    for (std::int64_t first = begin; first < end; first += lanes) {
      const Corners corners = gather(mesh, first, std::min<std::int64_t>(first + lanes, end));
      triangle_rows(corners, rows);
      for (std::size_t e = 0; e < 3; ++e) {
        pull_and_energy(rows.square[e], rows.cotangent[e], edges.pull[e], edges.energy[e]);
        half_area(rows.square[e], rows.cotangent[e], edges.area[e]);
      }
      for (int lane = 0; lane < corners.count; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        const auto at = [&](std::size_t v) {
          return Vec3{corners.corner[v][0][l], corners.corner[v][1][l], corners.corner[v][2][l]};
        };
        for (std::size_t v = 0; v < 3; ++v) {
          const std::size_t i = (v + 1) % 3,
                            j = (v + 2) % 3; // edge j goes to vertex i, edge i to j
          terms[first + lane][v] = {edges.area[i][l] + edges.area[j][l],
                                    edges.pull[j][l] * (at(v) - at(i)) +
                                        edges.pull[i][l] * (at(v) - at(j)),
                                    edges.energy[i][l] + edges.energy[j][l]};
        }
      }
    }
  });
  return sum_over_stars(mesh, stars, terms);
}

Moments quadrature_moments(const Mesh& mesh, const Stars& stars, const Density& density,
                           const QuadratureRule& rule, int divisions) {
  const std::int64_t m = mesh.triangles.cols();
  TriangleTerms terms(m);
  const Cutter cutter(rule, divisions);
  constexpr std::int64_t batch = 16; // triangles whose nodes are evaluated at once
  for_each_block(m, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::vector<Sample> samples;
    Points3 x;
    for (std::int64_t first = begin; first < end; first += batch) {
      const std::int64_t last = std::min(first + batch, end);
      samples.clear();
      for (std::int64_t t = first; t < last; ++t)
        for (const HalfKite& half :
             half_kites({point(mesh, 0, t), point(mesh, 1, t), point(mesh, 2, t)}))
          cutter.cut(half, static_cast<std::int32_t>(3 * (t - first) + half.site), samples);
      x.resize(3, std::ssize(samples));
      for (Eigen::Index s = 0; s < x.cols(); ++s) {
        const Vec3& p = samples[static_cast<std::size_t>(s)].x;
        x.col(s) << p.x, p.y, p.z;
      }
      const Eigen::VectorXd rho = evaluate(density, x);
      std::fill(terms.begin() + first, terms.begin() + last, std::array<SiteTerms, 3>{});
      for (Eigen::Index s = 0; s < x.cols(); ++s) {
        const Sample& sample = samples[static_cast<std::size_t>(s)];
        const std::int64_t t = first + sample.owner / 3;
        const int v = sample.owner % 3;
        const double weight = sample.weight * rho[s];
        const Vec3 apart = sample.x - point(mesh, v, t);
        SiteTerms& term = terms[t][static_cast<std::size_t>(v)];
        term.mass += weight;
        term.first = term.first + weight * sample.x;
        term.energy += weight * dot(apart, apart);
      }
    }
  });
  return sum_over_stars(mesh, stars, terms);
}

} // namespace calotte::detail
