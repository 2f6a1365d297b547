// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/legend_of.h"
#include "draw/plane.h"
#include "draw/values.h"

#include <calotte/voronoi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte::tools {

using Eigen::Vector2d;

namespace {

/// The power of the scene's unit in a quantity: 1 for lengths, 2 for areas, otherwise 0.
double power_of(Colouring colouring) {
  return colouring == Colouring::spacing ? 1 : colouring == Colouring::area ? 2 : 0;
}

/// The part of a segment within the window; none if it misses the window.
std::optional<std::array<Vector2d, 2>> within(const Window& window, const Vector2d& from,
                                              const Vector2d& to) {
  double first = 0;
  double last = 1;
  for (int i = 0; i < 2; ++i) {
    const double way = to[i] - from[i];
    const double enter = ((way > 0 ? window.low : window.high)[i] - from[i]) / way;
    const double leave = ((way > 0 ? window.high : window.low)[i] - from[i]) / way;
    if (way != 0) {
      first = std::max(first, enter);
      last = std::min(last, leave);
    } else if (from[i] < window.low[i] || from[i] > window.high[i]) {
      return std::nullopt;
    }
  }
  if (!(first <= last)) {
    return std::nullopt;
  }
  return std::array<Vector2d, 2>{from + first * (to - from), from + last * (to - from)};
}

/// True if two cells meet in the visible part: tests some places of their common side.
class Meeting {
public:
  Meeting(const Surface& part, const Window& window) : part_(part), window_(window) {}

  bool operator()(const Vector2d& from, const Vector2d& to) const {
    constexpr int places = 16;
    const auto side = within(window_, from, to);
    if (!side || !part_.is_bounded()) {
      return side.has_value();
    }
    for (int i = 0; i <= places; ++i) {
      const Vector2d place = (*side)[0] + (i / double(places)) * ((*side)[1] - (*side)[0]);
      if (part_.contains({place.x(), place.y(), 0})) {
        return true;
      }
    }
    return false;
  }

private:
  Surface part_;
  Window window_;
};

/// For an open mesh: mean distances to the neighbours. Neighbours are sites whose cells meet the
/// site's own inside the part; triangles reach across bays and islands.
std::vector<double> spacings(const Mesh& mesh, const Surface& part, const Scene& scene,
                             const Window& window) {
  const Meeting meet(part, window);
  const double half = window.extent().maxCoeff() / 2;
  const auto corner = [&](std::int32_t t) -> Vector2d {
    return window.middle() + half * scene.circumcentres.col(t).head<2>();
  };
  const auto sites = static_cast<std::size_t>(mesh.points.cols());
  std::vector<double> sums(sites);
  std::vector<double> counts(sites);
  for (std::int32_t t = 0; t < scene.mesh->triangles.cols(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(scene.mesh->triangles((i + 1) % 3, t));
      const auto b = static_cast<std::size_t>(scene.mesh->triangles((i + 2) % 3, t));
      const std::int32_t other = scene.mesh->neighbours(i, t);
      const bool counts_once = a < sites && b < sites;
      const bool at_seam = has_walls(mesh) && (a < sites || b < sites); // to a copy
      if (other < t || !(counts_once || at_seam) || !meet(corner(t), corner(other))) {
        continue;
      }
      const double distance = half * (scene.sites.col(static_cast<Eigen::Index>(a)) -
                                      scene.sites.col(static_cast<Eigen::Index>(b)))
                                         .norm();
      for (const std::size_t end : {a, b}) {
        if (end < sites) {
          sums[end] += distance;
          ++counts[end];
        }
      }
    }
  }
  for (std::size_t i = 0; i < sites; ++i) {
    sums[i] /= counts[i]; // NaN for a cell that meets no other
  }
  return sums;
}

} // namespace

std::vector<double> values_of_cells(const Mesh& mesh, const DrawOptions& options,
                                    const Surface& part, const std::vector<bool>& clipped,
                                    const Scene& scene, const Window& window) {
  const bool tessellated =
      options.colouring == Colouring::area || options.colouring == Colouring::quality;
  const bool periodic = mesh.closed();
  if (tessellated && periodic) {
    const Voronoi cells = voronoi(mesh);
    const DoubleVector values =
        options.colouring == Colouring::area ? cells.cell_area : cell_fields(cells).quality;
    return {values.data(), values.data() + values.size()};
  }
  if (!periodic && options.colouring == Colouring::spacing) {
    return spacings(mesh, part, scene, window);
  }
  const Drawn own(mesh);
  const Scene own_scene = scene_of(own, Shapes::cells, window);
  // In a box the values of copies are used as well as the sites' own.
  DoubleVector given = by_site(mesh, options);
  std::vector<double> values;
  if (periodic) {
    given.conservativeResize(given.size() > 0 ? scene.sites.cols() : 0);
    values = values_of(scene, options.colouring, given);
    values.resize(static_cast<std::size_t>(mesh.points.cols()));
  } else {
    values = values_of(own_scene, options.colouring, given, clipped);
  }
  const double unit = std::pow(window.extent().maxCoeff() / 2, power_of(options.colouring));
  std::for_each(values.begin(), values.end(), [unit](double& value) { value *= unit; });
  return values;
}

std::vector<bool> by_place(const Drawn& drawn, const std::vector<bool>& by_site) {
  std::vector<bool> result(by_site.empty() ? 0 : drawn.site.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = drawn.site[i] < 0 || by_site[static_cast<std::size_t>(drawn.site[i])];
  }
  return result;
}

std::vector<double> values_of_triangles(const Mesh& mesh, const DrawOptions& options,
                                        const std::vector<bool>& clipped, const Drawn& drawn,
                                        const Scene& scene, const Window& window) {
  const DoubleVector given = by_site(mesh, options);
  DoubleVector of_places(given.size() > 0 ? scene.sites.cols() : 0);
  for (Eigen::Index i = 0; i < of_places.size(); ++i) {
    of_places[i] = given[drawn.site[static_cast<std::size_t>(i)]];
  }
  std::vector<double> values =
      values_of(scene, options.colouring, of_places, by_place(drawn, clipped));
  const double unit = std::pow(window.extent().maxCoeff() / 2, power_of(options.colouring));
  std::for_each(values.begin(), values.end(), [unit](double& value) { value *= unit; });
  return values;
}

} // namespace calotte::tools
