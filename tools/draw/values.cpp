// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/values.h"

#include "text/text.h"

#include <calotte/voronoi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace calotte::tools {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::vector<bool> closed_stars(const Scene& scene) {
  std::vector<bool> closed(static_cast<std::size_t>(scene.sites.cols()));
  for (std::size_t i = 0; i < closed.size(); ++i) {
    closed[i] = around(scene, static_cast<std::int64_t>(i), [](std::int32_t) {});
  }
  return closed;
}

/// The valence furthest from 6 among a triangle's corners. A corner at a boundary has none.
double oddest_valence(const Corners& corners, const std::vector<double>& valence) {
  double furthest = 6;
  for (const int id : corners.id) {
    const double v = valence[static_cast<std::size_t>(id)];
    const bool counts = v > 0; // not NaN
    furthest = counts && std::abs(v - 6) > std::abs(furthest - 6) ? v : furthest;
  }
  return furthest;
}

double triangle_value(const Corners& corners, Colouring colouring,
                      const std::vector<double>& valence, const DoubleVector& by_site) {
  switch (colouring) {
  case Colouring::spacing:
    return corners.mean_side();
  case Colouring::angle:
    return corners.smallest_angle();
  case Colouring::area:
    return corners.area();
  case Colouring::quality:
    return corners.quality();
  case Colouring::density:
  case Colouring::field:
    return (by_site[corners.id[0]] + by_site[corners.id[1]] + by_site[corners.id[2]]) / 3;
  case Colouring::region:
    return std::max({by_site[corners.id[0]], by_site[corners.id[1]], by_site[corners.id[2]]});
  case Colouring::valence:
  case Colouring::none:
    break;
  }
  return oddest_valence(corners, valence);
}

bool is_outside(const Scene& scene, Eigen::Index triangle) {
  return !scene.outside.empty() && scene.outside[static_cast<std::size_t>(triangle)];
}

std::vector<double> smallest_angles(const Scene& scene) {
  std::vector<double> values(static_cast<std::size_t>(scene.sites.cols()), nothing);
  for (Eigen::Index t = 0; t < scene.mesh->triangles.cols(); ++t) {
    const Corners corners(scene, t);
    const double smallest = is_outside(scene, t) ? nothing : corners.smallest_angle();
    for (const int id : corners.id) {
      double& value = values[static_cast<std::size_t>(id)];
      value = std::fmin(value, smallest);
    }
  }
  return values;
}

std::vector<double> as_vector(const DoubleVector& values) {
  return {values.data(), values.data() + values.size()};
}

std::vector<double> tessellation_values(const Scene& scene, Colouring colouring) {
  const bool area = colouring == Colouring::area;
  if (scene.polygons != nullptr) {
    return area ? as_vector(areas(*scene.polygons)) : as_vector(side_ratios(*scene.polygons));
  }
  if (!scene.mesh->closed()) {
    require_closed_cells(colouring);
  }
  const Voronoi tessellation = voronoi(*scene.mesh);
  return as_vector(area ? tessellation.cell_area : cell_fields(tessellation).quality);
}

std::vector<double> cell_values(const Scene& scene, Colouring colouring,
                                const std::vector<double>& valence, const DoubleVector& by_site) {
  switch (colouring) {
  case Colouring::spacing:
    return mean_distances(scene);
  case Colouring::angle:
    return smallest_angles(scene);
  case Colouring::area:
  case Colouring::quality:
    return tessellation_values(scene, colouring);
  case Colouring::density:
  case Colouring::field:
  case Colouring::region:
    return as_vector(by_site);
  case Colouring::valence:
  case Colouring::none:
    break;
  }
  return valence;
}

} // namespace

void require_closed_cells(Colouring colouring) {
  if (colouring == Colouring::area || colouring == Colouring::quality) {
    refuse(std::string("the mesh has an open boundary, so that its cells have no ") +
           (colouring == Colouring::area ? "area" : "quality") +
           "; colour its triangles, or cells by spacing");
  }
}

DoubleVector side_ratios(const Polygons& cells) {
  DoubleVector ratios = DoubleVector::Constant(cells.size(), nothing);
  for (std::int64_t i = 0; i < cells.size(); ++i) {
    double shortest = HUGE_VAL, longest = 0;
    const auto ids = cells.ids[i];
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::int32_t next = ids[(k + 1) % ids.size()];
      const double side = (cells.corners.col(ids[k]) - cells.corners.col(next)).norm();
      shortest = std::min(shortest, side);
      longest = std::max(longest, side);
    }
    if (longest > 0)
      ratios[i] = shortest / longest;
  }
  return ratios;
}

std::vector<double> mean_distances(const Scene& scene) {
  std::vector<double> sums(static_cast<std::size_t>(scene.sites.cols()));
  std::vector<double> counts(sums.size());
  // Each edge is visited in two triangles, or counts twice.
  for (Eigen::Index t = 0; t < scene.mesh->triangles.cols(); ++t) {
    const Corners corners(scene, t);
    for (int i = 0; i < 3; ++i) {
      const double weight = scene.mesh->neighbours((i + 2) % 3, t) < 0 ? 2 : 1;
      for (const int end : {corners.id[i], corners.id[(i + 1) % 3]}) {
        sums[static_cast<std::size_t>(end)] += weight * corners.side(i);
        counts[static_cast<std::size_t>(end)] += weight;
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    sums[i] /= counts[i];
  }
  return sums;
}

std::vector<double> site_valences(const Scene& scene, const std::vector<bool>& clipped) {
  std::vector<double> count(static_cast<std::size_t>(scene.sites.cols()));
  for (Eigen::Index t = 0; t < scene.mesh->triangles.cols(); ++t) {
    for (const std::int32_t site : scene.mesh->triangles.col(t)) {
      ++count[static_cast<std::size_t>(site)];
    }
  }
  if (const Polygons* polygons = scene.polygons; polygons != nullptr && !scene.flat) {
    for (std::size_t i = 0; i < count.size(); ++i) {
      count[i] = static_cast<double>(polygons->ids.count(static_cast<std::int64_t>(i)));
    }
    return count;
  }
  const std::vector<bool> closed = closed_stars(scene);
  for (std::size_t i = 0; i < count.size(); ++i) {
    if (!closed[i] || (!clipped.empty() && clipped[i])) {
      count[i] = scene.flat ? boundary_valence : nothing;
    }
  }
  return count;
}

std::vector<double> values_of(const Scene& scene, Colouring colouring, const DoubleVector& by_site,
                              const std::vector<bool>& clipped) {
  const std::vector<double> valence = site_valences(scene, clipped);
  if (scene.shapes == Shapes::cells) {
    std::vector<double> values = cell_values(scene, colouring, valence, by_site);
    if (scene.flat || scene.polygons != nullptr) {
      return values;
    }
    const std::vector<bool> closed = closed_stars(scene);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = closed[i] ? values[i] : nothing;
    }
    return values;
  }
  std::vector<double> values(static_cast<std::size_t>(scene.count()));
  for (std::size_t t = 0; t < values.size(); ++t) {
    const Corners corners(scene, static_cast<Eigen::Index>(t));
    values[t] = is_outside(scene, static_cast<Eigen::Index>(t))
                    ? nothing
                    : triangle_value(corners, colouring, valence, by_site);
  }
  return values;
}

} // namespace calotte::tools
