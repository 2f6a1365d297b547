// SPDX-License-Identifier: GPL-3.0-or-later
#include "cvt/subdomain.h"

#include "base/parallel.h"
#include "base/points.h"
#include "base/triangle.h"
#include "cvt/descent.h"
#include "cvt/state.h"
#include "density/hexagons.h"
#include "mesh/rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace calotte::cvt_detail {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The triangles within some steps across edges from a pair, the nearer ones first.
std::vector<std::int32_t> triangles_around(const Connectivity& mesh,
                                           const std::array<std::int32_t, 2>& pair, int steps) {
  std::vector<std::int32_t> found(pair.begin(), pair[0] == pair[1] ? pair.begin() + 1 : pair.end()),
      row = found;
  std::unordered_set<std::int32_t> known(found.begin(), found.end());
  for (int step = 0; step < steps; ++step) {
    row = mesh_detail::next_row(
        row, [&](std::int32_t t) { return mesh.neighbours.col(t); },
        [&](std::int32_t t) { return t >= 0 && known.insert(t).second; });
    found.insert(found.end(), row.begin(), row.end());
  }
  return found;
}

} // namespace

template <Space S>
Subdomain<S>::Subdomain(const Cells<S>& cells, const Connectivity& mesh, const Points3& points,
                        std::span<const std::int32_t> along, std::vector<std::int32_t> triangles,
                        const LocalInput& input)
    : cells_(cells), integrand_(input.integrand), density_(input.density) {
  sort_by_sites(triangles, mesh.triangles);
  part_ = mesh_detail::extract(mesh.triangles, mesh.neighbours, std::move(triangles));
  number_sites(input);
  points_.resize(3, movable());
  for (std::int32_t i = 0; i < movable(); ++i)
    points_.col(i) = points.col(part_.sites[static_cast<std::size_t>(i)]);
  x_ = Array<Vec3>(std::ssize(part_.sites));
  for (std::int64_t i = 0; i < x_.size(); ++i)
    x_[i] = cells_.position(part_.sites[static_cast<std::size_t>(i)]);
  moments_ = Array<CellMoments>(x_.size());
  find_sliders(input);
  if (!along.empty())
    set_along(along);
  set_patch();
}

/// Numbers the sites: first those that move, then the others.
template <Space S> void Subdomain<S>::number_sites(const LocalInput& input) {
  std::vector<std::uint8_t> moves(part_.sites.size());
  std::transform(part_.sites.begin(), part_.sites.end(), moves.begin(), [&](std::int32_t site) {
    return site < cells_.generator_count() && input.moves(site);
  });
  for (const Submesh::RimEdge& edge : part_.rim)
    moves[static_cast<std::size_t>(edge.from)] = 0;
  patch_.owned = put_first(part_, moves);
  patch_.sites = part_.sites;
  generators_ = std::count_if(part_.sites.begin(), part_.sites.end(),
                              [&](std::int32_t site) { return site < cells_.generator_count(); });
  stays_.assign(part_.sites.size(), pinned);
  std::fill_n(stays_.begin(), patch_.owned, 0);
}

