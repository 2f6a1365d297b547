// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/monitor.h"
#include "base/parallel.h"
#include "curve/traversal.h"
#include "exact/predicates.h"
#include "mesh/room.h"

#include <calotte/check.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

/// The laws that check() proves, for a surface of either kind: a Surface has Faces and knows
///   circle                     what the predicate's circle is called, after "circum"
///   orientation(a, b, c)       of three sites near a
///   in_circle(a, b, c, d)      of four sites near a, ties resolved
///   stored(site)               address of the coordinates that the predicates read first
///   cube_faces, square(site)   where it is, for an Traversal
///   own_failure(t)             of a triangle, what only this kind of surface demands
///   euler(boundary edges)      the characteristic that it must have
///   area(t)                    of a triangle known to be counter-clockwise
///   set_area(sum, result)      sets what result tells of the areas
///   area_failure(sum, result)  of the areas' sum
namespace calotte::mesh_detail {

/// A mesh's arrays.
struct Faces {
  const Triangles& triangle_ids;
  const Triangles& neighbour_ids;
  std::int64_t site_count;

  std::int64_t sites() const { return site_count; }
  std::int64_t triangles() const { return triangle_ids.cols(); }
  std::int32_t vertex(std::int64_t t, int i) const { return triangle_ids(i % 3, t); }
  std::int32_t neighbour(std::int64_t t, int i) const { return neighbour_ids(i % 3, t); }
};

template <class AnyMesh> Faces faces_of(const AnyMesh& mesh) {
  return {mesh.triangles, mesh.neighbours, mesh.points.cols()};
}

/// The slot of a vertex in a triangle, 3 where it is none of its vertices; without branches, which
/// would be mispredicted.
inline int slot_of(const Faces& s, std::int64_t t, std::int32_t vertex) {
  const int first = s.vertex(t, 0) == vertex, second = s.vertex(t, 1) == vertex,
            third = s.vertex(t, 2) == vertex;
  return first + second + third == 1 ? second + 2 * third : 3;
}

inline std::string triangle_name(const Faces& s, std::int64_t t) {
  return "triangle " + std::to_string(t) + " (" + std::to_string(s.vertex(t, 0)) + ", " +
         std::to_string(s.vertex(t, 1)) + ", " + std::to_string(s.vertex(t, 2)) + ")";
}

/// The edge across from vertex i of triangle t.
inline std::string edge_name(const Faces& s, std::int64_t t, int i) {
  return "edge (" + std::to_string(s.vertex(t, i + 1)) + ", " + std::to_string(s.vertex(t, i + 2)) +
         ") of " + triangle_name(s, t);
}

/// The first answer of law(0), ..., law(n - 1) that is not empty.
/// \param monitor told of a step a block.
template <class Law> std::string first_failure(std::int64_t n, const Law& law, Monitor& monitor) {
  std::vector<std::string> failures(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::string& failure = failures[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end && failure.empty(); ++i)
      failure = law(i);
    monitor.step();
  });
  const auto found = std::find_if(failures.begin(), failures.end(),
                                  [](const std::string& failure) { return !failure.empty(); });
  return found != failures.end() ? *found : std::string();
}

/// The same of law(t, 0), law(t, 1) and law(t, 2) for each triangle.
template <class Law>
std::string first_edge_failure(std::int64_t triangles, const Law& law, Monitor& monitor) {
  return first_failure(
      triangles,
      [&](std::int64_t t) {
        std::string failure;
        for (int i = 0; i < 3 && failure.empty(); ++i)
          failure = law(t, i);
        return failure;
      },
      monitor);
}

// ---- The arrays

