// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "io/bytes/file.h"
#include "io/bytes/file_names.h"
#include "io/command.h"
#include "io/shapes/region_file.h"

#include <calotte/error.h>
#include <calotte/ocean.h>
#include <calotte/read.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

// Regions by words: a shape and its values, such as circle=-105,40,1000km.

namespace calotte {
namespace {

using namespace io_detail;

constexpr double degree = std::numbers::pi / 180;

struct Shape {
  std::string_view name, values, example;
};

constexpr std::array<Shape, 5> shapes{
    {{"circle", "LON,LAT,RADIUS", "-105,40,1000km"},
     {"ellipse", "LON,LAT,MAJOR,MINOR,BEARING", "138,38,1580km,1000km,45"},
     {"box", "WEST,SOUTH,EAST,NORTH", "-20,30,40,60"},
     {"channel", "LOWER,UPPER", "-23.5,23.5"},
     {"land", "FILE,LON,LAT", "binned_GSHHS_l.nc,134,-25"}}};

std::string form_of(const Shape& shape) { return message("{}={}", shape.name, shape.values); }

std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    parts.emplace_back(text.substr(0, comma));
    text.remove_prefix(comma + 1);
  }
  parts.emplace_back(text);
  return parts;
}

/// The shape whose name and an equals sign begin a word; none for others.
const Shape* shape_of(std::string_view word) {
  const auto* const found = std::ranges::find(shapes, word.substr(0, word.find('=')), &Shape::name);
  return found != shapes.end() && word.find('=') != word.npos ? found : nullptr;
}

/// A word of a known shape, and its values.
class ShapeWord {
public:
  ShapeWord(const Shape& shape, const std::string& word)
      : shape_(shape), word_(word),
        values_(split(std::string_view(word).substr(word.find('=') + 1))) {
    for (; is_land() && values_.size() > 3; values_.erase(values_.begin() + 1))
      values_[0] += "," + values_[1]; // a comma in the name of the file
  }

  bool is_land() const { return shape_.name == "land"; }
  const std::string& file() const { return values_[0]; } ///< of land

  /// \throws Error with the word before its message.
  Surface surface(double radius_km) const {
    return named(word_, [&] { return made(radius_km); });
  }

private:
  [[noreturn]] void refuse_word(const std::string& problem) const {
    throw Error(ErrorCode::invalid_argument, message("{}; give {}, as in {}={}", problem,
                                                     form_of(shape_), shape_.name, shape_.example));
  }

  /// A number of degrees, with or without the unit.
  double degrees(std::size_t value, const std::string& what, double limit) const {
    const std::optional<Measure> angle = measure_of(values_[value]);
    if (!angle || !(angle->unit.empty() || angle->unit == "deg") ||
        !(std::abs(angle->value) <= limit))
      refuse_word(
          message("\"{}\" is no {} from {} to {} degrees", values_[value], what, -limit, limit));
    return angle->value;
  }
  double longitude(std::size_t value) const { return degrees(value, "longitude", 720); }
  double latitude(std::size_t value) const { return degrees(value, "latitude", 90); }

  /// A length on the sphere as an angle: its unit is km, m or deg.
  double length(std::size_t value, double radius_km) const {
    const std::optional<Measure> size = measure_of(values_[value]);
    const std::string unit = size ? size->unit : "";
    const double angle = unit == "km"    ? size->value / radius_km
                         : unit == "m"   ? size->value / 1000 / radius_km
                         : unit == "deg" ? size->value * degree
                                         : 0;
    if (!(angle > 0))
      refuse_word(message("\"{}\" is no positive length such as 1000km or 30deg", values_[value]));
    if (!(angle < std::numbers::pi))
      refuse_word(message("\"{}\" is {} degrees, half of the way round the sphere or more",
                          values_[value], angle / degree));
    return angle;
  }

  /// The direction at the longitude and latitude that begin with a value.
  Eigen::Vector3d direction(std::size_t value) const {
    const Vec3 point = base_detail::from_lonlat(longitude(value), latitude(value + 1));
    return {point.x, point.y, point.z};
  }

  Surface made(double radius_km) const {
    const std::size_t wanted = split(shape_.values).size();
    if (values_.size() != wanted)
      refuse_word(message("the number of values is {} instead of {}", values_.size(), wanted));
    if (is_land()) {
      const Eigen::Vector3d point = direction(1);
      return land_around(read_coast(file()), point);
    }
    if (shape_.name == "circle")
      return circle(direction(0), length(2, radius_km));
    if (shape_.name == "ellipse")
      return ellipse(direction(0), length(2, radius_km), length(3, radius_km),
                     degrees(4, "bearing", 360) * degree);
    if (shape_.name == "box")
      return box(longitude(0) * degree, latitude(1) * degree, longitude(2) * degree,
                 latitude(3) * degree);
    return channel(latitude(0) * degree, latitude(1) * degree);
  }

  const Shape& shape_;
  const std::string& word_;
  std::vector<std::string> values_;
};

/// Whether a word that is no known shape was meant as one: no file has this name, and files with an
/// equals sign, a parenthesis or a list, or without a suffix, are rare.
bool is_no_name(const std::string& word) {
  std::error_code error;
  return !std::filesystem::exists(word, error) &&
         (word.find_first_of("=(,") != word.npos || suffix_of(word).empty());
}

[[noreturn]] void refuse_shape(const std::string& word) {
  const std::string_view start = std::string_view(word).substr(0, word.find_first_of("=(: ,"));
  const auto* const meant = std::ranges::find(shapes, start, &Shape::name);
  std::vector<std::string> forms;
  for (const Shape& shape : shapes)
    forms.push_back(form_of(shape));
  throw Error(ErrorCode::invalid_argument,
              meant != shapes.end()
                  ? message("{}: this is no shape; write {}, as in {}={}", word, form_of(*meant),
                            meant->name, meant->example)
                  : message("{}: there is no such shape, and no such file; give {}, or the file of "
                            "a region (.geojson, .json, .shp or .pts)",
                            word, listed(forms)));
}

} // namespace

Surface read_region(const std::string& word, double radius_km) {
  if (const Shape* const shape = shape_of(word))
    return ShapeWord(*shape, word).surface(radius_km);
  if (is_no_name(word))
    refuse_shape(word);
  return read_region_file(word);
}

std::string region_file(const std::string& word) {
  if (const Shape* const shape = shape_of(word)) {
    const ShapeWord parsed(*shape, word);
    return parsed.is_land() ? parsed.file() : "";
  }
  return is_no_name(word) ? "" : word;
}

std::string region_beside(const std::string& folder, const std::string& word) {
  const std::filesystem::path beside = std::filesystem::path(folder) / word;
  if (std::error_code error; std::filesystem::exists(beside, error))
    return beside.string();
  const std::string file = region_file(word);
  const std::size_t at = shape_of(word) != nullptr ? word.find('=') + 1 : 0;
  return file.empty() ? word
                      : word.substr(0, at) + (std::filesystem::path(folder) / file).string() +
                            word.substr(at + file.size());
}

} // namespace calotte
