// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/title.h"

#include "draw/text.h"
#include "text/text.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace calotte::tools {

namespace {

std::string three_digits(double value) {
  if (value >= 1000 && value < 1e7)
    return grouped(std::llround(value));
  return formatted("%.3g", value);
}

} // namespace

std::string range_text(double low, double high, const std::string& unit) {
  const bool angle = unit == "\u00b0";
  const std::string from = three_digits(low), to = three_digits(high);
  const std::string end = unit.empty() || angle ? unit : " " + unit;
  return from == to ? to + end : from + (angle ? end : "") + " to " + to + end;
}

std::string symbol_of(const Unit& unit) { return unit.name == "degrees" ? "\u00b0" : unit.name; }

std::string counts_of(const Mesh& mesh, Shapes shapes) {
  return message(
      "{} {}{}", grouped(mesh.points.cols()), shapes == Shapes::points ? "points" : "cells",
      shapes == Shapes::triangles ? message(", {} triangles", grouped(mesh.triangles.cols())) : "");
}

std::string mesh_title(const DrawOptions& options, const std::string& parts,
                       const std::string& length, const std::vector<double>& lengths, bool flat) {
  if (!options.look.title.empty())
    return unmarked(options.look.title);
  std::string title = options.name.empty() ? "" : unmarked(options.name) + ": ";
  title += parts;
  std::vector<double> known;
  std::copy_if(lengths.begin(), lengths.end(), std::back_inserter(known),
               [](double value) { return std::isfinite(value); });
  if (known.empty())
    return title;
  const double unit = flat ? 1 : options.unit.of_radian;
  const auto [least, greatest] = std::minmax_element(known.begin(), known.end());
  return title + ", " + length + " " +
         range_text(unit * *least, unit * *greatest, flat ? "" : symbol_of(options.unit));
}

} // namespace calotte::tools