template <class AnyMesh> std::string shape_failure(const AnyMesh& mesh) {
  if (mesh.triangles.cols() == 0)
    return "the mesh has no triangle";
  if (mesh.triangles.cols() > std::numeric_limits<std::int32_t>::max())
    return "the mesh has " + std::to_string(mesh.triangles.cols()) +
           " triangles: 32-bit neighbours allow 2^31 - 1 at most";
  if (mesh.neighbours.cols() != mesh.triangles.cols())
    return "the mesh has " + std::to_string(mesh.triangles.cols()) +
           " triangles but neighbours of " + std::to_string(mesh.neighbours.cols());
  const std::int64_t n = mesh.points.cols();
  for (std::size_t i = 0; i < mesh.site_of_input.size(); ++i)
    if (mesh.site_of_input[i] < 0 || mesh.site_of_input[i] >= n)
      return "input " + std::to_string(i) + " is said to be site " +
             std::to_string(mesh.site_of_input[i]) + " of " + std::to_string(n);
  return {};
}

inline std::string id_failure(const Faces& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    if (s.vertex(t, i) < 0 || s.vertex(t, i) >= s.sites())
      return triangle_name(s, t) + " has a vertex outside 0 to " + std::to_string(s.sites() - 1);
    if (s.neighbour(t, i) < -1 || s.neighbour(t, i) >= s.triangles())
      return triangle_name(s, t) + " has the neighbour " + std::to_string(s.neighbour(t, i)) +
             ", outside -1 to " + std::to_string(s.triangles() - 1);
  }
  return {};
}

inline std::string order_failure(const Faces& s, std::int64_t t) {
  const auto vertices = [&](std::int64_t of) {
    return std::array<std::int32_t, 3>{s.vertex(of, 0), s.vertex(of, 1), s.vertex(of, 2)};
  };
  const std::array<std::int32_t, 3> own = vertices(t);
  if (own[0] == own[1] || own[1] == own[2] || own[2] == own[0])
    return triangle_name(s, t) + " has a vertex twice";
  if (own[0] > own[1] || own[0] > own[2])
    return triangle_name(s, t) + " does not start at its lowest vertex";
  if (t > 0 && vertices(t - 1) == own)
    return triangle_name(s, t) + " is there twice";
  if (t > 0 && vertices(t - 1) > own)
    return triangle_name(s, t) + " is not in the order of the vertices";
  return {};
}

/// Of the edge across from vertex i.
inline std::string neighbour_failure(const Faces& s, std::int64_t t, int i) {
  const std::int32_t other = s.neighbour(t, i);
  if (other < 0)
    return {};
  const int start = slot_of(s, other, s.vertex(t, i + 2));
  if (start == 3 || s.vertex(other, start + 1) != s.vertex(t, i + 1))
    return edge_name(s, t, i) + " is not an edge of its neighbour, " + triangle_name(s, other);
  if (s.neighbour(other, start + 2) != t)
    return edge_name(s, t, i) + ": its neighbour, " + triangle_name(s, other) +
           ", has another there";
  return {};
}

// ---- The stars

/// For each site a triangle at which a walk around it begins, and how many triangles it has.
struct Stars {
  std::vector<std::int32_t>
      first; ///< -1 for none; along a boundary the one that the walk must begin at
  std::vector<std::int32_t> size;
};

