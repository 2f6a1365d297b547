// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/density_option.h"

#include "help/help.h"
#include "options/numbers.h"
#include "options/picture_density.h"
#include "options/warning.h"
#include "text/text.h"

#include <calotte/read.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>
#include <string_view>

namespace calotte::tools {
namespace {

/// The syntax of a bump on the sphere or in the plane.
struct Grammar {
  const char* example;
  std::array<const char*, 5> needed;
  std::array<const char*, 2> further; ///< of an ellipse: both or none
};

constexpr const char* example = "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8";
constexpr Grammar on_sphere{
    example, {"lon", "lat", "beta", "alpha", "gamma"}, {"stretch", "azimuth"}};
constexpr Grammar in_plane{"tanh:x=3,y=4,beta=1.5,alpha=0.5,gamma=x8",
                           {"x", "y", "beta", "alpha", "gamma"},
                           {"stretch", "angle"}};

/// The words of one bump: its text, for messages, and the values by their keys.
struct BumpWords {
  std::string text;
  std::map<std::string, std::string> values;
};

[[noreturn]] void refuse_density(const std::string& text, const std::string& problem) {
  refuse(message("--density \"{}\": {}", text, problem));
}

[[noreturn]] void refuse_value(const BumpWords& words, const std::string& key,
                               const std::string& remedy) {
  refuse_density(words.text, message("{} \"{}\" {}", key, words.values.at(key), remedy));
}

void require_known(const std::string& text, const std::string& key, const Grammar& grammar) {
  std::vector<std::string> known(grammar.needed.begin(), grammar.needed.end());
  known.insert(known.end(), grammar.further.begin(), grammar.further.end());
  if (std::find(known.begin(), known.end(), key) == known.end())
    refuse_density(text, message("unknown key \"{}\"; the keys are {}", key, listed(known)));
}

/// The paper's bump by its contrast of widths, such as x8.
bool is_usual(const std::string& text, const Grammar& grammar) {
  return &grammar == &on_sphere && text.size() > 1 && text[0] == 'x' &&
         text.find_first_not_of("0123456789.", 1) == std::string::npos;
}

BumpWords parse_bump(const std::string& text, const Grammar& grammar) {
  if (is_usual(text, grammar))
    return {text,
            {{"lon", "270"}, {"lat", "30"}, {"beta", "30deg"}, {"alpha", "0.2"}, {"gamma", text}}};
  constexpr std::string_view kind = "tanh:";
  if (!text.starts_with(kind))
    refuse_density(text, message("not a density; give uniform or, for instance, {}{}",
                                 &grammar == &on_sphere ? "x8 or " : "", grammar.example));
  BumpWords words{text, {}};
  std::istringstream rest(text.substr(kind.size()));
  for (std::string word; std::getline(rest, word, ',');) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos)
      refuse_density(text,
                     message("\"{}\" is not key=value; write it as {}", word, grammar.example));
    const std::string key = word.substr(0, equals);
    require_known(text, key, grammar);
    if (!words.values.emplace(key, word.substr(equals + 1)).second)
      refuse_density(text, key + " is given twice; leave one out");
  }
  for (const char* key : grammar.needed)
    if (!words.values.contains(key))
      refuse_density(text, message("{} is missing; write it as {}", key, grammar.example));
  const auto [stretch, turn] = grammar.further;
  if (words.values.contains(stretch) != words.values.contains(turn))
    refuse_density(text,
                   message("stretch and {} define an ellipse together; give both or none", turn));
  return words;
}

std::optional<double> number(std::string_view text) {
  const auto value = numbers_of<1>(text);
  return value ? std::optional((*value)[0]) : std::nullopt;
}

/// \param what it is, for the message.
double number_of(const BumpWords& words, const std::string& key, const char* what) {
  const auto value = number(words.values.at(key));
  if (!value)
    refuse_value(words, key, message("is not a number; give {}", what));
  return *value;
}