template <Space S> void Subdomain<S>::find_sliders(const LocalInput& input) {
  constexpr double share = 0.05; // of the nearest neighbour's distance
  std::vector<std::int32_t> slider(static_cast<std::size_t>(movable()), -1);
  for (std::int32_t i = 0; input.may_slide && !input.fixed.empty() && i < movable(); ++i)
    if (input.fixed[static_cast<std::size_t>(part_.sites[static_cast<std::size_t>(i)])] ==
        sliding) {
      slider[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(sliders_.size());
      sliders_.push_back({i, infinite});
      stays_[static_cast<std::size_t>(i)] = sliding;
    }
  if (sliders_.empty())
    return;
  for (std::int32_t t = 0; t < triangles(); ++t)
    for (int v = 0; v < 3; ++v) {
      const std::int32_t i = part_.faces.triangles(v, t);
      if (i >= movable() || slider[static_cast<std::size_t>(i)] < 0)
        continue;
      double& reach = sliders_[static_cast<std::size_t>(slider[static_cast<std::size_t>(i)])].reach;
      for (const int w : {next_vertex(v), previous_vertex(v)})
        reach =
            std::min(reach, share * norm(cells_.offset(x_[i], x_[part_.faces.triangles(w, t)])));
    }
}

template <Space S> std::int64_t Subdomain<S>::inner_triangles() const {
  const PositionedMesh<S> in = positioned();
  std::int64_t count = 0;
  for (std::int32_t t = 0; t < triangles(); ++t)
    count += part_.faces.triangles.col(t).maxCoeff() < generators_ && in.has_centre(t);
  return count;
}

template <Space S>
void Subdomain<S>::retract(const Points3& x, double step, const Points3& d, Points3& to) const {
  cells_.retract(x, step, d, to);
  for (const auto& [i, reach] : sliders_) {
    const Vec3 from = column(x, i), way = step * column(d, i);
    set_column(to, i, cells_.slid_on_boundary(from, way, reach));
  }
}

template <Space S>
void Subdomain<S>::make_tangential(Points3& vectors, const Points3& x,
                                   base_detail::Part part) const {
  cells_.make_tangential(vectors, x, part);
  for (const auto& [i, reach] : sliders_)
    if (i >= part.begin && i < part.end) {
      const Vec3 along = cells_.along_boundary(column(x, i), reach);
      set_column(vectors, i, dot(column(vectors, i), along) * along);
    }
}

template <Space S> void Subdomain<S>::set_along(std::span<const std::int32_t> along) {
  std::unordered_map<std::int32_t, std::int32_t> local; // of those on the boundary
  for (std::size_t i = 0; i < part_.sites.size(); ++i)
    if (along[static_cast<std::size_t>(part_.sites[i])] >= 0)
      local.emplace(part_.sites[i], static_cast<std::int32_t>(i));
  along_.assign(part_.sites.size(), -1);
  for (const auto& [site, i] : local) {
    const auto next = local.find(along[static_cast<std::size_t>(site)]);
    along_[static_cast<std::size_t>(i)] = next != local.end() ? next->second : i; // or no other
  }
}

template <Space S> void Subdomain<S>::set_patch() {
  patch_.triangles.clear();
  for (std::int32_t t = 0; t < part_.faces.triangles.cols(); ++t)
    if (part_.faces.triangles.col(t).minCoeff() < patch_.owned)
      patch_.triangles.push_back(t);
  sort_by_sites(patch_.triangles, part_.faces.triangles);
  patch_.corners.clear();
  for (const std::int32_t t : patch_.triangles)
    patch_.corners.push_back(sites_from_lowest(part_.faces.triangles, t));
}

/// Integrates over the cells. Flips make the mesh Delaunay; false if they do not suffice.
template <Space S> bool Subdomain<S>::integrate() {
  constexpr int most_repairs = 4;
  const SitePositions<S> positions{cells_.space(), {x_.begin(), part_.sites.size()}};
  std::optional<Connectivity> before;
  for (int repairs = 0;; ++repairs) {
    suspects_.clear();
    cells_.integrate(integrand_, patch_, x_, moments_, suspects_);
    Faults faults;
    for (const std::int32_t suspect : suspects_)
      add_faults(part_.faces, positions, patch_.triangles[static_cast<std::size_t>(suspect)],
                 faults);
    if (faults.none())
      return true;
    if (!before)
      before = part_.faces;
    const bool sound = repairs < most_repairs && repair(part_.faces, positions, faults);
    if (!sound)
      part_.faces = std::move(*before);
    flipped_ = true;
    set_patch();
    if (!sound)
      return false;
  }
}

/// The energy is that of all parts of cells in the patch: it differs from the run's by a constant.
template <Space S> void Subdomain<S>::evaluate(const Points3& points, bool, bool, Evaluation& out) {
  points_ = points;
  for (std::int32_t i = 0; i < movable(); ++i)
    x_[i] = cells_.space().wrapped(column(points_, i));
  out.iteration = {};
  out.gradient.setZero(3, movable());
  if (out.mass.size() != movable())
    out.mass = Array<double>(movable());
  CvtIteration& iteration = out.iteration;
  iteration.cells = movable();
  iteration.spacing = 1;
  iteration.linear_density = integrand_.at_sites;
  if (!integrate()) {
    iteration.energy = infinite;
    return;
  }
  for (std::int32_t i = 0; i < movable(); ++i) {
    const Vec3& from = column(points_, i);
    const Pull pull = Cells<S>::pull(from, moments_[i]);
    const Vec3 way = pull.centroid - from;
    const double square = dot(way, way), slope = dot(pull.gradient, pull.gradient);
    if (!(pull.mass > 0)) {
      iteration.energy = infinite;
      return;
    }
    set_column(out.gradient, i, pull.gradient);
    out.mass[i] = pull.mass;
    iteration.l2 += square;
    iteration.gradient += slope;
    // The energy of a hexagon of area A is hexagon_energy A times its mass.
    iteration.linf = std::max(iteration.linf, density_detail::hexagon_energy * square * pull.mass /
                                                  moments_[i].energy);
  }
  for (std::int64_t i = 0; i < generators_; ++i)
    iteration.energy += moments_[i].energy;
  if (!sliders_.empty())
    make_tangential(out.gradient, points_, {0, movable()});
  iteration.l2 = std::sqrt(iteration.l2 / movable());
  iteration.linf = std::sqrt(iteration.linf);
  iteration.gradient = std::sqrt(iteration.gradient);
  out.penalty = 0;
  if (penalty_.factors.shapes > 0)
    add_penalty(out);
}

template <Space S> void Subdomain<S>::add_penalty(Evaluation& out) {
  DoubleVector inverse_spacing(generators_);
  density_(x_.begin(), generators_, inverse_spacing.data());
  inverse_spacing = inverse_spacing.cwiseSqrt().cwiseSqrt() / penalty_.spacing;
  const ShapeInput<S> input{positioned(), inverse_spacing, penalty_.limits, stays_};
  Points3 gradient = Points3::Zero(3, x_.size());
  gradient.leftCols(movable()) = out.gradient;
  out.shapes = add_shape_terms(input, distorted(input), penalty_.factors, gradient);
  out.gradient = gradient.leftCols(movable());
  make_tangential(out.gradient, points_, {0, movable()});
  out.penalty = out.shapes.value;
  out.iteration.shape_excess = out.shapes.worst;
}

template <Space S>
void Subdomain<S>::set_centroids(const Points3& points, const Evaluation& at, Points3& to) const {
  to.resize(3, movable());
  for (std::int32_t i = 0; i < movable(); ++i)
    set_column(to, i, Cells<S>::centroid(column(points, i), column(at.gradient, i), at.mass[i]));
  for (const auto& [i, reach] : sliders_) {
    const Vec3& x = column(points, i);
    const Vec3 way = (-0.5 / at.mass[i]) * column(at.gradient, i);
    set_column(to, i, cells_.slid_on_boundary(x, way, reach));
  }
}

template <Space S>
void Subdomain<S>::write(Connectivity& mesh, Points3& points, std::vector<std::int32_t>& changed,
                         std::vector<std::int32_t>& rim) const {
  for (std::int32_t i = 0; i < movable(); ++i)
    points.col(part_.sites[static_cast<std::size_t>(i)]) = points_.col(i);
  // Other edges are tested by integrate(), which examines the triangles with a generator that
  // moves.
  for (std::int64_t k = 0; k < triangles(); ++k)
    if (part_.faces.triangles.col(k).minCoeff() >= movable() ||
        part_.faces.neighbours.col(k).minCoeff() < 0)
      rim.push_back(part_.triangles[static_cast<std::size_t>(k)]);
  for (const Submesh::RimEdge& edge : part_.rim)
    if (const std::int32_t out = mesh.neighbours(edge.across, edge.triangle); out >= 0)
      rim.push_back(out);
  if (!flipped_)
    return;
  splice(part_, mesh);
  changed.insert(changed.end(), part_.triangles.begin(), part_.triangles.end());
}

template <Space S>
Evaluation descend(Subdomain<S>& part, const Points3& start, const LocalInput& input,
                   const ShapePenalty& penalty,
                   const std::function<bool(const Evaluation&, int)>& ended) {
  const DescentOptions options{.method = Method::lbfgs};
  State state;
  state.points = start;
  state.polish.penalty = penalty.factors.shapes;
  part.penalise(penalty);
  Descent descent(state, options, input.density, part);
  descent.begin();
  while (descent.here().iteration.energy < infinite && !state.memory.stuck &&
         !ended(descent.here(), state.memory.iterations))
    descent.step();
  if (!state.report.iterations.back().accepted)
    descent.restart(); // the subdomain is at a trial
  Evaluation last;
  last.iteration = descent.here().iteration;
  last.penalty = descent.here().penalty;
  last.shapes = descent.here().shapes;
  return last;
}

DisjointSurroundings choose_disjoint(const Connectivity& mesh,
                                     std::span<const std::array<std::int32_t, 2>> seeds) {
  constexpr int reach = 13; // steps, as wide as half as many cells
  std::vector<std::vector<std::int32_t>> around(seeds.size());
  for_each_task(std::ssize(seeds), [&](std::int64_t k) {
    const auto seed = static_cast<std::size_t>(k);
    around[seed] = triangles_around(mesh, seeds[seed], reach);
  });
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  const auto is_taken = [&](std::int32_t t) { return taken[static_cast<std::size_t>(t)] != 0; };
  DisjointSurroundings out;
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    if (std::any_of(around[k].begin(), around[k].end(), is_taken)) {
      out.left.push_back(k);
      continue;
    }
    for (const std::int32_t t : around[k])
      taken[static_cast<std::size_t>(t)] = 1;
    out.chosen.push_back({k, std::move(around[k])});
  }
  std::erase_if(out.left,
                [&](std::size_t k) { return is_taken(seeds[k][0]) || is_taken(seeds[k][1]); });
  return out;
}

