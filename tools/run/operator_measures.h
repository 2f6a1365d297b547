// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/units_option.h"

#include <calotte/quality.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>

/// The errors of a C-grid model's operators: their names, and the table and the report of calotte
/// info.
namespace calotte::tools {

struct OperatorName {
  const char* word;  ///< on the command line and in reports
  const char* label; ///< for people
  ErrorNorms OperatorErrors::*norms;
  DoubleVector OperatorErrorsByCell::*by_cell;
};

inline constexpr std::array<OperatorName, 6> operator_names = {{
    {"divergence", "divergence", &OperatorErrors::divergence, &OperatorErrorsByCell::divergence},
    {"gradient", "gradient", &OperatorErrors::gradient, &OperatorErrorsByCell::gradient},
    {"laplacian", "Laplacian", &OperatorErrors::laplacian, &OperatorErrorsByCell::laplacian},
    {"curl", "curl", &OperatorErrors::curl, &OperatorErrorsByCell::curl},
    {"tangential", "tangential velocity", &OperatorErrors::tangential,
     &OperatorErrorsByCell::tangential},
    {"kinetic_energy", "kinetic energy", &OperatorErrors::kinetic_energy,
     &OperatorErrorsByCell::kinetic_energy},
}};

/// Rows of a table whose names have 22 characters.
/// \param unit of distances; \param on_sphere whether locations are longitude and latitude.
std::string operator_rows(const OperatorErrors& errors, const Unit& unit, bool on_sphere);

/// The same numbers, lengths in the unit of the mesh: radians on the sphere.
nlohmann::ordered_json operators_to_json(const OperatorErrors& errors, bool on_sphere);

} // namespace calotte::tools