double degrees_of(const BumpWords& words, const std::string& key) {
  return number_of(words, key, "degrees");
}

double coordinate_of(const BumpWords& words, const std::string& key) {
  return number_of(words, key, "one in the unit of the domain");
}

/// Radians, or degrees with the suffix deg.
double positive_angle(const BumpWords& words, const std::string& key) {
  constexpr std::string_view degree = "deg";
  std::string_view text = words.values.at(key);
  const bool in_degrees = text.ends_with(degree);
  if (in_degrees)
    text.remove_suffix(degree.size());
  const auto value = number(text);
  if (!value || *value <= 0)
    refuse_value(words, key, "is not a positive angle; give radians, or degrees as 30deg");
  if (!in_degrees && *value > std::numbers::pi)
    warn(message("--density \"{}\": {} is {} radians, more than pi; for degrees give {}={}deg",
                 words.text, key, *value, key, *value));
  return in_degrees ? *value * std::numbers::pi / 180 : *value;
}

/// A number, or x8 for the density whose spacings differ eightfold.
double contrast(const BumpWords& words) {
  std::string_view text = words.values.at("gamma");
  const bool ratio = text.starts_with('x');
  if (ratio)
    text.remove_prefix(1);
  std::optional<double> value = number(text);
  if (value && ratio)
    value = 1 / (*value * *value * *value * *value);
  if (!value || !(*value > 0) || !(*value < 1))
    refuse_value(words, "gamma",
                 "is not between 0 and 1; give such a number, or x8 for spacings of 8:1");
  return *value;
}

double stretch_of(const BumpWords& words) {
  const auto value = number(words.values.at("stretch"));
  if (!value || *value < 1)
    refuse_value(words, "stretch", "is not a number >= 1; give the ratio of the axes");
  return *value;
}

/// The unit tangent at a point, in the direction so many degrees clockwise from north.
Eigen::Vector3d heading(double longitude, double latitude, double azimuth) {
  const Eigen::Vector3d east = direction_at(longitude + 90, 0);
  const Eigen::Vector3d north = latitude > 0 ? direction_at(longitude + 180, 90 - latitude)
                                             : direction_at(longitude, 90 + latitude);
  const Eigen::Vector3d turn = direction_at(azimuth, 0); // its cosine and sine
  return turn.x() * north + turn.y() * east;
}

DensityBump bump_of(const std::string& text) {
  const BumpWords words = parse_bump(text, on_sphere);
  const double longitude = degrees_of(words, "lon"), latitude = degrees_of(words, "lat");
  if (std::abs(latitude) > 90)
    refuse_value(words, "lat", "is outside -90 to 90; give degrees north");
  DensityBump bump;
  bump.centre = direction_at(longitude, latitude);
  bump.beta = positive_angle(words, "beta");
  bump.alpha = positive_angle(words, "alpha");
  bump.gamma = contrast(words);
  if (words.values.contains("stretch")) {
    bump.stretch = stretch_of(words);
    bump.major = heading(longitude, latitude, degrees_of(words, "azimuth"));
  }
  return bump;
}

double length_of(const BumpWords& words, const std::string& key) {
  const double value = coordinate_of(words, key);
  if (!(value > 0))
    refuse_value(words, key, "is not a positive length; give one in the unit of the domain");
  return value;
}

DensityBump planar_bump_of(const std::string& text) {
  const BumpWords words = parse_bump(text, in_plane);
  DensityBump bump;
  bump.centre = {coordinate_of(words, "x"), coordinate_of(words, "y"), 0};
  bump.beta = length_of(words, "beta");
  bump.alpha = length_of(words, "alpha");
  bump.gamma = contrast(words);
  if (words.values.contains("stretch")) {
    bump.stretch = stretch_of(words);
    bump.major = direction_at(degrees_of(words, "angle"), 0); // its cosine and sine
  }
  return bump;
}

