// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/file_names.h"

#include "base/message.h"
#include "io/bytes/file_error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace calotte::io_detail {

std::string suffix_of(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

bool is_geojson(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".geojson" || suffix == ".json";
}

bool is_shapefile(const std::string& path) { return suffix_of(path) == ".shp"; }

bool has_geometries(const std::string& path) { return is_geojson(path) || is_shapefile(path); }

namespace {

std::string quoted(const std::string& name) {
  return name.find(' ') == std::string::npos ? name : message("'{}'", name);
}

} // namespace

std::string ogr2ogr(std::string_view options, const std::string& to, const std::string& from) {
  return message("ogr2ogr {} {} {}", options, quoted(to), quoted(from));
}

void refuse_foreign(const std::string& path) {
  enum class Contents { shapes, shapefile, part_of_shapefile, archive, raster };
  using enum Contents;
  struct Kind {
    std::string_view suffix, name;
    Contents contents;
  };
  static constexpr std::array<Kind, 20> kinds{{{".shp", "a shapefile", shapefile},
                                               {".dbf", "a part of a shapefile", part_of_shapefile},
                                               {".shx", "a part of a shapefile", part_of_shapefile},
                                               {".prj", "a part of a shapefile", part_of_shapefile},
                                               {".zip", "an archive", archive},
                                               {".gpkg", "a GeoPackage", shapes},
                                               {".kml", "KML", shapes},
                                               {".kmz", "KML", shapes},
                                               {".gml", "GML", shapes},
                                               {".gpx", "GPX", shapes},
                                               {".fgb", "FlatGeobuf", shapes},
                                               {".tif", "an image", raster},
                                               {".tiff", "an image", raster},
                                               {".png", "an image", raster},
                                               {".jpg", "an image", raster},
                                               {".jpeg", "an image", raster},
                                               {".grib", "GRIB", raster},
                                               {".grib2", "GRIB", raster},
                                               {".grb", "GRIB", raster},
                                               {".grb2", "GRIB", raster}}};
  const auto* const kind = std::ranges::find(kinds, suffix_of(path), &Kind::suffix);
  if (kind == kinds.end())
    return;
  const std::string stem = std::filesystem::path(path).replace_extension();
  if (kind->contents == part_of_shapefile)
    fail_file(path, "this is {}; give {}", kind->name, stem + ".shp");
  const std::string source = kind->contents == archive ? "/vsizip/" + path : path;
  // Longitudes and latitudes: the file may have those of a projection.
  constexpr std::string_view degrees = "-t_srs EPSG:4326";
  fail_file(path, "this is {}, which Calotte {}; convert it with GDAL: {}", kind->name,
            kind->contents == shapefile ? "reads only as lines and polygons" : "does not read",
            kind->contents == raster ? message("gdalwarp {} -of netCDF {} {}", degrees,
                                               quoted(source), quoted(stem + ".nc"))
                                     : ogr2ogr(degrees, stem + ".geojson", source));
}

std::optional<std::string> sibling(const std::string& path, std::string_view stem,
                                   std::string_view other) {
  const std::filesystem::path file(path);
  const std::string name = file.filename();
  if (!name.starts_with(stem))
    return std::nullopt;
  return (file.parent_path() / (std::string(other) + name.substr(stem.size()))).string();
}

} // namespace calotte::io_detail
