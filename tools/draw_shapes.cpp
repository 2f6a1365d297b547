// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace calotte::tools {

namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Unit, for norms whose squares under- or overflow, too.
Vector3d direction(const Vector3d& p) {
  const double largest = p.cwiseAbs().maxCoeff();
  return largest > 0 && std::isfinite(largest) ? Vector3d((p / largest).normalized())
                                               : Vector3d(Vector3d::Zero());
}

/// Its rows are the viewer's right, up and towards.
Eigen::Matrix3d frame_of(const LonLat& view) {
  const double lon = view.longitude * degree;
  const double lat = view.latitude * degree;
  Eigen::Matrix3d frame;
  frame.row(0) << -std::sin(lon), std::cos(lon), 0;
  frame.row(1) << -std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat);
  frame.row(2) << std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat);
  return frame;
}

double arc(const Vector3d& a, const Vector3d& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

/// The angle at `a` of the spherical triangle abc.
double angle_at(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = a.cross(b);
  const Vector3d v = a.cross(c);
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// One triangle's corners, and what the loops below want of it.
struct Corners {
  Corners(const Scene& scene, Eigen::Index t)
      : id(scene.mesh->triangles.col(t)), at{scene.sites.col(id[0]), scene.sites.col(id[1]),
                                             scene.sites.col(id[2])} {}
  double side(int i) const { return arc(at[i], at[(i + 1) % 3]); }
  double angle(int i) const { return angle_at(at[i], at[(i + 1) % 3], at[(i + 2) % 3]); }
  double smallest_angle() const { return std::min({angle(0), angle(1), angle(2)}); }
  double mean_side() const { return (side(0) + side(1) + side(2)) / 3; }
  double area() const { return 0.5 * (at[1] - at[0]).cross(at[2] - at[0]).norm(); }

  Eigen::Vector3i id;
  Vector3d at[3];
};

/// The triangles around a site, counter-clockwise, one call each; false when the star is open.
bool around(const Scene& scene, std::int64_t site, const std::function<void(std::int32_t)>& visit) {
  const std::int32_t first = scene.triangle_of[static_cast<std::size_t>(site)];
  std::int32_t t = first;
  while (t >= 0) {
    visit(t);
    int corner = 0;
    while (scene.mesh->triangles(corner, t) != site) {
      ++corner;
    }
    t = scene.mesh->neighbours((corner + 1) % 3, t);
    if (t == first) {
      return true;
    }
  }
  return false;
}

std::vector<bool> closed_stars(const Scene& scene) {
  std::vector<bool> closed(static_cast<std::size_t>(scene.sites.cols()));
  for (std::size_t i = 0; i < closed.size(); ++i) {
    closed[i] = around(scene, static_cast<std::int64_t>(i), [](std::int32_t) {});
  }
  return closed;
}

std::vector<int> valences(const Scene& scene) {
  std::vector<int> count(static_cast<std::size_t>(scene.sites.cols()));
  for (Eigen::Index t = 0; t < scene.mesh->triangles.cols(); ++t) {
    for (const std::int32_t site : scene.mesh->triangles.col(t)) {
      ++count[static_cast<std::size_t>(site)];
    }
  }
  return count;
}

double triangle_value(const Scene& scene, Eigen::Index t, Colouring colouring,
                      const std::vector<int>& valence) {
  const Corners corners(scene, t);
  if (colouring == Colouring::spacing) {
    return corners.mean_side();
  }
  if (colouring == Colouring::angle) {
    return corners.smallest_angle();
  }
  int furthest = 6;
  for (const int id : corners.id) {
    const int v = valence[static_cast<std::size_t>(id)];
    furthest = std::abs(v - 6) > std::abs(furthest - 6) ? v : furthest;
  }
  return furthest;
}

std::vector<double> cell_values(const Scene& scene, Colouring colouring,
                                const std::vector<int>& valence) {
  const bool least = colouring == Colouring::angle;
  std::vector<double> values(valence.size(), least ? std::numbers::pi : 0);
  for (Eigen::Index t = 0; colouring != Colouring::valence && t < scene.mesh->triangles.cols();
       ++t) {
    const Corners corners(scene, t);
    const double smallest = least ? corners.smallest_angle() : 0;
    for (int i = 0; i < 3; ++i) {
      double& value = values[static_cast<std::size_t>(corners.id[i])];
      // Around a closed star each neighbour is the next corner of one triangle.
      value = least ? std::min(value, smallest) : value + corners.side(i);
    }
  }
  const std::vector<bool> closed = closed_stars(scene);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!closed[i]) {
      values[i] = nothing;
    } else if (colouring == Colouring::spacing) {
      values[i] /= valence[i];
    } else if (colouring == Colouring::valence) {
      values[i] = valence[i];
    }
  }
  return values;
}

} // namespace

