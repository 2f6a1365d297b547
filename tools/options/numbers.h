// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"
#include "io/command.h"

#include <calotte/read.h>

#include <Eigen/Core>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

/// Numbers in the text of options and files.
namespace calotte::tools {

/// "136.5 W". \param longitude degrees, from -180 to 180.
std::string longitude_words(double longitude);
/// "81.0 N". \param latitude degrees, from -90 to 90.
std::string latitude_words(double latitude);
/// "136.5 W 81.0 N". \param longitude, latitude degrees; from -180 to 180, and -90 to 90.
std::string lonlat_words(double longitude, double latitude);

/// Reads exactly so many finite numbers, separated by commas; nothing for other text.
template <std::size_t count>
std::optional<std::array<double, count>> numbers_of(std::string_view text) {
  std::array<double, count> numbers{};
  const char *at = text.data(), *const end = text.data() + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && (at == end || *at++ != ','))
      return std::nullopt;
    const auto [stop, problem] = std::from_chars(at, end, numbers[i]);
    if (problem != std::errc() || !std::isfinite(numbers[i]))
      return std::nullopt;
    at = stop;
  }
  return at == end ? std::optional(numbers) : std::nullopt;
}

/// The unit vector at a longitude and a latitude in degrees, as points in a file become one.
Eigen::Vector3d direction_at(double longitude, double latitude);

/// \param remedy "one such as 10". \throws Error invalid_argument unless positive and finite.
void require_positive(const std::string& option, double value, const std::string& remedy);

/// A length in km, of km without a unit.
/// \throws Error invalid_argument for a unit other than km and m.
double kilometres_of(const Measure& length);

/// Positive numbers of km, for an option's transform: "60", "60km", "60000m".
CLI::Validator kilometres();

/// Areas in km^2, >= 0, for an option's transform: "1000", "1000km2", "1000km^2".
CLI::Validator square_kilometres();

/// Whole numbers in a range, for an option's transform: decimal, also with leading zeros.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most);

/// The same, or the word auto.
CLI::Validator whole_number_or_auto(std::uint64_t least, std::uint64_t most);

} // namespace calotte::tools
