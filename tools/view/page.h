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

/// The HTML of a page that holds all it needs: data, program and style. All text from files is
/// data, never markup.
std::string page_of(const ViewPage& view);

} // namespace calotte::tools
