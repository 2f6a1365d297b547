// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace calotte::tools {

/// DejaVu Sans, a TrueType font. cmake/embed.cmake makes the source of it.
extern const std::string_view font_bytes;

} // namespace calotte::tools
