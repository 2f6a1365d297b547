// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/kept_states.h"

#include "text/text.h"

#include <calotte/delaunay.h>
#include <calotte/write.h>

#include <cmath>
#include <filesystem>

namespace calotte::tools {
namespace {

/// "out/grid.000010.vtp"; a periodic box requires ".nc", which holds its periods.
std::filesystem::path path_of(const std::string& mesh, std::size_t evaluation, bool periodic) {
  return std::filesystem::path(mesh).replace_extension(
      formatted(periodic ? "%06.0f.nc" : "%06.0f.vtp", static_cast<double>(evaluation)));
}

/// The copies in the box of points that may have left it.
Points2 in_box(Points2 points, const Eigen::Vector2d& period) {
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index k = 0; k < 2; ++k) {
      double& x = points(k, i);
      x -= std::floor(x / period[k]) * period[k];
      if (!(x >= 0 && x < period[k])) // after rounding
        x = 0;
    }
  return points;
}

} // namespace

KeptStates::KeptStates(const CvtRequest& request, const Surface& surface, std::size_t before)
    : mesh_(request.mesh), surface_(surface),
      every_(static_cast<std::size_t>(request.keep_every.value_or(0))), last_(before) {
  for (std::size_t k = 1; every_ > 0 && k <= before; ++k)
    if (const std::filesystem::path path = path_of(mesh_, k, surface_.is_box());
        std::filesystem::exists(path))
      states_.push_back({static_cast<std::int64_t>(k), path.filename()});
}

bool KeptStates::due(const CvtReport& report) const {
  return every_ > 0 && report.iterations.size() >= last_ + every_;
}

void KeptStates::keep(const CvtState& state) {
  last_ = state.report().iterations.size();
  const std::filesystem::path path = path_of(mesh_, last_, surface_.is_box());
  const Points3 points = state.points();
  if (surface_.is_sphere())
    write(path, delaunay(points));
  else if (surface_.is_box())
    write(path, delaunay(in_box(points.topRows<2>(), surface_.period()), surface_),
          {.format = Format::mpas_minimal});
  else
    write(path, delaunay(points, Surface::plane()));
  states_.push_back({static_cast<std::int64_t>(last_), path.filename()});
}

} // namespace calotte::tools
