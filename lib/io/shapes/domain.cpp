// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/bytes/text.h"
#include "io/command.h"
#include "io/shapes/geojson_polygons.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// The rings of a file, each with its origin for messages.
struct FileRings {
  std::vector<GeoRing> corners;
  std::vector<std::string> origins;

  /// Ends the last ring and removes a repeated first corner.
  void close() {
    if (corners.empty())
      return;
    GeoRing& ring = corners.back();
    if (ring.size() > 1 && ring.front() == ring.back())
      ring.pop_back();
  }
};

bool is_blank_line(std::string_view line) {
  return line.find_first_not_of(" \t") == std::string_view::npos;
}

bool ends_ring(std::string_view line) {
  return is_blank_line(line) || line[line.find_first_not_of(" \t")] == '>';
}

GeoPosition parse_corner(const LineReader& reader, std::string_view line) {
  GeoPosition corner;
  const Columned read = parse_columns(line, 2, corner.data());
  if (read.outcome != Outcome::ok)
    reader.fail("{}; write two numbers x y on each line, and a blank line between rings",
                read.outcome == Outcome::too_few ? "1 column only" : describe(read));
  return corner;
}

FileRings read_text_rings(std::istream& in, const std::string& name) {
  LineReader reader(in, name);
  FileRings rings;
  bool header = false, open = false;
  for (std::string_view line; reader.next(line);) {
    if (ends_ring(line)) {
      open = false;
      continue;
    }
    line = line.substr(0, line.find('#'));
    if (is_blank_line(line))
      continue;
    if (rings.corners.empty() && !header && !has_number(line)) {
      header = true;
      continue;
    }
    const GeoPosition corner = parse_corner(reader, line);
    if (!open) {
      rings.close();
      rings.corners.emplace_back();
      rings.origins.push_back(message("begins in line {}", reader.number()));
    }
    open = true;
    rings.corners.back().push_back(corner);
  }
  rings.close();
  if (rings.corners.empty())
    fail_file(name, "no corners in {} lines; write two numbers x y on each line", reader.number());
  return rings;
}

FileRings read_geojson_rings(std::istream& in, const std::string& name) {
  FileRings rings;
  const GeoPolygons polygons = read_polygons(in, name, xy_pair);
  for (const GeoGeometry& geometry : polygons.geometries) {
    std::int64_t number = 0;
    for (const GeoPolygon& polygon : geometry.polygons)
      for (const GeoRing& ring : polygon) {
        rings.corners.push_back(ring);
        rings.origins.push_back(message("is in the file: {}ring {}", geometry.where, number++));
      }
  }
  return rings;
}

Surface make_domain(const FileRings& rings) {
  Surface::Rings all;
  for (const GeoRing& corners : rings.corners) {
    DoubleMatrix ring(2, std::ssize(corners));
    for (std::size_t i = 0; i < corners.size(); ++i)
      ring.col(static_cast<Eigen::Index>(i)) << corners[i][0], corners[i][1];
    all.push_back(std::move(ring));
  }
  return Surface::plane().within(std::move(all));
}

/// The domain that the closed rings of edges of a JIGSAW mesh bound.
Surface read_jigsaw_domain(const std::string& path) {
  const Surface surface = read_jigsaw_geometry(path).surface;
  if (surface.is_sphere())
    fail_file(path, "a geometry of the sphere; give one of a plane");
  return surface;
}

} // namespace

Surface read_domain(const std::string& path) {
  if (suffix_of(path) == ".msh")
    return read_jigsaw_domain(path);
  std::ifstream in = open_geometries(path);
  const FileRings rings =
      has_geometries(path) ? read_geojson_rings(in, path) : read_text_rings(in, path);
  try {
    return make_domain(rings);
  } catch (const Error& error) {
    const std::int64_t ring = error.index();
    const bool named = ring >= 0 && ring < std::ssize(rings.origins);
    const std::string which =
        named ? message(" (ring {} {})", ring, rings.origins[static_cast<std::size_t>(ring)]) : "";
    throw Error(error.code(), message("{}: {}{}", path, error.what(), which), ring);
  }
}

} // namespace calotte
