// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/vector.h"

#include <string>
#include <vector>

/// Meridians and parallels at distances that suit the scale of an enlarged map, and their labels.
namespace calotte::tools {

std::string longitude_label(double longitude);
std::string latitude_label(double latitude);

/// A label at a point of the map.
struct DegreeLabel {
  enum class At { left, right, bottom, inside } at = At::inside;
  MapPoint point;
  std::string text;
};

struct Degrees {
  EarthLines lines;
  /// Longitudes along the lower edge of the window, latitudes along the left one. Around a pole
  /// longitudes stand along the left, lower and right edges, latitudes inside.
  std::vector<DegreeLabel> labels;
  /// True if a line leaves the straight line across the window through its label by more than a
  /// fortieth of the window: the labels do not tell the position inside.
  bool bent = false;
};

/// The degrees of a window that is not the whole map.
/// \param frame from points on the earth to directions of the scene.
Degrees degrees_of(const MapWindow& window, const Eigen::Matrix3d& frame);

} // namespace calotte::tools
