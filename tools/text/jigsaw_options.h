// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace calotte::tools {

enum class JigsawUse { honoured, ignored, refused };

/// An option of JIGSAW, and what is made of it.
struct JigsawOption {
  std::string_view name;
  JigsawUse use;
  std::string_view what; ///< it means here, or why it has no effect
};

/// \param name in upper case. \returns null for one that JIGSAW does not have.
const JigsawOption* jigsaw_option(std::string_view name);

/// All of them as a table of text.
std::string jigsaw_options();

} // namespace calotte::tools
