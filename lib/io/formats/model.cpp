// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/model.h>

#include <algorithm>

namespace calotte {

const std::vector<Model>& models() {
  static const std::vector<Model> all{
      {"mpas-atmosphere", "MPAS-Atmosphere", Format::mpas, 1, false, Numbering::by_format, {}},
      {"mpas-ocean", "MPAS-Ocean", Format::mpas, 6371220, true, Numbering::by_format, {}},
      {"mpas-sw",
       "MPAS' shallow-water core",
       Format::mpas,
       1,
       false,
       Numbering::by_format,
       {{"nVertLevels", 1}, {"nTracers", 1}}},
      {"fesom", "FESOM", Format::fesom, 1, false, Numbering::curve, {}}};
  return all;
}

bool suits(const Model& model, Format format, double sphere_radius,
           const std::vector<FieldDimension>& dimensions) {
  constexpr double smallest_planet = 1e4; // metres
  const auto is_there = [&](const FieldDimension& wanted) {
    return std::any_of(dimensions.begin(), dimensions.end(), [&](const FieldDimension& dimension) {
      return dimension.name == wanted.name;
    });
  };
  return format == model.format &&
         (sphere_radius == model.sphere_radius ||
          (model.any_planet && sphere_radius >= smallest_planet)) &&
         std::all_of(model.dimensions.begin(), model.dimensions.end(), is_there);
}

} // namespace calotte
