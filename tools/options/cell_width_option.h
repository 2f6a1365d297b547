// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cell_width.h>

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// What the options say about cell widths.
struct WidthWords {
  std::string file;                                  ///< of cell widths, or ""
  std::string raster;                                ///< of a density, or ""
  std::optional<double> inside, outside, transition; ///< km, of polygons
  double radius = earth_radius_km;                   ///< km

  bool given() const { return !file.empty() || !raster.empty(); }
};

/// Adds --cell-width, --inside-width, --outside-width, --transition, --earth-radius and
/// --density-raster. \param density the option that they take the place of.
void add_cell_width(CLI::App& command, WidthWords& words, CLI::Option* density);

/// Widths from either file: a density raster's have no unit. \pre words.given().
/// \throws Error as read_cell_width; bad_option for polygons' widths without polygons.
CellWidth read_widths(const WidthWords& words);

/// What determines them, a line each: the file's contents, and the numbers. \pre words.given().
/// \throws Error file.
std::string width_configuration(const WidthWords& words);

/// What there is to know of widths in km before a run: their range, the cells that they imply,
/// their largest gradient; and a warning, a line of its own, where that is above what models want.
/// \param cells that the run has, if known: they make all widths larger or smaller.
std::vector<std::string> notes_on(const CellWidth& widths, const WidthWords& words,
                                  std::optional<std::int64_t> cells);

/// The number of cells that widths in km imply.
/// \param bisected moves it, by less than a thousandth, to the nearest that a continuation reaches
///        from a coarse grid: few numbers can be bisected to.
/// \throws Error bad_option where no CVT has so many or so few.
std::int64_t cells_for(const CellWidth& widths, const WidthWords& words, bool bisected);

} // namespace calotte::tools
