// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/geojson_areas.h"
#include "io/shapes/region_file.h"

#include <utility>

namespace calotte::io_detail {
namespace {

/// The rings of all areas. \throws Error parse for a ring without area.
std::vector<WrittenRing> rings_of(std::vector<GeoArea> areas, const std::string& name) {
  std::vector<WrittenRing> rings;
  for (GeoArea& area : areas)
    for (WrittenRing& ring : area.rings) {
      if (ring.corners.size() < 3)
        throw Error(ErrorCode::parse,
                    name + ": " + ring.origin +
                        " has fewer than 3 distinct places; an edge is the shorter arc of a great "
                        "circle, so give more places along a parallel");
      rings.push_back(std::move(ring));
    }
  return rings;
}

} // namespace

Surface read_region_geojson(std::istream& in, const std::string& name) {
  std::vector<WrittenRing> rings = rings_of(read_areas(in, name), name);
  return named(name, [&] {
    rings = joined(std::move(rings));
    if (rings.empty())
      throw Error(ErrorCode::parse, "its polygons cover the sphere; give no region for that");
    Surface region;
    with_origins(rings, [&] { region = Surface::sphere().within(corners_of(rings)); });
    return region;
  });
}

} // namespace calotte::io_detail
