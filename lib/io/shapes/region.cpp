// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/shapes/geojson_areas.h"
#include "io/shapes/region_file.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using namespace io_detail;

/// The rings of all areas.
/// \throws Error parse for a ring without area.
std::vector<WrittenRing> join_rings(std::vector<GeoArea> areas, const std::string& name) {
  std::vector<WrittenRing> rings;
  for (GeoArea& area : areas)
    for (WrittenRing& ring : area.rings) {
      if (ring.corners.size() < 3)
        fail_file(
            name,
            "{} has fewer than 3 distinct places; an edge is the shorter arc of a great circle, "
            "so give more places along a parallel",
            ring.origin);
      rings.push_back(std::move(ring));
    }
  return rings;
}

Surface read_geojson(std::istream& in, const std::string& name) {
  std::vector<WrittenRing> rings = join_rings(read_areas(in, name), name);
  return named(name, [&] {
    rings = joined(std::move(rings));
    if (rings.empty())
      throw Error(ErrorCode::parse, "its polygons cover the sphere; give no region for that");
    Surface region;
    with_origins(rings, [&] { region = Surface::sphere().within(corners_of(rings)); });
    return region;
  });
}

void require_format(const std::string& name) {
  if (has_geometries(name) || suffix_of(name) == ".pts")
    return;
  refuse_foreign(name);
  refuse_path(name, "the name determines no format of regions; name it .geojson, .json, .shp or "
                    ".pts");
}

} // namespace

namespace io_detail {

Surface read_region_file(const std::string& path) {
  require_format(path);
  std::ifstream in = open_geometries(path);
  return read_region(in, path);
}

} // namespace io_detail

Surface read_region(std::istream& in, const std::string& name) {
  require_format(name);
  return has_geometries(name) ? read_geojson(in, name) : read_region_pts(in, name);
}

} // namespace calotte
