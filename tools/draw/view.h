// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "draw/projection.h"

namespace calotte::tools {

/// What a picture of the sphere shows: the frame of the map and the part of it.
struct View {
  LonLat middle; ///< of the whole map; of plate carree on the equator
  MapWindow window;
};

/// The view as given, or of the whole map.
/// \param middle default of Look::view; plate carree uses only its longitude.
View view_of(const Look& look, const LonLat& middle);

/// The same, but by default a mesh that covers a small part of the map fills the picture: the view
/// is centred on the mesh, and the map enlarged.
/// \param points of the mesh, directions of any norm.
View view_around(const Look& look, const LonLat& middle, const Points3& points);

} // namespace calotte::tools
