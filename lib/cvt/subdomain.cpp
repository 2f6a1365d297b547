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
#include <tuple>
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
                        std::vector<std::int32_t> triangles, const LocalInput& input)
    : cells_(cells), integrand_(input.integrand), density_(input.density),
      triangles_(std::move(triangles)) {
  sort_by_sites(triangles_, mesh.triangles);
  take_triangles(mesh);
  number_sites(input);
  points_.resize(3, movable());
  for (std::int32_t i = 0; i < movable(); ++i)
    points_.col(i) = points.col(sites_[static_cast<std::size_t>(i)]);
  x_ = Array<Vec3>(std::ssize(sites_));
  for (std::int64_t i = 0; i < x_.size(); ++i)
    x_[i] = cells_.place(sites_[static_cast<std::size_t>(i)]);
  moments_ = Array<CellMoments>(x_.size());
  set_patch();
}

/// Copies the triangles, from their lowest sites on, with local neighbours.
template <Space S> void Subdomain<S>::take_triangles(const Connectivity& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> local; // by number in the mesh
  for (std::size_t k = 0; k < triangles_.size(); ++k)
    local.emplace_back(triangles_[k], static_cast<std::int32_t>(k));
  std::sort(local.begin(), local.end());
  const auto count = static_cast<Eigen::Index>(triangles_.size());
  mesh_.triangles.resize(3, count);
  mesh_.neighbours.resize(3, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::int32_t t = triangles_[static_cast<std::size_t>(k)];
    int w = 0;
    mesh.triangles.col(t).minCoeff(&w);
    for (int v = 0; v < 3; ++v, w = next_vertex(w)) {
      const std::int32_t u = mesh.neighbours(w, t);
      const auto at = std::lower_bound(local.begin(), local.end(), std::pair{u, 0});
      const bool inside = at != local.end() && at->first == u;
      mesh_.triangles(v, k) = mesh.triangles(w, t);
      mesh_.neighbours(v, k) = inside ? at->second : -1;
      if (!inside)
        rim_.push_back(
            {t, w, mesh.triangles(next_vertex(w), t), mesh.triangles(previous_vertex(w), t)});
    }
  }
}

