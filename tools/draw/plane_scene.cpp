// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/plane.h"

#include <calotte/delaunay.h>
#include <calotte/surface.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace calotte::tools {

using Eigen::Vector2d;

namespace {

Window window_around(const Eigen::Ref<const Points2>& places, double margin) {
  const Vector2d low = places.rowwise().minCoeff();
  const Vector2d high = places.rowwise().maxCoeff();
  const Vector2d room = Vector2d::Constant(margin * (high - low).maxCoeff());
  return {low - room, high + room};
}

/// From 0 to the period, and from wall to wall.
Window window_between(const Mesh& mesh, const Surface& part) {
  constexpr double room = 0.02; // of the period, for the walls' lines
  const Vector2d period = mesh.surface.period();
  Points2 places = mesh.points.topRows<2>();
  if (part.is_bounded()) {
    places = part.rings().back();
  }
  const Vector2d margin = Vector2d::Constant(room * period.maxCoeff());
  Window window{places.rowwise().minCoeff() - margin, places.rowwise().maxCoeff() + margin};
  for (int k = 0; k < 2; ++k) {
    if (period[k] > 0) {
      window.low[k] = 0;
      window.high[k] = period[k];
    }
  }
  return window;
}

/// Adds far sites around the points of a mesh, which close the outer cells beyond the window.
Drawn closed_by_far_sites(const Points3& points, const Window& window) {
  constexpr int around = 64;
  constexpr double far = 40; // of the window's extent
  const Eigen::Index n = points.cols();
  Points3 places = Points3::Zero(3, n + around);
  places.leftCols(n) = points;
  const double reach = far * window.extent().maxCoeff();
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * i / around;
    places.col(n + i).head<2>() =
        window.middle() + reach * Vector2d(std::cos(angle), std::sin(angle));
  }
  Drawn drawn(delaunay(std::move(places), Surface::plane()));
  std::fill(drawn.site.begin() + n, drawn.site.end(), -1);
  return drawn;
}

/// The points of a mesh, and their copies that are near the window in the directions that have a
/// period. \param site receives the site of each copy.
Points3 with_copies(const Mesh& mesh, const Window& window, std::vector<std::int32_t>& site) {
  const Eigen::Index n = mesh.points.cols();
  const Vector2d period = mesh.surface.period();
  const double spacing = std::sqrt(window.extent().prod() / static_cast<double>(n));
  const double margin = std::min(window.extent().maxCoeff() / 2, 8 * spacing);
  std::vector<Vector2d> copies;
  const auto is_near = [&](const Vector2d& place) {
    return (period.array() == 0 ||
            (place.array() > -margin && place.array() < period.array() + margin))
        .all();
  };
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      if ((i != 0 && period.x() == 0) || (j != 0 && period.y() == 0)) {
        continue;
      }
      for (Eigen::Index s = 0; s < n; ++s) {
        const Vector2d place =
            mesh.points.col(s).head<2>() + Vector2d(i * period.x(), j * period.y());
        if ((i != 0 || j != 0) && is_near(place)) {
          copies.push_back(place);
          site.push_back(static_cast<std::int32_t>(s));
        }
      }
    }
  }
  Points3 wider = Points3::Zero(3, n + std::ssize(copies));
  wider.leftCols(n) = mesh.points;
  for (std::size_t k = 0; k < copies.size(); ++k) {
    wider.col(n + static_cast<Eigen::Index>(k)).head<2>() = copies[k];
  }
  return wider;
}

/// The mesh of a box and its surroundings.
Drawn with_copies(const Mesh& mesh, const Window& window) {
  std::vector<std::int32_t> site;
  Drawn drawn(delaunay(with_copies(mesh, window, site), Surface::plane()));
  std::copy(site.begin(), site.end(), drawn.site.begin() + mesh.points.cols());
  return drawn;
}

