// SPDX-License-Identifier: GPL-3.0-or-later
#include "quality/truncation.h"

#include "base/array.h"
#include "base/parallel.h"
#include "base/points.h"
#include "quality/error_norms.h"
#include "quality/smooth_fields.h"
#include "voronoi/tangential_weights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace calotte::quality_detail {
namespace {

/// The measurement of truncation errors for one set of smooth fields.
template <class Fields> class Truncation {
public:
  Truncation(const Voronoi& of, const Fields& fields) : of_(of), fields_(fields) {
    find_whole_cells();
    set_slopes();
  }

  void measure(OperatorErrors& out) {
    Errors errors;
    out.divergence = cells(errors, [&](std::int64_t i) { return divergence(i); });
    out.by_cell.divergence = as_vector(errors);
    out.laplacian = cells(errors, [&](std::int64_t i) { return laplacian(i); });
    out.by_cell.laplacian = as_vector(errors);
    out.kinetic_energy = cells(errors, [&](std::int64_t i) { return kinetic_energy(i); });
    out.by_cell.kinetic_energy = as_vector(errors);
    out.gradient = edges(errors, [&](std::int64_t e) { return gradient(e); });
    out.by_cell.gradient = by_cell(errors, of_.edges_on_cell);
    out.tangential = edges(errors, [&](std::int64_t e) { return tangential(e); });
    out.by_cell.tangential = by_cell(errors, of_.edges_on_cell);
    out.curl = vertices(errors, [&](std::int64_t t) { return curl(t); });
    out.by_cell.curl = by_cell(errors, of_.vertices_on_cell);
    out.off_midpoint = off_midpoint();
  }

private:
  static constexpr std::size_t count = Fields::count;
  using Values = typename Fields::Values;

  /// The components of grad s at the midpoint of an edge.
  struct Slopes {
    Values normal, along;
  };

  // ---- Stencils

  void find_whole_cells() {
    whole_ = Array<std::uint8_t>(of_.cells.cols());
    for_each_block(whole_.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i) {
        bool whole = of_.cell_area[i] > 0 && of_.cells_on_cell.count(i) > 0;
        for (const std::int32_t other : of_.cells_on_cell[i])
          whole = whole && other >= 0;
        whole_[i] = whole ? 1 : 0;
      }
    });
  }
  bool whole(std::int32_t cell) const { return cell >= 0 && whole_[cell] != 0; }
  bool whole_edge(std::int64_t e) const {
    return whole(of_.cells_on_edge(0, e)) && whole(of_.cells_on_edge(1, e));
  }
  bool whole_vertex(std::int64_t t) const {
    return whole(of_.cells_on_vertex(0, t)) && whole(of_.cells_on_vertex(1, t)) &&
           whole(of_.cells_on_vertex(2, t));
  }

  // ---- Smooth fields

  void set_slopes() {
    slopes_ = Array<Slopes>(of_.edges.cols());
    for_each_block(slopes_.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t e = begin; e != end; ++e) {
        slopes_[e] = {};
        if (of_.cells_on_edge(1, e) < 0)
          continue;
        const Vec3 across =
            fields_.offset(cell(of_.cells_on_edge(0, e)), cell(of_.cells_on_edge(1, e)));
        const Vec3 point = column(of_.edges, e), normal = (1 / norm(across)) * across;
        slopes_[e] = {fields_.slopes(point, normal),
                      fields_.slopes(point, cross(fields_.up(point), normal))};
      }
    });
  }
  const Vec3& cell(std::int64_t i) const { return column(of_.cells, i); }

  // ---- Operators: the errors at one point

  /// Calls add(edge, sign) for the edges of a cell; sign is 1 if the normal leaves it.
  template <class Add> void around_cell(std::int64_t i, const Add& add) const {
    for (const std::int32_t edge : of_.edges_on_cell[i])
      add(edge, of_.cells_on_edge(0, edge) == i ? 1.0 : -1.0);
  }

  Squares divergence(std::int64_t i) const {
    Values of_gradient{}, of_rotated{};
    around_cell(i, [&](std::int32_t edge, double sign) {
      for (std::size_t m = 0; m < count; ++m) {
        of_gradient[m] += sign * of_.dv[edge] * slopes_[edge].normal[m];
        of_rotated[m] -= sign * of_.dv[edge] * slopes_[edge].along[m];
      }
    });
    const Values exact = fields_.laplacians(cell(i));
    Squares out;
    for (std::size_t m = 0; m < count; ++m) {
      out.add(of_gradient[m] / of_.cell_area[i], exact[m]);
      out.add(of_rotated[m] / of_.cell_area[i], 0);
    }
    return out;
  }

  Squares laplacian(std::int64_t i) const {
    Values flux{};
    const Values here = fields_.values(cell(i));
    const std::span<const std::int32_t> edges = of_.edges_on_cell[i], others = of_.cells_on_cell[i];
    for (std::size_t k = 0; k != edges.size(); ++k) {
      const std::int32_t edge = edges[k];
      const Values there = fields_.values(cell(others[k]));
      for (std::size_t m = 0; m < count; ++m)
        flux[m] += of_.dv[edge] / of_.dc[edge] * (there[m] - here[m]);
    }
    const Values exact = fields_.laplacians(cell(i));
    Squares out;
    for (std::size_t m = 0; m < count; ++m)
      out.add(flux[m] / of_.cell_area[i], exact[m]);
    return out;
  }

  Squares kinetic_energy(std::int64_t i) const {
    Values of_gradient{}, of_rotated{};
    around_cell(i, [&](std::int32_t edge, double) {
      const double weight = 0.25 * of_.dc[edge] * of_.dv[edge];
      for (std::size_t m = 0; m < count; ++m) {
        of_gradient[m] += weight * slopes_[edge].normal[m] * slopes_[edge].normal[m];
        of_rotated[m] += weight * slopes_[edge].along[m] * slopes_[edge].along[m];
      }
    });
    const Values squares = fields_.squared_slopes(cell(i));
    Squares out;
    for (std::size_t m = 0; m < count; ++m) {
      out.add(of_gradient[m] / of_.cell_area[i], 0.5 * squares[m]);
      out.add(of_rotated[m] / of_.cell_area[i], 0.5 * squares[m]);
    }
    return out;
  }

  Squares gradient(std::int64_t e) const {
    const Values first = fields_.values(cell(of_.cells_on_edge(0, e))),
                 second = fields_.values(cell(of_.cells_on_edge(1, e)));
    Squares out;
    for (std::size_t m = 0; m < count; ++m)
      out.add((second[m] - first[m]) / of_.dc[e], slopes_[e].normal[m]);
    return out;
  }

  Squares tangential(std::int64_t e) const {
    static thread_local std::vector<std::int32_t> others;
    static thread_local std::vector<double> weights;
    others.resize(static_cast<std::size_t>(weight_count(of_, e)));
    weights.resize(others.size());
    set_weights(of_, static_cast<std::int32_t>(e), others.data(), weights.data());
    Values of_gradient{}, of_rotated{};
    for (std::size_t k = 0; k < others.size(); ++k) {
      const Slopes& slopes = slopes_[others[k]];
      for (std::size_t m = 0; m < count; ++m) {
        of_gradient[m] += weights[k] * slopes.normal[m];
        of_rotated[m] -= weights[k] * slopes.along[m];
      }
    }
    Squares out;
    for (std::size_t m = 0; m < count; ++m) {
      out.add(of_gradient[m], slopes_[e].along[m]);
      out.add(of_rotated[m], slopes_[e].normal[m]);
    }
    return out;
  }

  Squares curl(std::int64_t t) const {
    Values of_gradient{}, of_rotated{};
    for (int j = 0; j < 3; ++j) {
      const std::int32_t edge = of_.edges_on_vertex(j, t);
      const double way = of_.vertices_on_edge(1, edge) == t ? of_.dc[edge] : -of_.dc[edge];
      for (std::size_t m = 0; m < count; ++m) {
        of_gradient[m] += way * slopes_[edge].normal[m];
        of_rotated[m] -= way * slopes_[edge].along[m];
      }
    }
    const Values exact = fields_.laplacians(column(of_.vertices, t));
    Squares out;
    for (std::size_t m = 0; m < count; ++m) {
      out.add(of_gradient[m] / of_.vertex_area[t], 0);
      out.add(of_rotated[m] / of_.vertex_area[t], exact[m]);
    }
    return out;
  }

  // ---- Norms

  /// Sets the position and the cell of the greatest error, of which `cell` is the index.
  template <class CellAt>
  static ErrorNorms located(ErrorNorms norms, const Points3& points, const CellAt& cell_at) {
    if (norms.cell >= 0) {
      norms.position = points.col(norms.cell);
      norms.cell = cell_at(norms.cell);
    }
    return norms;
  }
  template <class Measure> ErrorNorms cells(Errors& errors, const Measure& measure) const {
    const auto area = [&](std::int64_t i) { return whole_[i] != 0 ? of_.cell_area[i] : 0.0; };
    return located(error_norms(of_.cells.cols(), area, measure, errors), of_.cells,
                   [](std::int64_t i) { return i; });
  }
  template <class Measure> ErrorNorms edges(Errors& errors, const Measure& measure) const {
    const auto area = [&](std::int64_t e) { return whole_edge(e) ? of_.dc[e] * of_.dv[e] : 0.0; };
    return located(error_norms(of_.edges.cols(), area, measure, errors), of_.edges,
                   [&](std::int64_t e) { return of_.cells_on_edge(0, e); });
  }
  template <class Measure> ErrorNorms vertices(Errors& errors, const Measure& measure) const {
    const auto area = [&](std::int64_t t) { return whole_vertex(t) ? of_.vertex_area[t] : 0.0; };
    return located(error_norms(of_.vertices.cols(), area, measure, errors), of_.vertices,
                   [&](std::int64_t t) { return of_.cells_on_vertex(0, t); });
  }

  ErrorNorms off_midpoint() const {
    ErrorNorms norms = distance_norms(of_.edges.cols(), [&](std::int64_t e) {
      if (!whole_edge(e))
        return no_value;
      const Vec3 middle = fields_.middle(column(of_.vertices, of_.vertices_on_edge(0, e)),
                                         column(of_.vertices, of_.vertices_on_edge(1, e)));
      return norm(fields_.offset(column(of_.edges, e), middle)) / of_.dc[e];
    });
    return located(norms, of_.edges, [&](std::int64_t e) { return of_.cells_on_edge(0, e); });
  }

  static DoubleVector as_vector(const Errors& errors) {
    return Eigen::Map<const DoubleVector>(errors.begin(), errors.size());
  }
  /// The greatest error of each cell's edges or vertices.
  DoubleVector by_cell(const Errors& errors, const IdLists& on_cell) const {
    DoubleVector out(of_.cells.cols());
    for_each_block(out.size(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i != end; ++i) {
        out[i] = no_value;
        for (const std::int32_t id : on_cell[i])
          out[i] = std::fmax(out[i], errors[id]);
      }
    });
    return out;
  }

  const Voronoi& of_;
  Fields fields_;
  Array<std::uint8_t> whole_; ///< by cell: whether no boundary clips it
  Array<Slopes> slopes_;      ///< by edge
};

/// The longest waves of a periodic plane, or of the box around the cells.
Waves longest_waves(const Voronoi& of) {
  constexpr double turn = 2 * std::numbers::pi;
  if (of.surface.period().minCoeff() > 0)
    return {{0, 0, 0},
            turn / of.surface.period()[0],
            turn / of.surface.period()[1],
            Plane(of.surface.period())};
  const Eigen::Vector3d low = of.vertices.rowwise().minCoeff(),
                        extent = of.vertices.rowwise().maxCoeff() - low;
  return {{low[0], low[1], 0}, turn / extent[0], turn / extent[1], Plane()};
}

} // namespace

void set_truncation(const Voronoi& of, OperatorErrors& out) {
  if (of.surface.is_sphere())
    Truncation(of, Harmonics{}).measure(out);
  else
    Truncation(of, longest_waves(of)).measure(out);
}

} // namespace calotte::quality_detail
