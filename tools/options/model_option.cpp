// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/model_option.h"

#include "text/text.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <vector>

namespace calotte::tools {

CLI::Option* add_model(CLI::App& command, std::optional<std::string>& word) {
  std::vector<std::string> known;
  for (const Model& model : models())
    known.push_back(model.word);
  return command
      .add_option("--for", word,
                  "Model that reads the file, such as mpas-atmosphere. It selects the format, the "
                  "radius of the sphere, the order of the cells and dimensions: mpas-atmosphere "
                  "(unit sphere), mpas-ocean (6371220 m), mpas-sw (unit sphere, with nVertLevels "
                  "and nTracers) or fesom (nod2d.out). What other options give stays; a "
                  "contradiction is an error. Default: none; an MPAS file on the unit sphere suits "
                  "mpas-atmosphere")
      ->check(CLI::IsMember(known));
}

const Model* model_of(const std::optional<std::string>& word) {
  const auto found = std::find_if(models().begin(), models().end(),
                                  [&](const Model& model) { return word == model.word; });
  return found == models().end() ? nullptr : &*found;
}

std::optional<double> radius_for(const Model* model, std::optional<double> given) {
  if (model == nullptr)
    return given;
  if (given && !suits(*model, model->format, *given, model->dimensions))
    refuse("--for " + model->word + " needs a sphere with a radius of " +
           shortest(model->sphere_radius) + ", not --sphere-radius " + shortest(*given) +
           "; leave one of them out");
  return given.value_or(model->sphere_radius);
}

std::string suited_models(const std::string& path, Format format, double sphere_radius,
                          const std::vector<FieldDimension>& dimensions) {
  if (format != Format::mpas)
    return "";
  std::vector<std::string> names;
  for (const Model& model : models())
    if (suits(model, format, sphere_radius, dimensions))
      names.push_back(model.name);
  const std::string radius =
      sphere_radius == 1 ? "unit sphere" : "sphere of " + shortest(sphere_radius) + " m";
  return path + ": " + radius + ", for " +
         (names.empty() ? "no model that is known" : joined(names, " and ")) +
         "; for others see --for\n";
}

} // namespace calotte::tools