/// Removes the triangles whose sites are none of the mesh's, such as those over land.
void keep_triangles_of(const Mesh& mesh, Drawn& drawn) {
  std::set<std::array<std::int32_t, 3>> known;
  const auto key = [](std::array<std::int32_t, 3> sites) {
    std::sort(sites.begin(), sites.end());
    return sites;
  };
  for (const auto& triangle : mesh.triangles.colwise()) {
    known.insert(key({triangle[0], triangle[1], triangle[2]}));
  }
  const auto site = [&](std::int32_t place) { return drawn.site[static_cast<std::size_t>(place)]; };
  std::vector<std::int32_t> number;
  std::int32_t count = 0;
  for (const auto& triangle : drawn.mesh.triangles.colwise()) {
    const bool stays =
        known.contains(key({site(triangle[0]), site(triangle[1]), site(triangle[2])}));
    number.push_back(stays ? count++ : -1);
  }
  Triangles triangles(3, count);
  Triangles neighbours(3, count);
  for (Eigen::Index t = 0; t < drawn.mesh.triangles.cols(); ++t) {
    const std::int32_t to = number[static_cast<std::size_t>(t)];
    for (int i = 0; to >= 0 && i < 3; ++i) {
      const std::int32_t other = drawn.mesh.neighbours(i, t);
      triangles(i, to) = drawn.mesh.triangles(i, t);
      neighbours(i, to) = other < 0 ? -1 : number[static_cast<std::size_t>(other)];
    }
  }
  drawn.mesh.triangles = std::move(triangles);
  drawn.mesh.neighbours = std::move(neighbours);
}

/// Of a mesh with walls, whose cells end at the domain.
Drawn between_walls(const Mesh& mesh, Shapes shapes, const Window& window) {
  std::vector<std::int32_t> site;
  const Points3 wider = with_copies(mesh, window, site);
  Drawn drawn = shapes == Shapes::triangles ? Drawn(delaunay(wider, Surface::plane()))
                                            : closed_by_far_sites(wider, window);
  std::copy(site.begin(), site.end(), drawn.site.begin() + mesh.points.cols());
  if (shapes == Shapes::triangles) {
    keep_triangles_of(mesh, drawn);
  }
  return drawn;
}

/// The open sides of cells by the corner that they start from: where each ends, and the way there.
using OpenSides = std::map<std::int32_t, std::vector<std::pair<std::int32_t, Vector2d>>>;

Vector2d way_between(const Polygons& cells, std::int32_t from, std::int32_t to) {
  Vector2d way = (cells.corners.col(to) - cells.corners.col(from)).head<2>();
  for (int k = 0; k < 2; ++k) {
    if (cells.period[k] > 0) {
      way[k] -= cells.period[k] * std::round(way[k] / cells.period[k]);
    }
  }
  return way;
}

OpenSides open_sides(const Polygons& cells) {
  std::set<std::array<std::int32_t, 2>> sides;
  for (std::int64_t i = 0; i < cells.size(); ++i) {
    const auto ids = cells.ids[i];
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const std::int32_t from = ids[k], to = ids[(k + 1) % ids.size()];
      if (sides.erase({to, from}) == 0) {
        sides.insert({from, to});
      }
    }
  }
  OpenSides open;
  for (const auto& [from, to] : sides) {
    open[from].emplace_back(to, way_between(cells, from, to));
  }
  return open;
}

/// A closed line of open sides, with the cells to the left.
struct Wall {
  std::vector<Vector2d> corners;
  Vector2d around; ///< from the first corner to its copy at the end: 0, or whole periods
};

/// Takes the sides of a wall.
Wall next_wall(const Polygons& cells, OpenSides& sides) {
  Wall wall;
  const std::int32_t first = sides.begin()->first;
  Vector2d place = cells.corners.col(first).head<2>();
  std::int32_t here = first;
  do {
    wall.corners.push_back(place);
    const auto at = sides.find(here);
    if (at == sides.end()) {
      break;
    }
    const auto [to, way] = at->second.back();
    at->second.pop_back();
    if (at->second.empty()) {
      sides.erase(at);
    }
    place += way;
    here = to;
  } while (here != first);
  wall.around = place - wall.corners.front();
  return wall;
}

