// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/quantities.h"

#include "draw/text.h"
#include "draw/values.h"
#include "run/operator_measures.h"
#include "text/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace calotte::tools {
namespace {

bool has_values(const DoubleVector& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Adds a quantity that has values.
void add(std::vector<Quantity>& list, Quantity quantity) {
  if (!has_values(quantity.values))
    return;
  summarise(quantity);
  list.push_back(std::move(quantity));
}

void add_sizes(const CellMeasures& measures, const Unit& unit, std::vector<Quantity>& list) {
  add(list, {.name = "spacing",
             .label = "spacing",
             .unit = unit.name,
             .help = "Mean distance of the cell to its neighbours.",
             .logarithmic = true,
             .values = unit.of_radian * measures.spacing});
  add(list, {.name = "area",
             .label = "area",
             .unit = unit.area,
             .help = "Area of the cell.",
             .logarithmic = true,
             .values = unit.of_steradian * measures.area});
}

void add_shapes(const CellMeasures& measures, std::vector<Quantity>& list) {
  add(list, {.name = "quality",
             .label = "cell quality",
             .help = "Shortest over longest side of the cell.",
             .worst = Worst::low,
             .values = measures.quality});
  add(list, {.name = "sigma",
             .label = "sigma",
             .help = "Distance to the nearest neighbour over that to the farthest.",
             .worst = Worst::low,
             .values = measures.sigma});
  add(list, {.name = "degree",
             .label = "neighbours",
             .help = "Number of neighbours of the cell.",
             .classes = true,
             .worst = Worst::far_from_reference,
             .reference = 6,
             .values = measures.degree});
  add(list, {.name = "angle",
             .label = "largest angle",
             .unit = "degrees",
             .help = "Largest angle of the triangles at the cell.",
             .worst = Worst::high,
             .values = measures.largest_angle});
  add(list, {.name = "off_centroid",
             .label = "distance to the centroid",
             .unit = "spacings",
             .help = "Distance of the generator from the centroid of its cell, over the spacing.",
             .logarithmic = true,
             .worst = Worst::high,
             .values = measures.off_centroid});
}

void add_fits(const CellMeasures& measures, const Unit& unit, std::vector<Quantity>& list) {
  const bool uniform = measures.prescribed.size() == 0 ||
                       measures.prescribed.minCoeff() == measures.prescribed.maxCoeff();
  add(list, {.name = "dc_h_least",
             .label = "least dc/h",
             .help = "Least distance to a neighbour, over the spacing that the density prescribes.",
             .worst = Worst::low,
             .values = measures.min_dc_over_h});
  add(list,
      {.name = "dc_h_greatest",
       .label = "greatest dc/h",
       .help = "Greatest distance to a neighbour, over the spacing that the density prescribes.",
       .worst = Worst::high,
       .values = measures.max_dc_over_h});
  if (!uniform)
    add(list, {.name = "prescribed",
               .label = "prescribed spacing",
               .unit = unit.name,
               .help = "Spacing that the density prescribes for this number of cells.",
               .logarithmic = true,
               .values = unit.of_radian * measures.prescribed});
}

void add_triangles(const CellMeasures& measures, std::vector<Quantity>& list) {
  add(list, {.name = "triangle_angle",
             .label = "largest angle of a triangle",
             .unit = "degrees",
             .help = "Largest angle of the triangle.",
             .on_triangles = true,
             .worst = Worst::high,
             .values = measures.triangle_angle});
  add(list, {.name = "triangle_quality",
             .label = "triangle quality",
             .help = "1 for an equilateral triangle, 0 for a flat one.",
             .on_triangles = true,
             .worst = Worst::low,
             .values = measures.triangle_quality});
}

/// Whether all finite values are a few whole numbers.
bool are_classes(const DoubleVector& values) {
  constexpr std::size_t most = 12;
  std::vector<double> found;
  for (const double value : values) {
    if (!std::isfinite(value) || std::find(found.begin(), found.end(), value) != found.end())
      continue;
    if (value != std::floor(value) || found.size() == most)
      return false;
    found.push_back(value);
  }
  return true;
}

} // namespace

void summarise(Quantity& quantity) {
  double least = HUGE_VAL, greatest = -HUGE_VAL, sum = 0;
  std::int64_t count = 0;
  for (const double value : quantity.values)
    if (std::isfinite(value)) {
      least = std::min(least, value);
      greatest = std::max(greatest, value);
      sum += value;
      ++count;
    }
  quantity.missing = quantity.values.size() - count;
  if (count == 0)
    return;
  quantity.least = least;
  quantity.greatest = greatest;
  quantity.mean = sum / static_cast<double>(count);
}

std::vector<Quantity> quantities_of(const CellMeasures& measures, const Unit& unit) {
  std::vector<Quantity> list;
  add_sizes(measures, unit, list);
  add_shapes(measures, list);
  add_fits(measures, unit, list);
  add_triangles(measures, list);
  return list;
}

std::vector<Quantity> quantities_of(const OperatorErrorsByCell& errors) {
  std::vector<Quantity> list;
  for (const OperatorName& name : operator_names)
    add(list, {.name = std::string("error_") + name.word,
               .label = std::string(name.label) + " error",
               .help = std::string("Greatest error of the ") + name.label +
                       " at the cell, for smooth fields, over the root mean square of the exact "
                       "values.",
               .logarithmic = true,
               .worst = Worst::high,
               .values = errors.*name.by_cell});
  return list;
}

std::vector<Quantity> quantities_of(const Polygons& cells, const Unit& unit) {
  CellMeasures measures;
  measures.area = areas(cells);
  measures.quality = side_ratios(cells);
  measures.degree.resize(cells.size());
  for (std::int64_t i = 0; i < cells.size(); ++i)
    measures.degree[i] = static_cast<double>(cells.ids.count(i));
  std::vector<Quantity> list = quantities_of(measures, unit);
  for (Quantity& quantity : list)
    if (quantity.name == "degree") {
      quantity.label = "sides";
      quantity.help = "Number of sides of the cell.";
    }
  return list;
}

Quantity quantity_of(const MeshField& field) {
  const bool on_triangles = field.location == FieldLocation::vertices;
  Quantity quantity{.name = (on_triangles ? "triangle_field:" : "field:") + field.name,
                    .label = field.name,
                    .unit = is_unit(field.units) ? field.units : "",
                    .help = field.long_name.empty() ? "A field of the file." : field.long_name,
                    .on_triangles = on_triangles,
                    .values = field.values};
  quantity.classes = are_classes(field.values);
  summarise(quantity);
  return quantity;
}

std::string value_text(double value, const std::string& unit) {
  if (!std::isfinite(value))
    return "no value";
  return formatted("%.4g", value) + (unit.empty() ? "" : " " + unit);
}

} // namespace calotte::tools
