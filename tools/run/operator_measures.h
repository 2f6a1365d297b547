// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/units_option.h"

#include <calotte/operators.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

/// The errors of a C-grid model's operators in the table and the report of calotte info.
namespace calotte::tools {

/// Rows of a table whose names have 22 characters.
/// \param unit of distances; \param on_sphere whether locations are longitude and latitude.
std::string operator_rows(const OperatorErrors& errors, const Unit& unit, bool on_sphere);

/// The same numbers, lengths in the unit of the mesh: radians on the sphere.
nlohmann::ordered_json operators_to_json(const OperatorErrors& errors, bool on_sphere);

} // namespace calotte::tools
