// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/kept_states.h"

#include <calotte/delaunay.h>
#include <calotte/write.h>

#include <algorithm>
#include <filesystem>

namespace calotte::tools {
namespace {

constexpr std::size_t digits = 6;

/// "out/grid.000010.vtp".
std::filesystem::path path_of(const std::string& mesh, std::size_t evaluation) {
  const std::string number = std::to_string(evaluation);
  return std::filesystem::path(mesh).replace_extension(
      std::string(digits - std::min(digits, number.size()), '0') + number + ".vtp");
}

} // namespace

KeptStates::KeptStates(const CvtRequest& request, const std::optional<PlanarDomain>& domain,
                       std::size_t before)
    : mesh_(request.mesh), domain_(domain),
      every_(static_cast<std::size_t>(request.keep_every.value_or(0))), last_(before) {
  for (std::size_t k = 1; every_ > 0 && k <= before; ++k)
    if (const std::filesystem::path path = path_of(mesh_, k); std::filesystem::exists(path))
      states_.push_back({static_cast<std::int64_t>(k), path.filename()});
}

bool KeptStates::due(const CvtReport& report) const {
  return every_ > 0 && report.iterations.size() >= last_ + every_;
}

void KeptStates::keep(const CvtState& state) {
  last_ = state.report().iterations.size();
  const std::filesystem::path path = path_of(mesh_, last_);
  const Points3 points = state.points();
  if (!domain_)
    write(path, spherical_delaunay(points));
  else if (domain_->periodic())
    write(path, periodic_delaunay(points.topRows<2>(), domain_->period));
  else
    write(path, planar_delaunay(points.topRows<2>()));
  states_.push_back({static_cast<std::int64_t>(last_), path.filename()});
}

} // namespace calotte::tools