/// Replaces the numbers of sites in the mesh by local ones: first those that move, then the others.
template <Space S> void Subdomain<S>::number_sites(const LocalInput& input) {
  const auto make_unique = [](std::vector<std::int32_t>& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  const auto all = mesh_.triangles.reshaped();
  sites_.assign(all.begin(), all.end());
  make_unique(sites_);
  std::vector<std::int32_t> stay;
  for (const Rim& rim : rim_)
    stay.push_back(rim.from);
  for (const std::int32_t site : sites_)
    if (site >= cells_.generator_count() ||
        (!input.fixed.empty() && input.fixed[static_cast<std::size_t>(site)] != 0))
      stay.push_back(site);
  make_unique(stay);
  std::vector<std::int32_t> move;
  std::set_difference(sites_.begin(), sites_.end(), stay.begin(), stay.end(),
                      std::back_inserter(move));
  const auto local = [&](std::int32_t site) {
    const auto moving = std::lower_bound(move.begin(), move.end(), site);
    if (moving != move.end() && *moving == site)
      return static_cast<std::int32_t>(moving - move.begin());
    const auto staying = std::lower_bound(stay.begin(), stay.end(), site);
    return static_cast<std::int32_t>(std::ssize(move) + (staying - stay.begin()));
  };
  for (std::int32_t& site : mesh_.triangles.reshaped())
    site = local(site);
  for (Rim& rim : rim_)
    rim.from = local(rim.from), rim.to = local(rim.to);
  std::sort(rim_.begin(), rim_.end(), [](const Rim& a, const Rim& b) {
    return std::tie(a.from, a.to) < std::tie(b.from, b.to);
  });
  patch_.owned = static_cast<std::int32_t>(move.size());
  sites_ = std::move(move);
  sites_.insert(sites_.end(), stay.begin(), stay.end());
  patch_.sites = sites_;
  generators_ = std::count_if(sites_.begin(), sites_.end(),
                              [&](std::int32_t site) { return site < cells_.generator_count(); });
  stays_.assign(sites_.size(), 1);
  std::fill_n(stays_.begin(), patch_.owned, 0);
}

template <Space S> void Subdomain<S>::set_patch() {
  patch_.triangles.clear();
  for (std::int32_t t = 0; t < mesh_.triangles.cols(); ++t)
    if (mesh_.triangles.col(t).minCoeff() < patch_.owned)
      patch_.triangles.push_back(t);
  sort_by_sites(patch_.triangles, mesh_.triangles);
  patch_.corners.clear();
  for (const std::int32_t t : patch_.triangles)
    patch_.corners.push_back(sites_from_lowest(mesh_.triangles, t));
}

/// Integrates over the cells, with flips where the mesh is not Delaunay; false if they do not
/// suffice.
template <Space S> bool Subdomain<S>::integrate() {
  constexpr int most_repairs = 4;
  const PlacedSites<S> placed{cells_.space(), {x_.begin(), sites_.size()}};
  std::optional<Connectivity> before;
  for (int repairs = 0;; ++repairs) {
    suspects_.clear();
    cells_.integrate(integrand_, patch_, x_, moments_, suspects_);
    Faults faults;
    for (const std::int32_t suspect : suspects_)
      add_faults(mesh_, placed, patch_.triangles[static_cast<std::size_t>(suspect)], faults);
    if (faults.none())
      return true;
    if (!before)
      before = mesh_;
    const bool sound = repairs < most_repairs && repair(mesh_, placed, faults);
    if (!sound)
      mesh_ = std::move(*before);
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
  iteration.l2 = std::sqrt(iteration.l2 / movable());
  iteration.linf = std::sqrt(iteration.linf);
  iteration.gradient = std::sqrt(iteration.gradient);
  out.penalty = 0;
  if (penalty_.factor > 0)
    add_penalty(out);
}

template <Space S> void Subdomain<S>::add_penalty(Evaluation& out) {
  DoubleVector inverse_spacing(generators_);
  density_(x_.begin(), generators_, inverse_spacing.data());
  inverse_spacing = inverse_spacing.cwiseSqrt().cwiseSqrt() / penalty_.spacing;
  const ShapeInput<S> input{placed(), inverse_spacing, penalty_.limits, stays_};
  Points3 gradient = Points3::Zero(3, x_.size());
  gradient.leftCols(movable()) = out.gradient;
  out.shapes = add_shape_terms(input, distorted(input), penalty_.factor, gradient);
  out.gradient = gradient.leftCols(movable());
  make_tangential(out.gradient, points_, {0, movable()});
  out.penalty = penalty_.factor * out.shapes.value;
  out.iteration.shape_excess = out.shapes.worst;
}

template <Space S>
void Subdomain<S>::set_centroids(const Points3& points, const Evaluation& at, Points3& to) const {
  to.resize(3, movable());
  for (std::int32_t i = 0; i < movable(); ++i)
    set_column(to, i, Cells<S>::centroid(column(points, i), column(at.gradient, i), at.mass[i]));
}

/// The triangle beyond an edge of the subdomain.
template <Space S>
std::int32_t Subdomain<S>::beyond(const std::vector<std::int32_t>& outside, std::int32_t from,
                                  std::int32_t to) const {
  const auto at = std::lower_bound(
      rim_.begin(), rim_.end(), std::pair{from, to}, [](const Rim& rim, const auto& ends) {
        return std::tie(rim.from, rim.to) < std::tie(ends.first, ends.second);
      });
  return outside[static_cast<std::size_t>(at - rim_.begin())];
}

template <Space S>
void Subdomain<S>::write(Connectivity& mesh, Points3& points, std::vector<std::int32_t>& changed,
                         std::vector<std::int32_t>& rim) const {
  for (std::int32_t i = 0; i < movable(); ++i)
    points.col(sites_[static_cast<std::size_t>(i)]) = points_.col(i);
  // integrate() tests edges inside, from the triangles with a generator that moves.
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const auto local = static_cast<Eigen::Index>(k);
    if (mesh_.triangles.col(local).minCoeff() >= movable() ||
        mesh_.neighbours.col(local).minCoeff() < 0)
      rim.push_back(triangles_[k]);
  }
  for (const Rim& edge : rim_)
    if (const std::int32_t out = mesh.neighbours(edge.across, edge.triangle); out >= 0)
      rim.push_back(out);
  if (!flipped_)
    return;
  std::vector<std::int32_t> outside; // by edge: another subdomain may have changed it
  for (const Rim& edge : rim_)
    outside.push_back(mesh.neighbours(edge.across, edge.triangle));
  for (std::size_t k = 0; k < triangles_.size(); ++k) {
    const std::int32_t t = triangles_[k];
    const auto local = static_cast<std::int32_t>(k);
    for (int v = 0; v < 3; ++v) {
      const std::int32_t u = mesh_.neighbours(v, local);
      mesh.triangles(v, t) = sites_[static_cast<std::size_t>(mesh_.triangles(v, local))];
      if (u >= 0) {
        mesh.neighbours(v, t) = triangles_[static_cast<std::size_t>(u)];
        continue;
      }
      const std::int32_t from = mesh_.triangles(next_vertex(v), local),
                         to = mesh_.triangles(previous_vertex(v), local),
                         out = beyond(outside, from, to);
      mesh.neighbours(v, t) = out;
      for (int w = 0; out >= 0 && w < 3; ++w)
        if (mesh.triangles(next_vertex(w), out) == sites_[static_cast<std::size_t>(to)] &&
            mesh.triangles(previous_vertex(w), out) == sites_[static_cast<std::size_t>(from)])
          mesh.neighbours(w, out) = t;
    }
    changed.push_back(t);
  }
}

template <Space S>
Evaluation descend(Subdomain<S>& part, const Points3& start, const LocalInput& input,
                   const ShapePenalty& penalty,
                   const std::function<bool(const Evaluation&, int)>& ended) {
  CvtOptions options;
  options.density = input.density;
  options.method = Method::lbfgs;
  options.norm = Norm::none;
  State state;
  state.points = start;
  state.penalty = penalty.factor;
  part.penalise(penalty);
  Descent descent(state, options, part);
  descent.begin();
  while (descent.here().iteration.energy < infinite && !state.stuck &&
         !ended(descent.here(), state.iterations_of_level))
    descent.step();
  if (!state.report.iterations.back().accepted)
    descent.restart(); // the subdomain is at a trial
  Evaluation last;
  last.iteration = descent.here().iteration;
  last.penalty = descent.here().penalty;
  last.shapes = descent.here().shapes;
  return last;
}

ChosenSurroundings choose_surroundings(const Connectivity& mesh,
                                       std::span<const std::array<std::int32_t, 2>> seeds) {
  constexpr int reach = 13; // steps, as wide as half as many cells
  std::vector<std::vector<std::int32_t>> around(seeds.size());
  for_each_task(std::ssize(seeds), [&](std::int64_t k) {
    const auto seed = static_cast<std::size_t>(k);
    around[seed] = triangles_around(mesh, seeds[seed], reach);
  });
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(mesh.triangles.cols()), 0);
  const auto is_taken = [&](std::int32_t t) { return taken[static_cast<std::size_t>(t)] != 0; };
  ChosenSurroundings out;
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
    const auto place = static_cast<std::size_t>(k);
    std::optional<Subdomain<S>>& part = parts[place];
    part.emplace(tessellation.cells(), mesh, points, surroundings[place].triangles, input);
    if (part->movable() == 0 || !task(place, *part))
      part.reset();
  });
  std::vector<std::int32_t> rim;
  for (const std::optional<Subdomain<S>>& part : parts)
    if (part)
      part->write(mesh, points, changed, rim);
  tessellation.move(points);
  Faults faults;
  for (const std::int32_t t : rim)
    add_faults(mesh, tessellation.cells().placed(), t, faults);
  const std::optional<Repair> repaired = repair(mesh, tessellation.cells().placed(), faults);
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
