// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/model_grid.h"

#include <calotte/quality.h>
#include <calotte/write.h>

#include <algorithm>
#include <cmath>

namespace calotte {
namespace {

/// Of all models of MPAS. \param waves m/s.
GridDemands demands_of_mpas(double waves) {
  return {.least_sides = 5,
          .least_dv_over_dc = short_voronoi_edge,
          .largest_change = std::exp2(1.0 / 6) - 1,
          .waves = waves};
}

GridDemands demands_of_atmosphere() {
  GridDemands demands = demands_of_mpas(340);
  demands.most_advecting_cells = 15;
  demands.least_dv_in_float32 = 100;
  demands.wind = 125;
  return demands;
}

} // namespace

const std::vector<ModelNeeds>& models() {
  constexpr double earth_in_mpas = 6371229; // mpas_constants.F
  static const std::vector<ModelNeeds> all{{.word = "mpas-atmosphere",
                                            .name = "MPAS-Atmosphere",
                                            .format = Format::mpas,
                                            .planet_radius = earth_in_mpas,
                                            .vertex_order = VertexOrder::before_edges,
                                            .demands = demands_of_atmosphere()},
                                           {.word = "mpas-ocean",
                                            .name = "MPAS-Ocean",
                                            .format = Format::mpas,
                                            .sphere_radius = 6371220,
                                            .planet_radius = 6371220,
                                            .any_planet = true,
                                            .demands = demands_of_mpas(330)},
                                           {.word = "mpas-sw",
                                            .name = "MPAS' shallow-water core",
                                            .format = Format::mpas,
                                            .planet_radius = earth_in_mpas,
                                            .dimensions = {{"nVertLevels", 1}, {"nTracers", 1}},
                                            .demands = demands_of_mpas(330)},
                                           {.word = "fesom",
                                            .name = "FESOM",
                                            .format = Format::fesom,
                                            .planet_radius = 6367500,
                                            .numbering = Numbering::curve}};
  return all;
}

const ModelNeeds* find_model(std::string_view word) {
  const auto found = std::find_if(models().begin(), models().end(),
                                  [&](const ModelNeeds& model) { return model.word == word; });
  return found == models().end() ? nullptr : &*found;
}

bool suits(const ModelNeeds& model, Format format, double sphere_radius, VertexOrder vertex_order,
           const std::vector<FieldDimension>& dimensions) {
  const auto is_there = [&](const FieldDimension& wanted) {
    return std::any_of(dimensions.begin(), dimensions.end(), [&](const FieldDimension& dimension) {
      return dimension.name == wanted.name;
    });
  };
  return format == model.format && vertex_order == model.vertex_order &&
         (sphere_radius == model.sphere_radius ||
          (model.any_planet && sphere_radius >= io_detail::smallest_planet)) &&
         std::all_of(model.dimensions.begin(), model.dimensions.end(), is_there);
}

std::vector<Gate> gates(const Voronoi& voronoi, const ModelNeeds& model,
                        std::optional<double> planet_radius, const Ids& mask) {
  const double radius =
      model.any_planet ? planet_radius.value_or(model.planet_radius) : model.planet_radius;
  return gates(voronoi, model.demands, radius, mask);
}

} // namespace calotte
