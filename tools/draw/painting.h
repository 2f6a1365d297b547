// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/projection.h"
#include "draw/scale.h"
#include "draw/shapes.h"

#include <calotte/density.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace calotte::tools {

/// A site whose number of neighbours is not 6.
struct Marker {
  Eigen::Vector3d point; ///< in the scene
  double valence = 0;
  float width = 0; ///< of its cell
};

/// A scene with the values that fill its shapes.
struct Painting {
  Scene scene;
  std::vector<double> values;         ///< by shape; NaN: not painted
  std::vector<float> widths;          ///< by shape, on the unit sphere
  std::vector<float> triangle_widths; ///< of the triangles drawn over cells; empty where none are
  std::vector<Marker> markers = {};   ///< for Colouring::valence
  bool of_points = false;             ///< Shapes::points: the cells have only the dots' colours
  Scale scale;
};

inline constexpr Rgb globe_colour = {0.965, 0.97, 0.975}; ///< where no shape is

/// The style of a shape's outline.
struct Line {
  Rgb colour;
  double width = 0; ///< pixels
  double alpha = 0;
};

/// Shapes that are drawn together, later layers over earlier ones.
struct Layer {
  Shapes shapes = Shapes::triangles; ///< or cells
  bool filled = true;
  const std::vector<float>* widths = nullptr;
  Rgb line_colour;
  double line_strength = 0; ///< the lines' alpha where shapes are large

  /// The line style for shapes of a size: thin lines that fade as the shapes shrink and vanish at a
  /// few pixels.
  /// \param scale pixels per unit of the map.
  /// \param height height of the shape's centre towards the viewer: near the limb the lines crowd.
  Line line(std::size_t shape, double scale, double height) const;
};

std::vector<Layer> layers_of(const Painting& painting);

/// Calls visit(shape, corners) for every painted shape of a layer that is on the map in part,
/// except for those that are known to be outside the window.
template <class Map, class Visit>
void for_each_visible(const Painting& painting, const Layer& layer, const MapWindow& window,
                      Visit visit) {
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t shape = 0; shape < layer.widths->size(); ++shape) {
    if (layer.filled && std::isnan(painting.values[shape])) {
      continue;
    }
    outline_of(painting.scene, layer.shapes, static_cast<std::int64_t>(shape), corners);
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& copy : painting.scene.copies) {
      for (Eigen::Vector3d& corner : corners) {
        corner += copy - at;
      }
      at = copy;
      if (Map::shows_some(corners) && Map::may_show(corners, window) &&
          may_show(painting.scene, corners)) {
        visit(shape, corners);
      }
    }
  }
}

} // namespace calotte::tools
