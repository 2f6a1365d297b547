// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/shapes/room.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

/// GeoJSON (Butler et al., RFC 7946, 2016): the parser that all its readers share. Shapefiles are
/// read as if they were GeoJSON.
namespace calotte::io_detail {

using Json = nlohmann::json;
using GeoPosition = std::array<double, 2>;

/// A feature, or a geometry without one.
struct GeoFeature {
  std::int64_t number; ///< index in its collection; -1 if it is the whole file
  std::string where;   ///< "feature 3: " or nothing, for messages
  const nlohmann::json& properties;
  const nlohmann::json& geometry; ///< null if it has none
};

/// Passes each feature to `take` as soon as it is read, so that a file need not fit into memory.
/// \returns the other members of the file's object.
/// \throws Error parse if the file is not a JSON object, or if a feature is not an object; file;
/// what take throws.
nlohmann::json read_features(std::istream& in, const std::string& name,
                             const std::function<void(const GeoFeature&)>& take);

/// Receives a geometry of a feature. The coordinates are an array, except for the type "", and for
/// a collection that is nested too deeply.
using GeometryVisit = std::function<void(const GeoFeature& feature, const std::string& type,
                                         const nlohmann::json& coordinates)>;

/// The meaning of a pair of coordinates, for messages.
struct GeoPair {
  const char* form;
  const char* remedy;
  bool degrees; ///< longitude and latitude
};

inline constexpr GeoPair lonlat_pair{"[longitude, latitude]", "give degrees", true},
    xy_pair{"[x, y]", "give two numbers", false};

/// The same for the geometry of each feature, or for each geometry of its collection. A shapefile
/// consists of several files, which are read by their names; see read_shapefile().
/// \throws Error as read_features(); parse for a geometry without coordinates; read_shapefile().
nlohmann::json read_geometries(std::istream& in, const std::string& name, const GeoPair& pair,
                               const GeometryVisit& visit);

/// The text of a member; "" without one.
std::string text_in(const nlohmann::json& object, const char* key);

/// Whether a value is an array that starts with two numbers.
bool is_position(const nlohmann::json& value);
/// \pre is_position(value).
GeoPosition position_of(const nlohmann::json& value);
/// Whether a position is a longitude and a latitude, degrees.
bool are_degrees(const GeoPosition& position);

} // namespace calotte::io_detail
