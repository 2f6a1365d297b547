// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/run.h"

#include "draw/history_report.h"
#include "draw/shapes.h"
#include "options/mesh_source.h"
#include "text/text.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace calotte::tools {

void add_run(ViewPage& view, const std::string& report, const std::string& folder,
             const ViewChoice& choice) {
  const History history = read_history(report);
  const std::vector<double> numbers = evaluation_numbers(history);
  view.history.push_back({"distance from the centroids / h (rms)", numbers, scaled_l2(history)});
  view.history.push_back(
      {"distance from the centroids / h (largest)", numbers, scaled_linf(history)});
  view.history.push_back(
      {"energy over its least value - 1", numbers, energy_excess({history}).front()});
  ViewMesh& result = view.meshes.front();
  if (const std::int64_t cells = history.iterations.back().cells; cells != result.total)
    result.notice += message("The history is of a run with {} cells. ", cells);
  ViewChoice part = choice;
  part.fields.clear();
  if (result.on_sphere) // all states have whole cells at one place
    part.view = lonlat_of(result.home.value_or(finest_place(result)));
  if (!history.states.empty())
    part.most_cells = std::max<std::int64_t>(
        12, choice.most_cells / static_cast<std::int64_t>(history.states.size()));
  for (const StateFile& state : history.states) {
    const MeshSource source{.path = std::filesystem::path(folder) / state.name,
                            .plane = !view.meshes.front().on_sphere};
    ViewMesh mesh = view_mesh(state.name, read_mesh_file(source, FieldChoice::none), part);
    view.states.push_back({state.evaluation, view.meshes.size()});
    view.meshes.push_back(std::move(mesh));
  }
}

} // namespace calotte::tools
