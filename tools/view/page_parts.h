// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

/// The files of view/page, which the build puts into the command.
namespace calotte::tools {

extern const std::string_view page_template; ///< page.html
extern const std::string_view page_style;    ///< style.css
extern const std::string_view page_script;   ///< the program, bundled and minified

} // namespace calotte::tools
