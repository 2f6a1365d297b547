// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace calotte::tools {

/// Breaks a text into lines of at most 100 columns.
/// \param head the start of the first line; the text begins at `indent`, on the next line if the
///        head is too long.
std::string wrapped(const std::string& head, std::size_t indent, const std::string& text);

} // namespace calotte::tools