DoubleMatrix ring_of(const std::vector<Vector2d>& corners, const Vector2d& shift) {
  DoubleMatrix ring(2, std::ssize(corners));
  for (std::size_t k = 0; k < corners.size(); ++k) {
    ring.col(static_cast<Eigen::Index>(k)) = corners[k] + shift;
  }
  return ring;
}

/// The ring along both walls of a channel, which go on for two periods beyond the window: there the
/// ring has its ends.
DoubleMatrix ring_between(const Wall& one, const Wall& other) {
  std::vector<Vector2d> corners;
  for (const Wall* wall : {&one, &other}) {
    for (const int k : {-2, -1, 0, 1, 2}) {
      for (const Vector2d& corner : wall->corners) {
        corners.push_back(corner + k * wall->around);
      }
    }
  }
  return ring_of(corners, Vector2d::Zero());
}

/// Adds the copies of an island that meet the window.
void add_island(const Wall& wall, const Vector2d& period, Surface::Rings& rings) {
  for (const int i : {-1, 0, 1}) {
    for (const int j : {-1, 0, 1}) {
      if ((i != 0 && period.x() == 0) || (j != 0 && period.y() == 0)) {
        continue;
      }
      const DoubleMatrix ring = ring_of(wall.corners, {i * period.x(), j * period.y()});
      const auto meets = [&](int k) {
        return period[k] == 0 || (ring.row(k).maxCoeff() > 0 && ring.row(k).minCoeff() < period[k]);
      };
      if (meets(0) && meets(1)) {
        rings.push_back(ring);
      }
    }
  }
}

/// A box that the copies of islands at the edge of the window do not reach.
DoubleMatrix wide_box(const Vector2d& period) {
  const Surface box = rectangle(-2 * period, 3 * period);
  return box.rings().front();
}

} // namespace

Surface walls_of(const Polygons& cells) {
  OpenSides sides = open_sides(cells);
  Surface::Rings rings;
  std::vector<Wall> walls; // of a channel
  while (!sides.empty()) {
    Wall wall = next_wall(cells, sides);
    if (wall.around.norm() > cells.period.maxCoeff() / 2) {
      walls.push_back(std::move(wall));
    } else {
      add_island(wall, cells.period, rings);
    }
  }
  const bool is_box = cells.period.minCoeff() > 0;
  if (is_box ? !walls.empty() : walls.size() != 2 || walls[0].around.dot(walls[1].around) > 0) {
    return Surface::periodic(cells.period);
  }
  rings.push_back(is_box ? wide_box(cells.period) : ring_between(walls[0], walls[1]));
  return Surface::plane().within(std::move(rings));
}

Window window_of(const Mesh& mesh, const Surface& part) {
  if (mesh.closed()) {
    return {Vector2d::Zero(), mesh.surface.period()};
  }
  if (has_walls(mesh)) {
    return window_between(mesh, part);
  }
  if (!part.is_bounded()) {
    return window_around(mesh.points.topRows<2>(), 0.04);
  }
  Points2 corners(2, 0);
  for (const DoubleMatrix& ring : part.rings()) {
    const Eigen::Index before = corners.cols();
    corners.conservativeResize(Eigen::NoChange, before + ring.cols());
    corners.rightCols(ring.cols()) = ring;
  }
  return window_around(corners, 0.01);
}

Drawn drawn_of(const Mesh& mesh, Shapes shapes, const Window& window) {
  if (mesh.closed()) {
    return with_copies(mesh, window);
  }
  if (has_walls(mesh)) {
    return between_walls(mesh, shapes, window);
  }
  return shapes == Shapes::triangles ? Drawn(mesh) : closed_by_far_sites(mesh.points, window);
}

Scene scene_of(const Drawn& drawn, Shapes shapes, const Window& window) {
  const double half = window.extent().maxCoeff() / 2;
  return make_flat_scene(drawn.mesh, shapes,
                         (drawn.mesh.points.topRows<2>().colwise() - window.middle()) / half);
}

} // namespace calotte::tools
