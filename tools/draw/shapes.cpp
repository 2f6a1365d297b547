// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/shapes.h"

#include <calotte/generators.h>

#include <algorithm>
#include <cmath>

namespace calotte::tools {

namespace {

using Eigen::Vector3d;

double arc(const Vector3d& a, const Vector3d& b) {
  return 2 * std::atan2((a - b).norm(), (a + b).norm());
}

double flat_angle(const Vector3d& u, const Vector3d& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// The angle at `a` of the spherical triangle abc.
double angle_at(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d u = a.cross(b);
  const Vector3d v = a.cross(c);
  return flat_angle(u, v);
}

/// Sets the values that follow from the positions of the sites: a triangle for each, and on the
/// sphere the circumcentres.
void link(Scene& scene) {
  const Mesh& mesh = *scene.mesh;
  scene.triangle_of.assign(static_cast<std::size_t>(scene.sites.cols()), -1);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    for (const std::int32_t site : mesh.triangles.col(t)) {
      scene.triangle_of[static_cast<std::size_t>(site)] = static_cast<std::int32_t>(t);
    }
  }
  if (scene.shapes != Shapes::cells || scene.flat) {
    return;
  }
  scene.circumcentres.resize(3, mesh.triangles.cols());
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Corners c(scene, t);
    scene.circumcentres.col(t) =
        direction_of(Vector3d((c.at[1] - c.at[0]).cross(c.at[2] - c.at[0])));
  }
}

} // namespace

Corners::Corners(const Scene& scene, Eigen::Index triangle)
    : id(scene.mesh->triangles.col(triangle)), at{scene.sites.col(id[0]), scene.sites.col(id[1]),
                                                  scene.sites.col(id[2])},
      flat(scene.flat) {
  for (int k = 0; k < 2; ++k)
    for (int i = 1; i < 3 && scene.period[k] > 0; ++i)
      at[i][k] = at[0][k] + std::remainder(at[i][k] - at[0][k], scene.period[k]);
}

double Corners::side(int i) const {
  const Vector3d& a = at[i];
  const Vector3d& b = at[(i + 1) % 3];
  return flat ? (a - b).norm() : arc(a, b);
}

double Corners::smallest_angle() const {
  const auto angle = [&](int i) {
    const Vector3d& a = at[i];
    const Vector3d& b = at[(i + 1) % 3];
    const Vector3d& c = at[(i + 2) % 3];
    return flat ? flat_angle(b - a, c - a) : angle_at(a, b, c);
  };
  return std::min({angle(0), angle(1), angle(2)});
}

double Corners::area() const {
  if (flat) {
    return (at[1] - at[0]).cross(at[2] - at[0]).norm() / 2;
  }
  const double volume = at[0].dot((at[1] - at[0]).cross(at[2] - at[0]));
  return 2 * std::atan2(volume, 1 + at[0].dot(at[1]) + at[1].dot(at[2]) + at[2].dot(at[0]));
}

double Corners::quality() const {
  const double a = side(0);
  const double b = side(1);
  const double c = side(2);
  return (b + c - a) * (c + a - b) * (a + b - c) / (a * b * c);
}

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

Vector3d direction_of(const Vector3d& point) {
  const double largest = point.cwiseAbs().maxCoeff();
  return largest > 0 && std::isfinite(largest) ? Vector3d((point / largest).normalized())
                                               : Vector3d(Vector3d::Zero());
}

Vector3d direction_of(const LonLat& point) {
  const double lon = point.longitude * radians_per_degree;
  const double lat = point.latitude * radians_per_degree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

Eigen::Matrix3d frame_of(const LonLat& view) {
  const double lon = view.longitude * radians_per_degree;
  const double lat = view.latitude * radians_per_degree;
  Eigen::Matrix3d frame;
  frame.row(0) << -std::sin(lon), std::cos(lon), 0;
  frame.row(1) << -std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat);
  frame.row(2) = direction_of(view);
  return frame;
}

