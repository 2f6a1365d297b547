// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "domain/surface.h"
#include "generators/line_network.h"
#include "io/bytes/file_error.h"
#include "io/command.h"
#include "io/shapes/jigsaw.h"

#include <calotte/error.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;
using generators_detail::LineNetwork;

/// The edges, each as a line of two points, and the points without an edge.
std::vector<Points3> make_lines(const JigsawFile& file, const Points3& points) {
  std::vector<Points3> lines;
  std::vector<bool> joined(static_cast<std::size_t>(points.cols()), false);
  for (const auto& [a, b] : file.edges) {
    Points3& line = lines.emplace_back(3, 2);
    line << points.col(a), points.col(b);
    joined[static_cast<std::size_t>(a)] = joined[static_cast<std::size_t>(b)] = true;
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!joined[static_cast<std::size_t>(i)])
      lines.emplace_back(points.col(i));
  return lines;
}

Points3 make_line(const LineNetwork& network, const std::vector<std::int32_t>& chain) {
  Points3 line(3, std::ssize(chain));
  for (std::size_t k = 0; k < chain.size(); ++k)
    base_detail::set_column(line, static_cast<std::int64_t>(k),
                            network.points[static_cast<std::size_t>(chain[k])]);
  return line;
}

/// Finds the chains that are part of a closed path. The others are the bridges of the graph
/// (Tarjan, Inf. Process. Lett. 2, 1974).
class ClosedChains {
public:
  explicit ClosedChains(const LineNetwork& network)
      : chains_(network.chains), at_(network.points.size()), closed_(chains_.size(), true),
        entered_(at_.size(), 0), lowest_(at_.size(), 0) {
    for (std::size_t c = 0; c < chains_.size(); ++c) {
      at_[static_cast<std::size_t>(chains_[c].front())].push_back(c);
      if (chains_[c].front() != chains_[c].back())
        at_[static_cast<std::size_t>(chains_[c].back())].push_back(c);
      closed_[c] = chains_[c].size() > 1;
    }
    for (std::size_t point = 0; point < at_.size(); ++point)
      if (entered_[point] == 0)
        search(point);
  }

  bool has(std::size_t chain) const { return closed_[chain]; }

private:
  struct Step {
    std::size_t point, by, next; ///< by: chain that led to the point; next: next chain to follow
  };

  void enter(std::size_t point, std::size_t by, std::vector<Step>& path) {
    lowest_[point] = entered_[point] = ++count_;
    path.push_back({point, by, 0});
  }

  void search(std::size_t from) {
    std::vector<Step> path;
    enter(from, chains_.size(), path);
    while (!path.empty()) {
      Step& here = path.back();
      if (here.next < at_[here.point].size()) {
        const std::size_t chain = at_[here.point][here.next++];
        const auto front = static_cast<std::size_t>(chains_[chain].front()),
                   back = static_cast<std::size_t>(chains_[chain].back()),
                   other = front == here.point ? back : front;
        if (chain == here.by)
          continue;
        if (entered_[other] == 0)
          enter(other, chain, path);
        else
          lowest_[here.point] = std::min(lowest_[here.point], entered_[other]);
        continue;
      }
      const Step left = here;
      path.pop_back();
      if (path.empty())
        break;
      const std::size_t before = path.back().point;
      lowest_[before] = std::min(lowest_[before], lowest_[left.point]);
      if (lowest_[left.point] > entered_[before])
        closed_[left.by] = false;
    }
  }

  const std::vector<std::vector<std::int32_t>>& chains_;
  std::vector<std::vector<std::size_t>> at_; ///< chains that end at a point
  std::vector<bool> closed_;
  std::vector<std::size_t> entered_, lowest_; ///< by point
  std::size_t count_ = 0;
};

/// The domain is bounded by the closed rings in a plane. Other lines, which may end at them, remain
/// lines.
JigsawGeometry in_plane(const JigsawFile& file, const std::string& path) {
  if (file.parts > 1)
    fail_file(path, "a geometry of {} parts (BOUND); give each part a file of its own", file.parts);
  JigsawGeometry out;
  const LineNetwork all =
      generators_detail::make_network(make_lines(file, make_columns(file, path)), false);
  const ClosedChains closed(all);
  std::vector<Points3> sides;
  for (std::size_t c = 0; c < all.chains.size(); ++c)
    (closed.has(c) ? sides : out.lines).push_back(make_line(all, all.chains[c]));
  const LineNetwork network = generators_detail::make_network(sides, false);
  Surface::Rings rings;
  for (const std::vector<std::int32_t>& chain : network.chains) {
    const Points3 line = make_line(network, chain);
    if (chain.front() != chain.back() ||
        network.neighbours[static_cast<std::size_t>(chain.front())] != 2)
      fail_file(path,
                "rings of edges touch at the point {} {}; let each ring have corners of its own",
                line(0, 0), line(1, 0));
    rings.emplace_back(line.topLeftCorner(2, line.cols() - 1));
  }
  if (rings.empty())
    fail_file(path, "no closed ring of edges that bounds a domain; give one");
  try {
    out.surface = Surface::plane().within(std::move(rings));
  } catch (const Error& error) {
    fail_file(path, error.what());
  }
  const auto& [low, high] = domain_detail::outline_of<exact_detail::Plane>(out.surface)->box();
  out.extent = (high.x - low.x + high.y - low.y) / 2;
  return out;
}

} // namespace

JigsawGeometry read_jigsaw_geometry(const std::string& path) {
  const JigsawFile file = read_jigsaw(path);
  if (is_planar_mesh(file))
    return in_plane(file, path);
  if (file.kind != "ellipsoid-mesh")
    fail_file(
        path,
        "a geometry of the kind \"{}\" and {} dimensions; only a sphere (ellipsoid-mesh) and a "
        "plane (euclidean-mesh, NDIMS=2) are meshed",
        file.kind, file.dimensions);
  JigsawGeometry out;
  out.radius = require_sphere_radius(file, path);
  out.extent = 2 * out.radius;
  if (file.points.cols() > 0)
    out.lines = make_lines(file, make_directions(file, path));
  return out;
}

JigsawPoints read_jigsaw_points(const std::string& path, bool plane) {
  const JigsawFile file = read_jigsaw(path);
  if (file.points.cols() == 0)
    fail_file(path, "no POINT section; give points");
  if (is_planar_mesh(file) != plane)
    fail_file(path, plane ? "points of the sphere; give those of a plane (NDIMS=2)"
                          : "points of a plane; give those of the sphere");
  return {make_columns(file, path), file.fixed};
}

} // namespace calotte
