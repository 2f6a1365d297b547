// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace calotte::tools {

/// Converts underscores to hyphens, as in the names of the command line.
std::string hyphenated(std::string name);

/// The number of letters to change, add or remove to make one of the other (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The nearest of the names, or else the first that starts with the name; "" if all are too
/// different.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

/// The end of a message about an unknown name: "did you mean NEAREST? See HELP", or "see HELP" if
/// all known names are too different.
/// \param mark stands before the nearest name: "--" for an option of the command line.
/// \param help the command line that prints the help.
std::string remedy_for(const std::string& name, const std::vector<std::string>& names,
                       const std::string& mark, const std::string& help);

} // namespace calotte::tools
