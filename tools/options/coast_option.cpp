// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/depth_option.h"

#include "io/command.h"
#include "options/mesh_source.h"
#include "text/text.h"

#include <calotte/read.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <sstream>
#include <vector>

namespace calotte::tools {
namespace {

std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  return CLI::detail::lexical_cast(text, value) ? std::optional(value) : std::nullopt;
}

/// The text of the option, or that of the file which it names.
std::string levels_text(const std::string& word) {
  if (word.find(',') != std::string::npos)
    return word;
  return read_file(word);
}

DoubleVector levels_of(const std::string& word) {
  std::string text = levels_text(word);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream in(text);
  std::vector<double> levels;
  for (std::string item; in >> item;) {
    const std::optional<double> level = parse_number(item);
    if (!level)
      refuse(message("--depth-levels {}: \"{}\" is not a number; give metres", word, item));
    levels.push_back(*level);
  }
  return Eigen::Map<const Eigen::VectorXd>(levels.data(), std::ssize(levels));
}

/// The depths of a field of depths, or of heights, of which those of the sea are below 0; 0 on
/// land. No number stays none.
DoubleVector depths_of(const DoubleVector& values) {
  const double sign = values.sum() < 0 ? -1 : 1;
  return (sign * values).unaryExpr([](double depth) { return depth <= 0 ? 0.0 : depth; });
}

DoubleVector bottom_of(const std::string& name, const MeshFile& file) {
  const std::int64_t sites = file.mesh ? file.mesh->points.cols() : 0;
  if (const std::optional<double> flat = parse_number(name))
    return DoubleVector::Constant(sites, *flat);
  if (const MeshField* const field = find_cell_field(file, name, sites))
    return depths_of(field->values);
  refuse(
      message("--depth {}: the input has no field of that name with a number for each cell; give "
              "another, or metres for a flat bottom",
              name));
}

} // namespace

void add_depths(CLI::App& command, DepthWords& words) {
  CLI::Option* const levels =
      command
          .add_option("--depth-levels", words.levels,
                      "Bounds of the layers for FESOM's aux3d.out, metres, 0 first: numbers such "
                      "as 0,10,30,100, at least 3, or a file of them. Default: none, no aux3d.out")
          ->type_name("LEVELS");
  CLI::Option* const bottom =
      command
          .add_option("--depth", words.bottom,
                      "Depth of the bottom for aux3d.out: a field with a number for each cell, or "
                      "metres for a flat bottom. A field whose sum is below 0 is of heights, "
                      "others are of depths; land has the depth 0")
          ->type_name("NAME|METRES");
  levels->needs(bottom);
  bottom->needs(levels);
}

void set_depths(const DepthWords& words, const MeshFile& file, WriteOptions& options) {
  if (!words.given())
    return;
  options.depth_levels = levels_of(*words.levels);
  options.site_depth = bottom_of(*words.bottom, file);
}

} // namespace calotte::tools
