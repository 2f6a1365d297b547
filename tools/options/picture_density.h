// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/raster.h>

#include <string>

namespace calotte::tools {

/// Whether a path names a picture: its suffix is .png, in any case.
bool is_picture(const std::string& path);

/// The rectangle of a picture in the plane, "0,0,WIDTH,HEIGHT" in pixels.
/// \throws Error file; invalid_argument for a file that is no PNG, or a picture of fewer than 2 x 2
///         or more than 10^8 pixels.
std::string rectangle_of_picture(const std::string& path);

/// The density for which the generators of a CVT are as dense as a picture is dark. Pixels are
/// squares of side 1, y points up, and their values stand at their middles.
///
/// Darkness is 1 - grey for the grey of the sRGB encoding, 0 to 1: colours have that of their
/// luminance, transparent pixels are seen on white, and 16 bits are rounded to 8. As a CVT of the
/// density rho has sqrt(rho) generators in an area, the density is the darkness squared. White is
/// as dark as the lightest grey, 1/255, as cells need a mass.
/// \throws Error as above; invalid_argument for a picture that is white everywhere.
Raster read_picture(const std::string& path);

} // namespace calotte::tools
