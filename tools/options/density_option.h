// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"
#include "options/cell_width_option.h"

#include <calotte/density.h>
#include <calotte/read.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace calotte::tools {

/// The values of the options for a density.
struct DensityWords {
  std::vector<std::string>
      densities; ///< "uniform", or "tanh:lon=270,lat=30,beta=30deg,alpha=0.20,gamma=x8"
  std::string join = "maximum"; ///< or "sum": what several bumps make
  WidthWords widths = {};       ///< or a file instead of all this
};

/// Adds --density (which may be given several times), --join and what add_cell_width adds.
std::shared_ptr<DensityWords> add_density(CLI::App& command);

/// What the options say: a density, or widths where --cell-width gives them, in km, in a plane in
/// its unit.
using Resolution = std::variant<Density, WidthRules>;

/// Reads the file, if there is one.
/// \param surface which a raster of the sphere must cover. In a plane a bump's centre and lengths
///        are x and y, beta and alpha without a unit; a raster is one of x and y, and a width has
///        no unit.
/// \throws Error invalid_argument naming the word and the remedy; as read_widths().
Resolution resolution_of(const DensityWords& words, const Surface& surface = {});

/// What a recipe takes of it.
std::variant<Density, Widths> for_recipe(const Resolution& resolution);

/// A density, and the widths that it is of, if there are any.
struct DensityOfWidths {
  Density density;
  std::optional<WidthField> widths;
};

/// The same for commands without a recipe. \throws Error as resolution_of(), and as width_field().
DensityOfWidths sampled(const DensityWords& words, const Surface& surface = {});
/// The density alone.
Density density_of(const DensityWords& words, const Surface& surface = {});

/// The parts of its name in reports and pictures: "uniform", the words of a bump, a file.
std::vector<std::string> density_names(const DensityWords& words);
/// Joins these in one line by "and".
std::string density_name(const DensityWords& words);

/// A line that says that a file's density follows from the spacing of its cells.
/// \param density as spacing_density() returns it; not empty.
std::string derived_density(const std::string& path, const DoubleVector& density);

/// The input that determines it, lines "name value" for a run's configuration; for a file, its
/// contents.
/// \throws Error file.
std::string density_configuration(const DensityWords& words);

} // namespace calotte::tools
