// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"

#include <string>
#include <vector>

namespace calotte::tools {

/// A range in three digits, such as "30 to 240 km" or "1.8° to 2.3°"; one number if the digits of
/// both ends agree.
std::string range_text(double low, double high, const std::string& unit);

/// The unit of lengths in such a range: a word, or the sign of degrees.
std::string symbol_of(const Unit& unit);

/// "10 242 cells", of dots points, and the number of triangles where these are drawn.
std::string counts_of(const Mesh& mesh, Shapes shapes);

/// The title of a picture of a mesh, marked text: its name, its parts and the range of a length,
/// such as "a.nc: 10 242 cells, spacing 206 to 251 km"; or that of the look.
/// \param lengths in radians, for the title in the unit of the options; of a flat mesh in its own
///        unit. NaN is left out.
std::string mesh_title(const DrawOptions& options, const std::string& parts,
                       const std::string& length, const std::vector<double>& lengths,
                       bool flat = false);

} // namespace calotte::tools
