// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/model_option.h"

#include "text/text.h"

#include <CLI/App.hpp>

#include <vector>

namespace calotte::tools {

CLI::Option* add_model(CLI::App& command, std::optional<std::string>& word) {
  std::vector<std::string> known;
  for (const ModelNeeds& model : models())
    known.push_back(model.word);
  return command
      .add_option("--for", word,
                  "Model that reads the file, such as mpas-atmosphere. It selects the format, the "
                  "radius of the sphere, the orders of the cells and of the vertices around them, "
                  "and dimensions: mpas-atmosphere (unit sphere, vertex k of a cell before edge "
                  "k), mpas-ocean (6371220 m), mpas-sw (unit sphere, with nVertLevels and "
                  "nTracers) or fesom (nod2d.out). What other options give stays; a contradiction "
                  "is an error. Default: none; vertices follow edges, as MPAS-Tools writes them")
      ->check(CLI::IsMember(known));
}

CLI::Option* add_demanding_model(CLI::App& command, std::optional<std::string>& word) {
  std::vector<std::string> known;
  for (const ModelNeeds& model : models())
    if (has_demands(model))
      known.push_back(model.word);
  return command
      .add_option("--for", word,
                  message("Compare the grid with the demands of a model, {}: sides of cells, short "
                          "Voronoi edges, changes of width, rings; and print its longest steps",
                          listed(known, ", ", " or ")))
      ->check(CLI::IsMember(known));
}

bool has_demands(const ModelNeeds& model) { return model.demands.least_sides > 0; }

const ModelNeeds* model_of(const std::optional<std::string>& word) {
  return word ? find_model(*word) : nullptr;
}

std::optional<double> radius_for(const ModelNeeds* model, std::optional<double> given) {
  if (model == nullptr)
    return given;
  if (given && !suits(*model, model->format, *given, model->vertex_order, model->dimensions))
    refuse(message("--for {} needs a sphere with a radius of {}, not --sphere-radius {}; leave one "
                   "of them out",
                   model->word, shortest(model->sphere_radius), shortest(*given)));
  return given.value_or(model->sphere_radius);
}

std::string suited_models(const std::string& path, const WriteOptions& options) {
  if (options.format != Format::mpas)
    return "";
  const VertexOrder order = options.vertex_order.value_or(VertexOrder::after_edges);
  std::vector<std::string> names;
  for (const ModelNeeds& model : models())
    if (suits(model, options.format, options.sphere_radius, order, options.dimensions))
      names.push_back(model.name);
  const std::string radius = options.sphere_radius == 1
                                 ? "unit sphere"
                                 : message("sphere of {} m", shortest(options.sphere_radius));
  return message("{}: {}, for {}\n", path, radius,
                 names.empty() ? "no model; name one with --for"
                               : listed(names, " and ", " and ") + "; for others see --for");
}

} // namespace calotte::tools
