// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "view/view_mesh.h"

#include <string>
#include <vector>

namespace calotte::tools {

/// A curve of a run's convergence, by evaluation.
struct ViewSeries {
  std::string label;
  std::vector<double> x, y; ///< NaN where there is no value
  bool logarithmic = true;
};

/// A state that a run kept.
struct ViewState {
  std::int64_t iteration = 0;
  std::size_t mesh = 0; ///< its index in ViewPage::meshes
};

/// The content of a page.
struct ViewPage {
  std::string title;
  bool coastlines = true;
  std::vector<ViewMesh> meshes;
  std::size_t side_by_side = 1; ///< the first one or two meshes
  std::vector<ViewSeries> history;
  std::vector<ViewState> states;
};

/// A grid of the sphere before it is made.
struct PlannedGrid {
  std::string widths; ///< the name of its density or widths
  std::int64_t cells = 0;
  Density density;
  double unit = 0;                      ///< the spacing where the density is 1, radians
  std::optional<double> radius_km = {}; ///< of the sphere
  Unit lengths;                         ///< of the page
  bool coastlines = true;
};

/// The spacings of a grid and their gradient, on a regular mesh of the sphere. The title has the
/// number of cells, and the page opens where they are finest.
ViewPage plan_page(const PlannedGrid& grid);

/// The HTML of a page that holds all it needs: data, program and style. All text from files is
/// data, never markup.
std::string page_of(const ViewPage& view);

} // namespace calotte::tools
