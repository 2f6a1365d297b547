// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"
#include "runs.h"

#include <calotte/multimesh.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

namespace calotte::python {
namespace {

/// The attributes of Multimesh. Edges are e x 2, parents n x 2.
py::dict attributes_of(Multimesh&& made) {
  Pairs all = call([&] { return all_edges(made); });
  py::list meshes, edges;
  for (Pairs& of_level : made.edges)
    edges.append(handed_over(std::move(of_level)));
  for (Mesh& mesh : made.meshes)
    meshes.append(std::make_shared<Mesh>(std::move(mesh)));
  py::list converged;
  for (const CvtReport& report : made.reports)
    converged.append(report.converged);
  py::dict values;
  values["meshes"] = py::tuple(meshes);
  values["_level_edges"] = py::tuple(edges);
  values["_all_edges"] = handed_over(std::move(all));
  values["parents"] = handed_over(std::move(made.parents));
  values["converged"] = py::tuple(converged);
  return values;
}

py::dict bisected(int finest, const Doubles& coarsest) {
  const auto points = columns(coarsest);
  return attributes_of(call([&] { return multimesh(finest, points); }));
}

py::dict following(int finest, const Recipe& recipe, std::int64_t coarsest,
                   std::optional<int> regions, py::object function) {
  const ProgressCallback callback = callback_of(std::move(function), ProgressReply::stop);
  return attributes_of(call([&] {
    return multimesh(finest, recipe, coarsest,
                     {.decomposition = {.regions = regions}, .progress = callback});
  }));
}

} // namespace

void add_multimeshes(py::module_& module) {
  module.def("bisected_multimesh", &bisected);
  module.def("multimesh", &following);
}

} // namespace calotte::python
