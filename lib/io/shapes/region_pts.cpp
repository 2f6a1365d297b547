// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lonlat.h"
#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/bytes/text.h"
#include "io/shapes/region_file.h"

#include <calotte/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

// Files of MPAS-Limited-Area: lines `Keyword: value`, and for the type custom a corner `lat, lon`
// on each line.

namespace calotte::io_detail {
namespace {

constexpr double earth_radius = 6371229; ///< metres, as in MPAS
constexpr double degree = std::numbers::pi / 180;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t"), end = text.find_last_not_of(" \t");
  return begin == std::string_view::npos ? "" : text.substr(begin, end - begin + 1);
}

/// A keyword with a number as its value.
struct Quantity {
  std::string_view written, other; ///< in lower case; `other` is a synonym, or empty
  std::string_view unit;
  double low, high;
};

constexpr double longest = 2e7; ///< metres: half of the Earth's circumference
constexpr std::array<Quantity, 6> quantities{{{"radius", "", "metres", 10, longest},
                                              {"semi-major-axis", "", "metres", 10, longest / 2},
                                              {"semi-minor-axis", "", "metres", 10, longest / 2},
                                              {"orientation-angle", "", "degrees", -360, 360},
                                              {"upper-lat", "ulat", "degrees", -90, 90},
                                              {"lower-lat", "llat", "degrees", -90, 90}}};

class Parser {
public:
  Parser(std::istream& in, const std::string& name) : reader_(in, name) {}

  Surface read() {
    for (std::string_view line; reader_.next_content(line);)
      if (const std::size_t colon = line.find(':'); colon != std::string_view::npos)
        set(lower(trimmed(line.substr(0, colon))), trimmed(line.substr(colon + 1)));
      else
        ring_.push_back(parse_point(trimmed(line)));
    if (type_ != "custom" && !ring_.empty())
      fail("it has corners, which only Type: custom takes; remove them");
    try {
      return region();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::parse)
        throw;
      throw Error(error.code(), reader_.name() + ": " + error.what(), error.index());
    }
  }

private:
  [[noreturn]] void fail(const std::string& problem) const { fail_file(reader_.name(), problem); }

  void set(const std::string& keyword, std::string_view value) {
    if (keyword == "type") {
      type_ = lower(value);
    } else if (keyword == "point") {
      point_ = parse_point(value);
    } else if (keyword != "name") {
      const auto known =
          std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& quantity) {
            return keyword == quantity.written || keyword == quantity.other;
          });
      if (known == quantities.end())
        reader_.fail("{} is no keyword; write Name, Type, Point, Radius, Semi-major-axis, "
                     "Semi-minor-axis, Orientation-angle, Upper-lat or Lower-lat",
                     in_quotes(keyword));
      values_[known->written] = number(*known, value);
    }
  }

  double number(const Quantity& quantity, std::string_view text) const {
    const auto read = parse_numbers(text);
    if (!read || read->size() != 1 || !((*read)[0] >= quantity.low) ||
        !((*read)[0] <= quantity.high))
      reader_.fail("{} is no {}; write a number of {} from {} to {}, without the unit",
                   in_quotes(text), quantity.written, quantity.unit, static_cast<int>(quantity.low),
                   static_cast<int>(quantity.high));
    return (*read)[0];
  }

  Vec3 parse_point(std::string_view text) const {
    const auto read = parse_numbers(text);
    if (!read || read->size() != 2 || !(std::abs((*read)[0]) <= 90) ||
        !(std::abs((*read)[1]) <= 720))
      reader_.fail("{} is no place; write latitude (-90 to 90) and longitude, in degrees",
                   in_quotes(text));
    return from_lonlat((*read)[1], (*read)[0]);
  }

  double require_value(const std::string& keyword) const {
    const auto found = values_.find(keyword);
    if (found == values_.end())
      fail(message("a region of the type {} has no line \"{}:\"; add it", type_, keyword));
    return found->second;
  }

  Eigen::Vector3d point() const {
    if (!point_)
      fail(message("a region of the type {} has no line \"Point:\"; add a place inside it", type_));
    return {point_->x, point_->y, point_->z};
  }

  Surface region() {
    if (type_ == "circle")
      return circle(point(), require_value("radius") / earth_radius);
    if (type_ == "ellipse")
      return ellipse(
          point(), require_value("semi-major-axis") / earth_radius,
          require_value("semi-minor-axis") / earth_radius,
          values_.contains("orientation-angle") ? require_value("orientation-angle") * degree : 0);
    if (type_ == "channel")
      return channel(require_value("lower-lat") * degree, require_value("upper-lat") * degree);
    if (type_ != "custom")
      fail(message("{}; write Type: custom, circle, ellipse or channel",
                   type_.empty() ? "no line \"Type:\""
                                 : message("the type {} is unknown", in_quotes(type_))));
    const Surface::Rings corners = corners_of({{ring_, ""}});
    return region_around({corners.begin(), corners.end()}, point());
  }

  LineReader reader_;
  std::string type_;
  std::optional<Vec3> point_;
  std::map<std::string_view, double> values_;
  std::vector<Vec3> ring_;
};

} // namespace

Surface read_region_pts(std::istream& in, const std::string& name) {
  return Parser(in, name).read();
}

} // namespace calotte::io_detail