Scene make_scene(const Mesh& mesh, Shapes shapes, const LonLat& view, const Polygons* cells) {
  Scene scene;
  scene.mesh = &mesh;
  scene.shapes = shapes == Shapes::triangles ? Shapes::triangles : Shapes::cells;
  scene.frame = frame_of(view);
  scene.sites.resize(3, mesh.points.cols());
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    scene.sites.col(i) = scene.frame * direction_of(Vector3d(mesh.points.col(i)));
  }
  link(scene);
  if (cells != nullptr && scene.shapes == Shapes::cells) {
    scene.polygons = cells;
    scene.circumcentres = scene.frame * cells->corners;
  }
  return scene;
}

Scene make_scene(const Polygons& polygons, const LonLat& view) {
  Scene scene;
  scene.polygons = &polygons;
  scene.shapes = Shapes::cells;
  scene.frame = frame_of(view);
  scene.circumcentres = scene.frame * polygons.corners;
  scene.sites.resize(3, polygons.size()); // the cells' middles
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t corner : polygons.ids[i]) {
      sum += scene.circumcentres.col(corner);
    }
    scene.sites.col(i) = direction_of(sum);
  }
  return scene;
}

Scene make_flat_scene(const Mesh& mesh, Shapes shapes, const Points2& points,
                      const Eigen::Vector2d& period, const Polygons& cells) {
  Scene scene;
  scene.flat = true;
  scene.mesh = &mesh;
  scene.shapes = shapes == Shapes::triangles ? Shapes::triangles : Shapes::cells;
  scene.sites = Points3::Zero(3, points.cols());
  scene.sites.topRows<2>() = points;
  scene.period = period;
  link(scene);
  if (scene.shapes == Shapes::cells) {
    scene.polygons = &cells;
    scene.circumcentres = cells.corners;
  }
  return scene;
}

bool may_show(const Scene& scene, const std::vector<Vector3d>& corners) {
  const auto beyond = [&](int k, double sign) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Vector3d& p) { return sign * p[k] > scene.reach[k]; });
  };
  return !scene.flat || !(beyond(0, 1) || beyond(0, -1) || beyond(1, 1) || beyond(1, -1));
}

LonLat lonlat_of(const Vector3d& direction) {
  const Points2 point = to_lonlat(direction);
  return {point(0, 0), point(1, 0)};
}

LonLat middle(const Mesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i) {
    sum += direction_of(Vector3d(mesh.points.col(i)));
  }
  return lonlat_of(sum);
}

void outline_of(const Scene& scene, Shapes shapes, std::int64_t shape,
                std::vector<Vector3d>& corners) {
  corners.clear();
  if (shapes == Shapes::triangles) {
    const Corners triangle(scene, shape);
    corners.assign(triangle.at, triangle.at + 3);
    return;
  }
  if (const Polygons* polygons = scene.polygons) {
    for (const std::int32_t corner : polygons->ids[shape]) {
      corners.emplace_back(scene.circumcentres.col(corner));
    }
    return;
  }
  const auto add = [&](std::int32_t t) { corners.emplace_back(scene.circumcentres.col(t)); };
  if (!around(scene, shape, add)) {
    corners.clear();
  }
}

std::vector<float> widths_of(const Scene& scene, Shapes shapes) {
  if (scene.polygons != nullptr && shapes != Shapes::triangles) {
    const Eigen::VectorXf widths = areas(*scene.polygons).cwiseAbs().cwiseSqrt().cast<float>();
    return {widths.begin(), widths.end()};
  }
  const bool triangles = shapes == Shapes::triangles;
  std::vector<double> areas(
      static_cast<std::size_t>(triangles ? scene.mesh->triangles.cols() : scene.sites.cols()));
  for (Eigen::Index t = 0; t < scene.mesh->triangles.cols(); ++t) {
    const Corners corners(scene, t);
    const double area =
        0.5 * (corners.at[1] - corners.at[0]).cross(corners.at[2] - corners.at[0]).norm();
    if (triangles) {
      const bool drawn = scene.outside.empty() || !scene.outside[static_cast<std::size_t>(t)];
      areas[static_cast<std::size_t>(t)] = drawn ? area : 0;
      continue;
    }
    for (const int id : corners.id) {
      areas[static_cast<std::size_t>(id)] += area / 3;
    }
  }
  std::vector<float> widths(areas.size());
  std::transform(areas.begin(), areas.end(), widths.begin(),
                 [](double area) { return static_cast<float>(std::sqrt(area)); });
  return widths;
}

} // namespace calotte::tools
