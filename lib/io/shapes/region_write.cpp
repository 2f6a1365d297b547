// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/require.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_names.h"
#include "io/bytes/text.h"

#include <calotte/write_region.h>

#include <string>
#include <string_view>

namespace calotte {
namespace {

using namespace io_detail;
using base_detail::LonLat, base_detail::lonlat_of, base_detail::Vec3;

Vec3 corner_of(const DoubleMatrix& ring, Eigen::Index k) {
  const Eigen::Index i = k < ring.cols() ? k : 0;
  return {ring(0, i), ring(1, i), ring(2, i)};
}

/// A point of the region, to the left of the middle of its first arc.
LonLat point_inside(const Surface& region) {
  const Vec3 from = corner_of(region.rings().front(), 0), to = corner_of(region.rings().front(), 1),
             middle = 0.5 * (from + to), aside = cross(from, to);
  const double length = norm(to - from) / norm(aside);
  for (double share = 0.25;; share *= 0.5) {
    const LonLat at = lonlat_of(middle + share * length * aside);
    const Vec3 written = base_detail::from_lonlat(at.longitude, at.latitude);
    if (region.contains({written.x, written.y, written.z}))
      return at;
    base_detail::require(share > 1e-12, "the region is narrower than longitudes and latitudes can "
                                        "say at its first arc; give a wider one");
  }
}

void put_position(Writer& out, const LonLat& at) {
  out.text("[").number(at.longitude).text(",").number(at.latitude).text("]");
}

void put_region(const Sink& sink, const Surface& region) {
  Writer out(sink);
  out.text(R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"inside":)");
  put_position(out, point_inside(region));
  out.text(R"(},"geometry":{"type":"Polygon","coordinates":[)");
  std::string_view between = "\n";
  for (const DoubleMatrix& ring : region.rings()) {
    out.text(between).text("[");
    for (Eigen::Index k = 0; k <= ring.cols(); ++k) {
      out.text(k == 0 ? "" : ",");
      put_position(out, lonlat_of(corner_of(ring, k)));
    }
    out.text("]");
    between = ",\n";
  }
  out.text("\n]}}]}\n").flush();
}

} // namespace

void write_region(const std::string& path, const Surface& region) {
  if (!region.is_sphere() || !region.is_bounded())
    refuse_path(path, "a region is a part of the sphere; give one with rings");
  if (!is_geojson(path))
    refuse_path(path, "a region is written to GeoJSON; give a name that ends in .geojson or .json");
  OutputFile file(path);
  put_region([&](std::string_view bytes) { file.append(bytes); }, region);
  file.commit();
}

} // namespace calotte