template <Space S>
bool work_in(std::span<const Surroundings> surroundings, const LocalTask<S>& task,
             const LocalInput& input, Tessellation<S>& tessellation, Connectivity& mesh,
             Points3& points, std::vector<std::int32_t>& changed) {
  std::vector<std::optional<Subdomain<S>>> parts(surroundings.size());
  for_each_task(std::ssize(parts), [&](std::int64_t k) {
    const auto index = static_cast<std::size_t>(k);
    std::optional<Subdomain<S>>& part = parts[index];
    part.emplace(tessellation.cells(), mesh, points, tessellation.along(),
                 surroundings[index].triangles, input);
    if (part->movable() == 0 || !task(index, *part))
      part.reset();
  });
  std::vector<std::int32_t> rim;
  for (const std::optional<Subdomain<S>>& part : parts)
    if (part)
      part->write(mesh, points, changed, rim);
  tessellation.move(points);
  Faults faults;
  for (const std::int32_t t : rim)
    add_faults(mesh, tessellation.cells().positions(), t, faults);
  const std::optional<Repair> repaired = repair(mesh, tessellation.cells().positions(), faults);
  if (!repaired)
    return false;
  changed.insert(changed.end(), repaired->changed.begin(), repaired->changed.end());
  return true;
}

template class Subdomain<Sphere>;
template class Subdomain<Plane>;
template Evaluation descend(Subdomain<Sphere>&, const Points3&, const LocalInput&,
                            const ShapePenalty&,
                            const std::function<bool(const Evaluation&, int)>&);
template Evaluation descend(Subdomain<Plane>&, const Points3&, const LocalInput&,
                            const ShapePenalty&,
                            const std::function<bool(const Evaluation&, int)>&);
template bool work_in(std::span<const Surroundings>, const LocalTask<Sphere>&, const LocalInput&,
                      Tessellation<Sphere>&, Connectivity&, Points3&, std::vector<std::int32_t>&);
template bool work_in(std::span<const Surroundings>, const LocalTask<Plane>&, const LocalInput&,
                      Tessellation<Plane>&, Connectivity&, Points3&, std::vector<std::int32_t>&);

} // namespace calotte::cvt_detail
