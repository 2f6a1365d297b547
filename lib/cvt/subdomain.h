// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "cvt/cells.h"
#include "cvt/functional.h"
#include "cvt/positioned_mesh.h"
#include "cvt/repair.h"
#include "cvt/room.h"
#include "cvt/shape.h"
#include "cvt/tessellation.h"
#include "density/density_evaluator.h"
#include "integrals/integrand.h"
#include "integrals/moments.h"
#include "integrals/patches.h"
#include "mesh/connectivity.h"
#include "mesh/submesh.h"

#include <calotte/cvt.h>
#include <calotte/mesh.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Local work: parts of a tessellation that descend independently, each in one task.
namespace calotte::cvt_detail {

/// The input that all subdomains of a run share.
struct LocalInput {
  const Density& density;
  const Integrand& integrand;
  const std::vector<std::uint8_t>& fixed; ///< by generator, how it is pinned, see shape.h; or empty
  bool may_slide = true;                  ///< whether generators on the boundary slide

  /// Whether a generator moves, as far as its pin is concerned.
  bool moves(std::int32_t generator) const {
    const std::uint8_t pin =
        fixed.empty() ? std::uint8_t{0} : fixed[static_cast<std::size_t>(generator)];
    return pin == 0 || (may_slide && pin == sliding);
  }
};

/// Some triangles of a mesh, as a functional of the generators inside. The generators on the
/// subdomain's boundary and the pinned ones stay; those on the surface's boundary slide along it.
/// Subdomains without a common triangle are independent.
///
/// Sites and triangles have local numbers, which depend only on the sites of the triangles: the
/// result has the same bits for any numbering of the mesh's triangles.
template <Space S> class Subdomain final : public Functional {
public:
  /// \param cells at the points. \param mesh Delaunay. \param triangles each once.
  /// \param along of the mesh, see PositionedMesh.
  Subdomain(const Cells<S>& cells, const Connectivity& mesh, const Points3& points,
            std::span<const std::int32_t> along, std::vector<std::int32_t> triangles,
            const LocalInput& input);

  PositionedMesh<S> positioned() const {
    return {cells_, part_.faces, {x_.begin(), part_.sites.size()}, along_};
  }
  std::int32_t movable() const { return patch_.owned; } ///< sites that move: the first ones
  /// The sites' numbers in the mesh: first those that move, ascending, then the others.
  std::span<const std::int32_t> sites() const { return part_.sites; }
  const Points3& points() const { return points_; } ///< of the generators that move
  std::int64_t triangles() const { return part_.faces.triangles.cols(); }
  bool may_slide() const {
    return !sliders_.empty();
  }                                     ///< whether a generator does, on the boundary
  std::int64_t inner_triangles() const; ///< the number of those of generators on the surface

  void penalise(const ShapePenalty& penalty) { penalty_ = penalty; }

  /// Writes the generators and the triangles back. Edges of the subdomain may not be Delaunay.
  /// \param changed triangles that have other vertices or neighbours are added.
  /// \param rim triangles at the subdomain's boundary and beyond it, whose edges may not be
  /// Delaunay, are added.
  void write(Connectivity& mesh, Points3& points, std::vector<std::int32_t>& changed,
             std::vector<std::int32_t>& rim) const;

  // ---- The functional. Of an evaluation, `linf` is in widths of the cells. Where flips do not
  // make the mesh Delaunay, the energy is infinite, and the mesh stays as it was.

  void evaluate(const Points3& points, bool final_rule, bool with_gradient,
                Evaluation& out) override;
  void set_centroids(const Points3& points, const Evaluation& at, Points3& to) const override;
  void retract(const Points3& x, double step, const Points3& d, Points3& to) const override;
  void make_tangential(Points3& vectors, const Points3& x, base_detail::Part part) const override;
  /// A local descent uses no Laplacian.
  Laplacian laplacian(const Points3&) override { return {}; }

private:
  void number_sites(const LocalInput& input);
  void find_sliders(const LocalInput& input);
  void set_along(std::span<const std::int32_t> along);
  void set_patch();
  bool integrate();
  void add_penalty(Evaluation& out);

  const Cells<S>& cells_;
  const Integrand& integrand_;
  DensityEvaluator density_;
  Submesh part_;
  Points3 points_;
  Array<Vec3> x_; ///< positions of all sites
  Patch patch_;   ///< its triangles are those with a site that moves
  Array<CellMoments> moments_;
  std::vector<std::int32_t> suspects_;
  std::vector<std::uint8_t> stays_; ///< by site
  /// A generator that slides along the boundary, and the length over which it sees the boundary's
  /// direction.
  struct Slider {
    std::int32_t site;
    double reach;
  };
  std::vector<Slider> sliders_;     ///< ascending
  std::vector<std::int32_t> along_; ///< see PositionedMesh
  std::int64_t generators_ = 0;     ///< sites that are generators: the first ones
  ShapePenalty penalty_;
  bool flipped_ = false;
};

/// Descends in a subdomain from a start, by L-BFGS. It ends when ended(evaluation, count) is true
/// of the last accepted evaluation and the number of evaluations, or when no step lowers the value.
/// \returns the last evaluation; its energy is infinite if the mesh was not Delaunay at the start.
template <Space S>
Evaluation descend(Subdomain<S>& part, const Points3& start, const LocalInput& input,
                   const ShapePenalty& penalty,
                   const std::function<bool(const Evaluation&, int)>& ended);

/// A pair of triangles, which may be one, with those within some steps across edges.
struct Surroundings {
  std::size_t seed;
  std::vector<std::int32_t> triangles; ///< the nearer ones first
};

struct DisjointSurroundings {
  std::vector<Surroundings> chosen; ///< without a common triangle
  std::vector<std::size_t> left;    ///< seeds that are neither chosen nor in what is chosen
};

/// Chooses seeds, the first ones in their order, whose surroundings have no common triangle.
DisjointSurroundings choose_disjoint(const Connectivity& mesh,
                                     std::span<const std::array<std::int32_t, 2>> seeds);

/// A task in a subdomain; false if its result must be discarded, as without a valid mesh.
template <Space S> using LocalTask = std::function<bool(std::size_t index, Subdomain<S>& part)>;

/// Runs a task in the subdomain of each of some surroundings, which have no common triangle, and
/// writes the results back.
/// \param mesh of the tessellation, which stays Delaunay.
/// \param task called with the index of the surroundings in the list.
/// \param changed triangles that have changed are added.
/// \returns false if flips do not make the mesh Delaunay; it is then unusable.
template <Space S>
bool work_in(std::span<const Surroundings> surroundings, const LocalTask<S>& task,
             const LocalInput& input, Tessellation<S>& tessellation, Connectivity& mesh,
             Points3& points, std::vector<std::int32_t>& changed);

} // namespace calotte::cvt_detail
