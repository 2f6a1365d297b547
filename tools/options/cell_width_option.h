// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/widths.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The values of the options for cell widths.
struct WidthWords {
  std::string file;              ///< of cell widths, or ""
  std::optional<double> uniform; ///< km, in the plane its unit, of all cells, instead of the file
  bool with_unit = false;        ///< uniform is given as "60km"
  bool plane = false;            ///< the mesh is planar, which the command knows
  std::string raster;            ///< of a density, or ""
  std::optional<double> inside, outside, transition; ///< km, of polygons
  std::optional<double> gradient;                    ///< the largest; none if it is not limited
  double radius = earth_radius_km;                   ///< km

  /// Whether there are widths in km, which imply a number of cells.
  bool in_km() const { return !file.empty() || uniform; }
  bool given() const { return in_km() || !raster.empty(); }
};

/// Adds --cell-width, --inside-width, --outside-width, --transition and --earth-radius.
/// \param purpose of the widths, for the help. \returns the option --cell-width.
CLI::Option* add_width_file(CLI::App& command, WidthWords& words, const std::string& purpose);

/// Adds --gradient, a number > 0 in km per km.
CLI::Option* add_gradient(CLI::App& command, std::optional<double>& gradient,
                          const std::string& help);

/// Adds the options of add_width_file(), --gradient and --density-raster.
/// \param density the option that they replace.
void add_cell_width(CLI::App& command, WidthWords& words, CLI::Option* density);

/// The name of widths in km, for messages: the file, or "60 km", in the plane "60".
/// \pre words.in_km().
std::string name_of(const WidthWords& words);

/// Reads widths from the file, or makes uniform ones, and limits their gradient.
/// \pre words.in_km().
/// \param surface the sphere or a plane.
/// \throws Error as read_width_rules() and read_widths(); invalid_argument for polygons' widths
///         without polygons, and in a plane for a width with a unit.
WidthRules read_widths(const WidthWords& words, const Surface& surface = {});

/// The input that determines the widths, one line each: the file's contents, and the numbers.
/// \pre words.given().
/// \throws Error file.
std::string width_configuration(const WidthWords& words);

/// The largest gradient of widths times a scale: that of a limit of the widths, but for a jump that
/// the limit left.
WidthGradient steepest_of(const WidthField& widths, const WidthWords& words,
                          std::optional<double> limit, double scale);

/// Where it is: "12.5 E 48.2 S".
std::string lonlat_words(const WidthGradient& gradient);

/// A summary of widths before a run: their range, the cells that they imply and their largest
/// gradient; also a warning, on its own line, if that exceeds the value that models recommend.
/// \param limit of their gradient. \param cells number of cells of the run, if known: it scales
///        all widths. \param unit of widths; gradients are those of --gradient.
std::vector<std::string> notes_on(const WidthField& widths, const WidthWords& words,
                                  std::optional<double> limit, std::optional<std::int64_t> cells,
                                  const Unit& unit);

/// The same of widths in the plane.
/// \param implied number of cells.
std::vector<std::string> notes_in_plane(const WidthField& widths, const WidthWords& words,
                                        double implied, std::optional<std::int64_t> cells);

/// A remark on widths that may be in metres, above 2000 km without a unit; "" for others.
std::string doubt_of(const WidthField& widths, const WidthWords& words);

} // namespace calotte::tools