Density bumps_of(const DensityWords& words, bool planar) {
  Density density;
  for (const std::string& text : words.densities) {
    if (text != "uniform")
      density.bumps.push_back(planar ? planar_bump_of(text) : bump_of(text));
    else if (words.densities.size() > 1)
      refuse_density(text, "uniform excludes other densities; give uniform alone, or leave it out");
  }
  if (!density.bumps.empty())
    density.kind = words.join == "sum" ? Density::Kind::sum : Density::Kind::maximum;
  return density;
}

} // namespace

std::shared_ptr<DensityWords> add_density(CLI::App& command) {
  auto words = std::make_shared<DensityWords>();
  const OptionGroup group(command, "Widths and density");
  CLI::Option* const density =
      command
          .add_option(
              "--density", words->densities,
              "Density: uniform (default), or a bump; see calotte help density. Such as x8, or " +
                  std::string(example) + ". Repeat the option for several bumps")
          ->allow_extra_args(false);
  command.add_option("--join", words->join, "Combination of several bumps")
      ->check(CLI::IsMember({"maximum", "sum"}))
      ->capture_default_str();
  add_cell_width(command, words->widths, density);
  return words;
}

Resolution resolution_of(const DensityWords& words, const Surface& surface) {
  const bool planar = !surface.is_sphere();
  if (!words.widths.given())
    return bumps_of(words, planar);
  if (words.widths.in_km())
    return read_widths(words.widths, surface);
  const bool picture = is_picture(words.widths.raster);
  if (picture && !planar)
    refuse_path(words.widths.raster, "a picture is a density of the plane, not of the sphere; give "
                                     "NetCDF density(lat, lon)");
  if (picture)
    return interpolated_density(read_picture(words.widths.raster));
  const Raster density = read_raster( // beyond one of a plane its nearest value holds
      words.widths.raster,
      {.quantity = RasterQuantity::density, .surface = planar ? Surface::plane() : surface});
  return planar ? interpolated_density(density) : calotte::density_of(widths_of_density(density));
}

std::variant<Density, Widths> for_recipe(const Resolution& resolution) {
  if (const auto* const rules = std::get_if<WidthRules>(&resolution))
    return rules->widths;
  return std::get<Density>(resolution);
}

DensityOfWidths sampled(const DensityWords& words, const Surface& surface) {
  Resolution resolution = resolution_of(words, surface);
  if (auto* const density = std::get_if<Density>(&resolution))
    return {std::move(*density), {}};
  WidthField widths = width_field(std::get<WidthRules>(resolution).widths, surface);
  Density density = calotte::density_of(widths);
  return {std::move(density), std::move(widths)};
}

Density density_of(const DensityWords& words, const Surface& surface) {
  return sampled(words, surface).density;
}

std::vector<std::string> density_names(const DensityWords& words) {
  if (words.widths.uniform)
    return {"uniform, " + name_of(words.widths)};
  if (!words.widths.file.empty())
    return {"cell widths of " + words.widths.file};
  if (!words.widths.raster.empty())
    return {"density of " + words.widths.raster};
  return words.densities.empty() ? std::vector<std::string>{"uniform"} : words.densities;
}

std::string density_name(const DensityWords& words) {
  return listed(density_names(words), " and ", " and ");
}

std::string derived_density(const std::string& path, const DoubleVector& density) {
  return message("{}: no density is given; meshDensity follows from the smoothed spacing of the "
                 "cells, which varies by a factor of {}\n",
                 path, formatted("%.3g", std::pow(density.minCoeff(), -0.25)));
}

std::string density_configuration(const DensityWords& words) {
  if (words.widths.given())
    return width_configuration(words.widths);
  std::string text;
  for (const std::string& density : density_names(words))
    text += message("density {}\n", density);
  return words.densities.size() > 1 ? text + message("join {}\n", words.join) : text;
}

} // namespace calotte::tools