Scene make_scene(const Mesh& mesh, Shapes shapes, const LonLat& view) {
  Scene scene;
  scene.mesh = &mesh;
  scene.shapes = shapes;
  const Eigen::Matrix3d frame = frame_of(view);
  scene.sites.resize(3, mesh.points.cols());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    scene.sites.col(i) = frame * direction(mesh.points.col(i));
  }
  scene.triangle_of.assign(static_cast<std::size_t>(mesh.points.cols()), -1);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    for (const std::int32_t site : mesh.triangles.col(t)) {
      scene.triangle_of[static_cast<std::size_t>(site)] = static_cast<std::int32_t>(t);
    }
  }
  if (shapes == Shapes::cells) {
    scene.circumcentres.resize(3, mesh.triangles.cols());
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
      const Corners c(scene, t);
      scene.circumcentres.col(t) = direction((c.at[1] - c.at[0]).cross(c.at[2] - c.at[0]));
    }
  }
  return scene;
}

LonLat middle(const Mesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    sum += direction(mesh.points.col(i));
  }
  return {std::atan2(sum.y(), sum.x()) / degree,
          std::atan2(sum.z(), std::hypot(sum.x(), sum.y())) / degree};
}

void outline_of(const Scene& scene, std::int64_t shape, std::vector<Vector3d>& corners) {
  corners.clear();
  if (scene.shapes == Shapes::triangles) {
    for (const std::int32_t site : scene.mesh->triangles.col(shape)) {
      corners.emplace_back(scene.sites.col(site));
    }
    return;
  }
  const auto add = [&](std::int32_t t) { corners.emplace_back(scene.circumcentres.col(t)); };
  if (!around(scene, shape, add)) {
    corners.clear();
  }
}

std::vector<double> values_of(const Scene& scene, Colouring colouring) {
  const std::vector<int> valence = valences(scene);
  if (scene.shapes == Shapes::cells) {
    return cell_values(scene, colouring, valence);
  }
  std::vector<double> values(static_cast<std::size_t>(scene.count()));
  for (std::size_t t = 0; t < values.size(); ++t) {
    values[t] = triangle_value(scene, static_cast<Eigen::Index>(t), colouring, valence);
  }
  return values;
}

std::vector<float> widths_of(const Scene& scene) {
  std::vector<double> areas(static_cast<std::size_t>(scene.count()));
  for (Eigen::Index t = 0; t < scene.mesh->triangles.cols(); ++t) {
    const Corners corners(scene, t);
    if (scene.shapes == Shapes::triangles) {
      areas[static_cast<std::size_t>(t)] = corners.area();
      continue;
    }
    for (const int id : corners.id) {
      areas[static_cast<std::size_t>(id)] += corners.area() / 3;
    }
  }
  std::vector<float> widths(areas.size());
  std::transform(areas.begin(), areas.end(), widths.begin(),
                 [](double area) { return static_cast<float>(std::sqrt(area)); });
  return widths;
}

} // namespace calotte::tools