inline Stars make_stars(const Faces& s) {
  Stars stars{std::vector<std::int32_t>(static_cast<std::size_t>(s.sites()), -1),
              std::vector<std::int32_t>(static_cast<std::size_t>(s.sites()), 0)};
  for (std::int32_t t = 0; t < s.triangles(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto vertex = static_cast<std::size_t>(s.vertex(t, i));
      ++stars.size[vertex];
      if (stars.first[vertex] < 0 || s.neighbour(t, i + 2) < 0)
        stars.first[vertex] = t;
    }
  return stars;
}

/// The triangles around a site are one cycle that turns around it once, or one fan of at most half
/// a turn.
///
/// Seen from the sphere's centre, the sites across turn left by less than half a turn from one to
/// the next, as all triangles are counter-clockwise. With the first of them ahead, each is in the
/// left half plane or in the right one; the walk has turned around once each time it comes from the
/// right to the left. A fan of at most half a turn has all on the left, the last perhaps behind:
/// the boundary is convex there.
template <class Surface>
std::string star_failure(const Surface& s, const Stars& stars, std::int32_t site) {
  const std::string name = "site " + std::to_string(site);
  const std::int32_t start = stars.first[static_cast<std::size_t>(site)];
  const std::int32_t size = stars.size[static_cast<std::size_t>(site)];
  if (start < 0)
    return name + " is not a vertex of any triangle";
  const std::int32_t ahead = s.vertex(start, slot_of(s, start, site) + 1);
  std::int32_t t = start, walked = 0, turns = 0;
  int way = 1;
  bool reflex = false;
  int side = 1; // of the site across last reached: 1 ahead or left, -1 behind or right
  do {
    const int i = slot_of(s, t, site);
    const std::int32_t across = s.vertex(t, i + 2), next = s.neighbour(t, i + 1);
    way = across == ahead ? 1 : s.orientation(site, ahead, across);
    const int new_side = way > 0 ? 1 : -1;
    turns += side < 0 && new_side > 0;
    reflex = reflex || side < 0;
    side = new_side;
    t = next;
    ++walked;
  } while (t >= 0 && t != start && walked < size);
  if (t < 0 && (reflex || way < 0))
    return "the boundary is not convex at " + name;
  if (walked < size || (t >= 0 && t != start))
    return "the triangles at " + name + " are not a single cycle or fan";
  if (t >= 0 && turns != 1)
    return "the triangles turn " + std::to_string(turns) + " times around " + name;
  return {};
}

// ---- The geometry

template <class Surface> std::string orientation_failure(const Surface& s, std::int64_t t) {
  if (s.orientation(s.vertex(t, 0), s.vertex(t, 1), s.vertex(t, 2)) > 0)
    return {};
  return triangle_name(s, t) + " is not counter-clockwise";
}

/// Of the edge across from vertex i; an edge is looked at from the triangle of the lower number.
template <class Surface> std::string edge_failure(const Surface& s, std::int64_t t, int i) {
  const std::int32_t other = s.neighbour(t, i);
  if (other < t) // none, or seen from there
    return {};
  const std::int32_t across = s.vertex(other, slot_of(s, other, s.vertex(t, i + 2)) + 2);
  if (s.in_circle(s.vertex(t, i + 1), s.vertex(t, i + 2), s.vertex(t, i), across) < 0)
    return {};
  return edge_name(s, t, i) + " is not Delaunay: site " + std::to_string(across) +
         " is inside the circum" + Surface::circle;
}

template <class Surface> std::string euler_failure(const Surface& s, std::int64_t boundary_edges) {
  const std::int64_t edges = (3 * s.triangles() + boundary_edges) / 2;
  const std::int64_t euler = s.sites() - edges + s.triangles();
  const std::int64_t expected = s.euler(boundary_edges);
  if (euler == expected)
    return {};
  return "Euler's characteristic is " + std::to_string(euler) + " instead of " +
         std::to_string(expected);
}

struct Area {
  double value = 0, error = 0;
};

/// Of some triangles, summed one after the other.
struct AreaSum {
  Area area;
  std::int64_t count = 0;

  void add(const Area& more) {
    area.value += more.value;
    area.error += more.error;
    ++count;
  }
};

/// Blocks are summed apart, so that the rounding of the sums stays within (block size + blocks) u.
inline Area total_of(const std::vector<AreaSum>& blocks) {
  Area total;
  for (const AreaSum& block : blocks) {
    total.value += block.area.value;
    total.error +=
        block.area.error + static_cast<double>(block.count) * roundoff * block.area.value;
  }
  total.error += static_cast<double>(blocks.size()) * roundoff * total.value;
  return total;
}

template <class Surface> Area sum_areas(const Surface& s) {
  std::vector<AreaSum> sums(static_cast<std::size_t>(block_count(s.triangles())));
  for_each_block(s.triangles(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    AreaSum& sum = sums[static_cast<std::size_t>(block)];
    for (std::int64_t t = begin; t != end; ++t)
      sum.add(s.area(t));
  });
  return total_of(sums);
}

inline std::int64_t count_boundary_edges(const Triangles& neighbours) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(block_count(neighbours.cols())));
  for_each_block(neighbours.cols(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    counts[static_cast<std::size_t>(block)] =
        (neighbours.middleCols(begin, end - begin).array() < 0).count();
  });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

