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

void refuse_foreign(const std::string& path) {
  enum class Contents { shapes, table_of_shapes, archive, raster };
  using enum Contents;
  struct Kind {
    std::string_view suffix, name;
    Contents contents;
  };
  static constexpr std::array<Kind, 20> kinds{{{".shp", "a shapefile", shapes},
                                               {".dbf", "a part of a shapefile", table_of_shapes},
                                               {".shx", "a part of a shapefile", table_of_shapes},
                                               {".prj", "a part of a shapefile", table_of_shapes},
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
  const auto quoted = [](const std::string& name) {
    return name.find(' ') == std::string::npos ? name : message("'{}'", name);
  };
  const std::string stem = std::filesystem::path(path).replace_extension();
  const std::string source = kind->contents == table_of_shapes ? stem + ".shp"
                             : kind->contents == archive       ? "/vsizip/" + path
                                                               : path;
  // Longitudes and latitudes: the file may have those of a projection.
  constexpr std::string_view degrees = "-t_srs EPSG:4326";
  fail_file(
      path, "this is {}, which Calotte does not read; convert it with GDAL: {}", kind->name,
      kind->contents == raster
          ? message("gdalwarp {} -of netCDF {} {}", degrees, quoted(source), quoted(stem + ".nc"))
          : message("ogr2ogr {} {} {}", degrees, quoted(stem + ".geojson"), quoted(source)));
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
