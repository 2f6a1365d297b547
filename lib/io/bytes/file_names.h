// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <optional>
#include <string>
#include <string_view>

/// The information in the names of files.
namespace calotte::io_detail {

// MPI-SCVT's names; the rest of a name, as in SaveVertices.12, is common to files that belong
// together.
inline constexpr std::string_view vertices_name = "SaveVertices";
inline constexpr std::string_view triangles_name = "SaveTriangles";
inline constexpr std::string_view density_name = "SaveDensity";

// FESOM's names.
inline constexpr std::string_view fesom_nodes_name = "nod2d.out";
inline constexpr std::string_view fesom_elements_name = "elem2d.out";
inline constexpr std::string_view fesom_depths_name = "aux3d.out";

/// The suffix of a name in lower case, such as ".nc" for NAME.NC; empty if there is none.
std::string suffix_of(const std::string& path);

/// Whether a name ends in .geojson or .json.
bool is_geojson(const std::string& path);

/// Whether a name ends in .shp.
bool is_shapefile(const std::string& path);

/// Whether a name is one of a file of geometries: GeoJSON or a shapefile.
bool has_geometries(const std::string& path);

/// The command of GDAL that converts a file of shapes to GeoJSON.
std::string ogr2ogr(std::string_view options, const std::string& to, const std::string& from);

/// Refuses a file that this library does not read but other programs convert: shapes, archives of
/// them, images and GRIB, by the suffix. Those who read geometries have passed on a shapefile
/// before; see open_geometries().
/// \throws Error parse, with the command that converts it.
void refuse_foreign(const std::string& path);

/// Replaces the start `stem` of the file name by `other`. Returns none if the name starts
/// otherwise.
std::optional<std::string> sibling(const std::string& path, std::string_view stem,
                                   std::string_view other);

} // namespace calotte::io_detail
