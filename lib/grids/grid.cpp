// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/grid.h>

#include "base/require.h"
#include "cvt/cvt.h"
#include "cvt/shape.h"
#include "cvt/stages.h"
#include "domain/surface.h"
#include "grids/start.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>

namespace calotte {
namespace {

using namespace grids_detail;

constexpr std::array<NamedValue<CvtStart::Kind>, 11> starts{
    {{"automatic", CvtStart::Kind::automatic},
     {"points", CvtStart::Kind::points},
     {"multilevel", CvtStart::Kind::multilevel},
     {"continuation", CvtStart::Kind::continuation},
     {"density", CvtStart::Kind::density},
     {"random", CvtStart::Kind::random},
     {"fibonacci", CvtStart::Kind::fibonacci},
     {"spiral", CvtStart::Kind::spiral},
     {"icosahedron", CvtStart::Kind::icosahedron},
     {"geodesic", CvtStart::Kind::geodesic},
     {"hexagonal", CvtStart::Kind::hexagonal}}};

constexpr std::array<NamedValue<CvtAction::Kind>, 6> actions{
    {{"start", CvtAction::Kind::start},
     {"bisect", CvtAction::Kind::bisect},
     {"insert", CvtAction::Kind::insert},
     {"converge", CvtAction::Kind::converge},
     {"polish", CvtAction::Kind::polish},
     {"raise", CvtAction::Kind::raise}}};

constexpr std::array<NamedValue<Norm>, 5> norms{{{"l2", Norm::l2},
                                                 {"linf", Norm::linf},
                                                 {"l2-scaled", Norm::l2_scaled},
                                                 {"linf-scaled", Norm::linf_scaled},
                                                 {"none", Norm::none}}};

constexpr std::array<NamedValue<Method>, 4> methods{{{"auto", Method::automatic},
                                                     {"lloyd", Method::lloyd},
                                                     {"lbfgs", Method::lbfgs},
                                                     {"lbfgs-laplacian", Method::lbfgs_laplacian}}};

constexpr std::array<NamedValue<Boundary>, 2> boundaries{
    {{"clip", Boundary::clip}, {"generators", Boundary::generators}}};

/// The fixed generators, then the free ones.
Points3 generators(const Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  Points3 free =
      recipe.start.kind == CvtStart::Kind::points ? recipe.start.points : free_generators(schedule);
  if (recipe.fixed.cols() == 0)
    return free;
  Points3 all(3, recipe.fixed.cols() + free.cols());
  all << recipe.fixed, free;
  return all;
}

/// The number of CvtReport::off_boundary.
std::int64_t off_boundary(const Mesh& mesh, const Schedule& schedule) {
  const std::vector<std::int32_t>& next = schedule.next_on_boundary;
  std::int64_t outer = 0, away = 0;
  for (Eigen::Index t = 0; !next.empty() && t < mesh.triangles.cols(); ++t)
    for (int v = 0; v < 3; ++v) {
      if (mesh.neighbours(v, t) >= 0)
        continue;
      const std::int32_t from = mesh.triangles((v + 1) % 3, t), to = mesh.triangles((v + 2) % 3, t);
      ++outer;
      away += from >= std::ssize(next) || next[static_cast<std::size_t>(from)] != to;
    }
  const auto on_boundary = std::ranges::count_if(next, [](std::int32_t to) { return to >= 0; });
  return std::max(away, std::abs(outer - on_boundary));
}

/// Refuses, before any work, a schedule that plan() has not made.
void require_schedule(const Schedule& schedule) {
  const Recipe& recipe = schedule.recipe;
  base_detail::require(cvt_detail::are_actions(schedule.actions, recipe.fixed.cols()) &&
                           cvt_detail::is_least_spacing(recipe.stop.least_spacing) &&
                           cvt_detail::is_most_off_midpoint(recipe.stop.most_off_midpoint),
                       "the schedule lacks choices; give one of plan()");
}

CvtCallback callback_of(const ProgressCallback& progress) {
  if (!progress)
    return {};
  return [&progress](const CvtProgress& now) {
    const ProgressReply next = progress({.stage = "descend", .run = &now});
    if (next == ProgressReply::cancel)
      throw Error(ErrorCode::cancelled, "the progress callback cancelled the run");
    return next == ProgressReply::stop;
  };
}

} // namespace

Cvt make_grid(const Schedule& schedule, RunOptions run) {
  require_schedule(schedule);
  const cvt_detail::Execution execution{.decomposition = run.decomposition};
  const CvtCallback callback = callback_of(run.progress);
  Cvt grid = run.state ? cvt(std::move(*run.state), schedule, execution, callback)
                       : cvt(generators(schedule), schedule, execution, callback);
  grid.report.off_boundary = off_boundary(grid.mesh, schedule);
  return grid;
}

Cvt make_grid(const Recipe& recipe, RunOptions options) {
  return make_grid(plan(recipe), std::move(options));
}

std::span<const NamedValue<CvtStart::Kind>> start_words() { return starts; }
std::span<const NamedValue<Norm>> norm_words() { return norms; }
std::span<const NamedValue<Method>> method_words() { return methods; }
std::span<const NamedValue<Boundary>> boundary_words() { return boundaries; }

std::string_view word_of(CvtStart::Kind kind) {
  return std::ranges::find(starts, kind, &NamedValue<CvtStart::Kind>::value)->word;
}

std::span<const NamedValue<CvtAction::Kind>> action_words() { return actions; }

std::string_view word_of(CvtAction::Kind kind) {
  return std::ranges::find(actions, kind, &NamedValue<CvtAction::Kind>::value)->word;
}

std::string_view word_of(Norm norm) {
  return std::ranges::find(norms, norm, &NamedValue<Norm>::value)->word;
}

} // namespace calotte