// ---- All laws of a closed mesh in one pass

/// What triangles of a block say, each of itself and of its edges to triangles of higher numbers.
struct Tally {
  bool good = true;
  std::int64_t up = 0, down = 0; ///< neighbours of higher and of lower numbers
  AreaSum sum;
};

/// Asks for what the laws of a triangle will read: without that, each read from far away in a large
/// mesh would wait for the one before it.
inline void fetch_triangle(const Faces& s, std::int64_t t) {
  __builtin_prefetch(&s.triangle_ids(0, t));
  __builtin_prefetch(&s.neighbour_ids(0, t));
}

/// The same for its vertices and the neighbours that it looks at.
template <class Surface> void fetch_neighbours(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i) {
    __builtin_prefetch(s.stored(s.vertex(t, i)));
    if (const std::int32_t other = s.neighbour(t, i); other > t)
      fetch_triangle(s, other);
  }
}

/// The same for the vertices of these neighbours.
template <class Surface> void fetch_across(const Surface& s, std::int64_t t) {
  for (int i = 0; i < 3; ++i)
    if (const std::int32_t other = s.neighbour(t, i); other > t)
      for (int j = 0; j < 3; ++j)
        __builtin_prefetch(s.stored(s.vertex(other, j)));
}

template <class Surface> bool tally(const Surface& s, std::int64_t t, Tally& tally) {
  if (!order_failure(s, t).empty() || !s.own_failure(t).empty() ||
      !orientation_failure(s, t).empty())
    return false;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t other = s.neighbour(t, i);
    if (other < 0)
      return false;
    if (other < t) {
      ++tally.down;
      continue;
    }
    ++tally.up;
    if (!neighbour_failure(s, t, i).empty() || !edge_failure(s, t, i).empty())
      return false;
  }
  tally.sum.add(s.area(t));
  return true;
}

template <class Surface>
Tally tally_block(const Surface& s, const Traversal& way, std::int64_t begin, std::int64_t end) {
  constexpr std::int64_t ahead = 16;
  Tally out;
  for (std::int64_t i = begin; i != end && out.good; ++i) {
    if (i + 3 * ahead < end)
      fetch_triangle(s, way[i + 3 * ahead]);
    if (i + 2 * ahead < end)
      fetch_neighbours(s, way[i + 2 * ahead]);
    if (i + ahead < end)
      fetch_across(s, way[i + ahead]);
    out.good = tally(s, way[i], out);
  }
  return out;
}

template <class Surface> Traversal traversal_of(const Surface& s) {
  if (!are_scattered(s.neighbour_ids))
    return {};
  return {s.triangles(), s.sites(), Surface::cube_faces,
          [&](std::int64_t t) { return s.square(s.vertex(t, 0)); }};
}

