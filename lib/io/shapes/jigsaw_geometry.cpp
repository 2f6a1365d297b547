// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "generators/line_network.h"
#include "io/command.h"
#include "io/shapes/jigsaw.h"

#include <calotte/error.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;
using generators_detail::LineNetwork;

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw Error(ErrorCode::parse, path + ": " + problem);
}

/// The edges, each a line of two points, and the points without one.
std::vector<Points3> lines_of(const JigsawFile& file, const Points3& points) {
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

/// The rings of a plane bound the domain; the other lines stay.
JigsawGeometry in_plane(const JigsawFile& file, const std::string& path) {
  const LineNetwork network = generators_detail::network_of(
      lines_of(file, base_detail::with_z(Points2(file.points))), false);
  JigsawGeometry out;
  Surface::Rings rings;
  for (const std::vector<std::int32_t>& chain : network.chains) {
    Points3 line(3, std::ssize(chain));
    for (std::size_t k = 0; k < chain.size(); ++k)
      base_detail::set_column(line, static_cast<std::int64_t>(k),
                              network.places[static_cast<std::size_t>(chain[k])]);
    const bool ring = chain.size() > 1 && chain.front() == chain.back() &&
                      network.neighbours[static_cast<std::size_t>(chain.front())] == 2;
    if (ring)
      rings.emplace_back(line.topLeftCorner(2, line.cols() - 1));
    else
      out.lines.push_back(std::move(line));
  }
  if (rings.empty())
    refuse(path, "no closed ring of edges that bounds a domain; give rings that other edges do "
                 "not touch");
  try {
    out.surface = Surface::plane().within(std::move(rings));
  } catch (const Error& error) {
    refuse(path, error.what());
  }
  return out;
}

} // namespace

JigsawGeometry read_jigsaw_geometry(const std::string& path) {
  const JigsawFile file = read_jigsaw(path);
  if (file.kind == "euclidean-mesh" && file.dimensions == 2)
    return in_plane(file, path);
  if (file.kind != "ellipsoid-mesh")
    refuse(path, "a geometry of the kind \"" + file.kind + "\" and " +
                     std::to_string(file.dimensions) +
                     " dimensions; only a sphere (ellipsoid-mesh) and a plane (euclidean-mesh, "
                     "NDIMS=2) are meshed");
  JigsawGeometry out;
  out.radius = radius_of(file, path);
  if (file.points.cols() > 0)
    out.lines = lines_of(file, directions_of(file, path));
  return out;
}

JigsawPoints read_jigsaw_points(const std::string& path, bool plane) {
  const JigsawFile file = read_jigsaw(path);
  if (file.points.cols() == 0)
    refuse(path, "no POINT section; give points");
  const bool flat = file.kind == "euclidean-mesh" && file.dimensions == 2;
  if (flat != plane)
    refuse(path, plane ? "points of the sphere; give those of a plane (NDIMS=2)"
                       : "points of a plane; give those of the sphere");
  return {flat ? base_detail::with_z(Points2(file.points)) : directions_of(file, path), file.fixed};
}

} // namespace calotte
