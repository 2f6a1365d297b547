// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/painting.h"

namespace calotte::tools {

namespace {

constexpr Rgb dark = {0.07, 0.09, 0.13};
constexpr Rgb light = {1, 1, 1};

} // namespace

Line Layer::line(std::size_t shape, double scale, double height) const {
  const double size = (*widths)[shape] * scale * (0.25 + 0.75 * std::clamp(height, 0.0, 1.0));
  return {line_colour, std::clamp(size / 22, 0.5, 1.4),
          line_strength * std::clamp((size - 2.5) / 7.5, 0.0, 1.0)};
}

std::vector<Layer> layers_of(const Painting& painting) {
  const double strength = painting.scale.colouring == Colouring::none ? 0.85 : 0.6;
  std::vector<Layer> layers = {{painting.scene.shapes, true, &painting.widths, dark, strength}};
  if (!painting.triangle_widths.empty()) {
    layers.push_back({Shapes::triangles, false, &painting.triangle_widths, light, 0.8});
  }
  return layers;
}

} // namespace calotte::tools
