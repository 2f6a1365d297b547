// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <functional>
#include <string>

namespace calotte::tools {

enum class PictureFormat { png, svg, pdf };

/// The format of a file's suffix.
/// \param other a suffix of which the caller makes something else, for the message; or "".
/// \throws Error invalid_argument for an unknown suffix.
PictureFormat picture_format(const std::string& path, const std::string& other = "");

/// Validates a file name and a width before any work.
/// \throws Error invalid_argument for a suffix that is no picture's, or a width outside 64 to
/// 16384.
void require_picture(const std::string& path, int width);

/// Calls a function that paints on white, width times height pixels (points in SVG and PDF), and
/// writes the picture in the format of the suffix. The file is written under a temporary name and
/// renamed when complete.
/// \throws Error as require_picture; file.
void write_picture(const std::string& path, int width, int height,
                   const std::function<void(cairo_t*)>& paint);

} // namespace calotte::tools
