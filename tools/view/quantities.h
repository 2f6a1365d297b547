// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/units_option.h"

#include <calotte/mesh_file.h>
#include <calotte/quality.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The quantities of a mesh by cell and by triangle, with their names, for lists and pages.
namespace calotte::tools {

/// Which values of a quantity are bad.
enum class Worst { none, low, high, far_from_reference };

/// A number for each cell or triangle.
struct Quantity {
  std::string name =
      {}; ///< a word, such as "dc_h_least"; of a field "field:" or "triangle_field:" and its name
  std::string label = {}; ///< for people
  std::string unit = {};  ///< "" for none
  std::string help = {};  ///< one sentence
  bool on_triangles = false;
  bool classes = false;     ///< few whole numbers
  bool logarithmic = false; ///< of a length or an area
  Worst worst = Worst::none;
  double reference = 1;     ///< for far_from_reference
  DoubleVector values = {}; ///< NaN where there is none

  // Of all values of the mesh; `values` may become a part of them.
  std::optional<double> least = {}, mean = {}, greatest = {}; ///< of the finite values
  std::int64_t missing = 0; ///< number of values that are not finite
};

/// Sets least, mean, greatest and missing.
void summarise(Quantity& quantity);

/// The quantities of a mesh that it has at least at one cell. \param unit of lengths and areas.
std::vector<Quantity> quantities_of(const CellMeasures& measures, const Unit& unit);

/// The errors of operators.
std::vector<Quantity> quantities_of(const OperatorErrorsByCell& errors);

/// Those of cells of any shape: sides, area, quality.
std::vector<Quantity> quantities_of(const Polygons& cells, const Unit& unit);

/// A field of a file, of one number for each cell or triangle.
Quantity quantity_of(const MeshField& field);

/// "60.02 km".
std::string value_text(double value, const std::string& unit);

} // namespace calotte::tools
