// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/numbers.h"

#include "text/text.h"

#include <calotte/error.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace calotte::tools {

std::string longitude_words(double longitude) {
  return formatted("%.1f", std::abs(longitude)) + (longitude < 0 ? " W" : " E");
}

std::string latitude_words(double latitude) {
  return formatted("%.1f", std::abs(latitude)) + (latitude < 0 ? " S" : " N");
}

std::string lonlat_words(double longitude, double latitude) {
  return longitude_words(longitude) + " " + latitude_words(latitude);
}

Eigen::Vector3d direction_at(double longitude, double latitude) {
  std::istringstream in(shortest(longitude) + " " + shortest(latitude));
  return read_points(in, "a place", Columns::lonlat).col(0);
}

void require_positive(const std::string& option, double value, const std::string& remedy) {
  require(value > 0 && std::isfinite(value), "{} {} is not a positive number; give {}", option,
          value, remedy);
}

double kilometres_of(const Measure& length) {
  return length.value / (1 / kilometres_in(length.unit)); // a division by 1000 is exact more often
}

CLI::Validator kilometres() {
  return {[](std::string& text) -> std::string {
            const std::optional<Measure> width = measure_of(text);
            if (!width || !(width->value > 0) || !std::isfinite(width->value))
              return message("\"{}\" is not a positive number; give km, such as 60km", text);
            try {
              text = shortest(kilometres_of(*width));
            } catch (const Error&) {
              return message("\"{}\" is in {}; give km or m, such as 60km", text, width->unit);
            }
            return "";
          },
          "KM"};
}

CLI::Validator square_kilometres() {
  return {[](std::string& text) -> std::string {
            std::string number = text;
            for (const std::string_view unit : {"km2", "km^2"})
              if (number.ends_with(unit))
                number = number.substr(0, number.find(unit));
            const std::optional<Measure> area = measure_of(number);
            if (!area || !area->unit.empty() || !(area->value >= 0) || !std::isfinite(area->value))
              return message("\"{}\" is no area; give km^2, such as 1000", text);
            text = shortest(area->value);
            return "";
          },
          "KM2"};
}

CLI::Validator whole_number(std::uint64_t least, std::uint64_t most) {
  const std::string range = most == std::numeric_limits<int>::max()
                                ? message(">= {}", least)
                                : message("from {} to {}", least, most);
  return {[=](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* const end = text.data() + text.size();
            const auto [stop, problem] = std::from_chars(text.data(), end, value);
            if (problem != std::errc() || stop != end || value < least || value > most)
              return message("\"{}\" is not an integer {}", text, range);
            text = std::to_string(value); // CLI11 takes leading zeros for octal
            return "";
          },
          "N"};
}

CLI::Validator whole_number_or_auto(std::uint64_t least, std::uint64_t most) {
  const auto check = [number = whole_number(least, most)](std::string& text) {
    return text == "auto" ? std::string() : number(text);
  };
  return {check, "N|auto"};
}

} // namespace calotte::tools
