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
  struct Kind {
    std::string_view suffix, name;
    bool shapes; ///< or a raster
  };
  static constexpr std::array<Kind, 16> kinds{{{".shp", "a shapefile", true},
                                               {".gpkg", "a GeoPackage", true},
                                               {".kml", "KML", true},
                                               {".kmz", "KML", true},
                                               {".gml", "GML", true},
                                               {".gpx", "GPX", true},
                                               {".fgb", "FlatGeobuf", true},
                                               {".tif", "an image", false},
                                               {".tiff", "an image", false},
                                               {".png", "an image", false},
                                               {".jpg", "an image", false},
                                               {".jpeg", "an image", false},
                                               {".grib", "GRIB", false},
                                               {".grib2", "GRIB", false},
                                               {".grb", "GRIB", false},
                                               {".grb2", "GRIB", false}}};
  const auto* const kind = std::ranges::find(kinds, suffix_of(path), &Kind::suffix);
  if (kind == kinds.end())
    return;
  const auto quoted = [](const std::string& name) {
    return name.find(' ') == std::string::npos ? name : message("'{}'", name);
  };
  const std::string stem = std::filesystem::path(path).replace_extension(), given = quoted(path);
  fail_file(path, "this is {}, which Calotte does not read; convert it with GDAL: {}", kind->name,
            kind->shapes ? message("ogr2ogr {} {}", quoted(stem + ".geojson"), given)
                         : message("gdal_translate -of netCDF {} {}", given, quoted(stem + ".nc")));
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