/// Whether all laws hold of a closed mesh, whose ids are in range. \param result its areas are set
/// if they do.
///
/// Each triangle is visited once, in any order: its laws read it, the one numbered before it and
/// its neighbours; the rest are counts and sums.
///
/// An edge is looked at from one side alone. Each side that points to a higher number is known to
/// be answered by one that points back; no two are answered by the same; so where as many point to
/// lower numbers, neighbours are mutual.
///
/// Walks around the sites are spared. Glued along their edges, the triangles, all
/// counter-clockwise, cover the sphere or the periodic box evenly, but for branch points at sites
/// that they turn around more than once: as often as the whole goes into their areas. Where these
/// sum to less than 3/2 of the whole, that is once: the surface has the whole's shape, and no place
/// is met twice. So the triangles at a site are a single cycle that turns around it once; and by
/// Euler's characteristic there are as many cycles as sites. The sum is below that when it is the
/// whole within its error, and this is small.
template <class Surface> bool is_proven_closed(const Surface& s, Check& result, Monitor& monitor) {
  std::vector<Tally> tallies(static_cast<std::size_t>(block_count(s.triangles())));
  const Traversal way = traversal_of(s);
  for_each_block(s.triangles(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    tallies[static_cast<std::size_t>(block)] = tally_block(s, way, begin, end);
    monitor.step();
  });
  Tally all;
  std::vector<AreaSum> sums;
  for (const Tally& block : tallies) {
    all.good = all.good && block.good;
    all.up += block.up;
    all.down += block.down;
    sums.push_back(block.sum);
  }
  if (!all.good || all.up != all.down || !euler_failure(s, 0).empty())
    return false;
  const Area total = total_of(sums);
  Check proven = result;
  s.set_area(total.value, proven);
  if (total.error >= total.value / 16 || !s.area_failure(total, proven).empty())
    return false;
  result = proven;
  return true;
}

// ---- All of them

/// The laws in an order in which each may rely on those before it.
/// \param site_failure(i) of a site alone; surface() is asked for when all sites are sound.
template <class AnyMesh, class SiteFailure, class MakeSurface>
std::string first_broken_law(const AnyMesh& mesh, const SiteFailure& site_failure,
                             const MakeSurface& surface, Check& result, Monitor& monitor) {
  std::string failure = shape_failure(mesh);
  const auto holds = [&](std::int64_t n, const auto& law) {
    failure = first_failure(n, law, monitor);
    return failure.empty();
  };
  const auto holds_of_edges = [&](const auto& law) {
    failure = first_edge_failure(mesh.triangles.cols(), law, monitor);
    return failure.empty();
  };
  if (!failure.empty() || !holds(mesh.points.cols(), site_failure))
    return failure;
  const auto s = surface();
  const std::int64_t triangles = s.triangles();
  if (!holds(triangles, [&](std::int64_t t) { return id_failure(s, t); }) ||
      (result.boundary_edges == 0 && is_proven_closed(s, result, monitor)))
    return failure;

  // What is open or broken is looked at one law after the other.
  if (!holds(triangles, [&](std::int64_t t) { return order_failure(s, t); }) ||
      !holds_of_edges([&](std::int64_t t, int i) { return neighbour_failure(s, t, i); }) ||
      !holds(triangles, [&](std::int64_t t) { return s.own_failure(t); }) ||
      !holds(triangles, [&](std::int64_t t) { return orientation_failure(s, t); }))
    return failure;
  const Stars stars = make_stars(s);
  if (!holds(s.sites(),
             [&](std::int64_t i) { return star_failure(s, stars, static_cast<std::int32_t>(i)); }))
    return failure;
  if (failure = euler_failure(s, result.boundary_edges); !failure.empty())
    return failure;
  const Area area = sum_areas(s);
  s.set_area(area.value, result);
  if (!holds_of_edges([&](std::int64_t t, int i) { return edge_failure(s, t, i); }))
    return failure;
  return s.area_failure(area, result);
}

template <class AnyMesh, class SiteFailure, class MakeSurface>
Check check_laws(const AnyMesh& mesh, const SiteFailure& site_failure, const MakeSurface& surface,
                 const ProgressCallback& progress) {
  Monitor monitor(progress);
  Check result;
  result.sites = mesh.points.cols();
  result.triangles = mesh.triangles.cols();
  result.boundary_edges = count_boundary_edges(mesh.neighbours);
  const std::int64_t triangles = block_count(mesh.triangles.cols());
  monitor.begin("check", 0.99, block_count(mesh.points.cols()) + 2 * triangles);
  result.failure = first_broken_law(mesh, site_failure, surface, result, monitor);
  monitor.finish();
  return result;
}

} // namespace calotte::mesh_detail
