// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/page.h"

#include "draw/coastlines.h"
#include "draw/scale.h"
#include "draw/shapes.h"
#include "text/text.h"
#include "view/pack.h"
#include "view/page_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace calotte::tools {
namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(std::optional<double> number) { return number ? Json(*number) : Json(); }

/// A number, or null for NaN and infinity, which JSON does not have.
Json number_or_null(double number) { return std::isfinite(number) ? Json(number) : Json(); }

/// The frame in which coordinates are whole numbers.
struct Grid {
  Eigen::Vector3d low;
  double step = 1;
  Eigen::Index dimensions = 3;

  explicit Grid(const ViewMesh& mesh) : dimensions(mesh.on_sphere ? 3 : 2) {
    constexpr double steps = (1 << 24) - 1;
    low = mesh.points.rowwise().minCoeff();
    Eigen::Vector3d high = mesh.points.rowwise().maxCoeff();
    if (mesh.shapes && mesh.shapes->corners.cols() > 0) {
      low = low.cwiseMin(mesh.shapes->corners.rowwise().minCoeff());
      high = high.cwiseMax(mesh.shapes->corners.rowwise().maxCoeff());
    }
    const double side = (high - low).maxCoeff();
    step = side > 0 ? side / steps : 1;
  }
};

Json add_points(const Points3& points, const Grid& grid, Blocks& blocks) {
  std::vector<std::int32_t> numbers;
  numbers.reserve(static_cast<std::size_t>(grid.dimensions * points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index k = 0; k < grid.dimensions; ++k)
      numbers.push_back(
          static_cast<std::int32_t>(std::lround((points(k, i) - grid.low[k]) / grid.step)));
  return blocks.add(numbers, static_cast<int>(grid.dimensions));
}

void add_shapes(const Polygons& shapes, const Grid& grid, Blocks& blocks, Json& json) {
  std::vector<std::int32_t> sides;
  for (std::int64_t i = 0; i < shapes.size(); ++i)
    sides.push_back(static_cast<std::int32_t>(shapes.ids.count(i)));
  json["corners"] = add_points(shapes.corners, grid, blocks);
  json["cornerCount"] = shapes.corners.cols();
  json["sides"] = blocks.add(sides, 0);
  json["ring"] = blocks.add({shapes.ids.items.begin(), shapes.ids.items.end()}, 1);
}

/// The different finite values, in rising order.
std::vector<double> classes_of(const Quantity& quantity) {
  std::set<double> values;
  for (const double value : quantity.values)
    if (std::isfinite(value))
      values.insert(value);
  return {values.begin(), values.end()};
}

/// With their colours, if pictures have the same classes.
Json json_of_classes(const Quantity& quantity, const std::vector<double>& classes) {
  const Colouring colouring = quantity.name == "degree"   ? Colouring::valence
                              : quantity.name == "region" ? Colouring::region
                                                          : Colouring::none;
  Json json = Json::array();
  for (const double value : classes) {
    json.push_back({{"value", value}, {"label", formatted("%.15g", value)}});
    if (colouring != Colouring::none)
      json.back()["colour"] = hex_text(class_colour(colouring, value));
  }
  return json;
}

/// The colours of each colour map, from its low end.
Json json_of_palettes() {
  Json json;
  for (const auto& [name, palette] : palette_names()) {
    std::string text;
    for (const Rgb& colour : palette_colours(palette))
      text += hex_text(colour);
    json[name] = text;
  }
  return json;
}

/// The index of each value among the classes; their number where there is no value.
std::vector<std::int32_t> places_of(const DoubleVector& values,
                                    const std::vector<double>& classes) {
  std::vector<std::int32_t> indices;
  indices.reserve(static_cast<std::size_t>(values.size()));
  for (const double value : values)
    indices.push_back(static_cast<std::int32_t>(
        std::isfinite(value)
            ? std::lower_bound(classes.begin(), classes.end(), value) - classes.begin()
            : std::ssize(classes)));
  return indices;
}

std::string word_of(Worst worst) {
  switch (worst) {
  case Worst::low:
    return "low";
  case Worst::high:
    return "high";
  case Worst::far_from_reference:
    return "both";
  case Worst::none:
    break;
  }
  return "none";
}

Json add_quantity(const Quantity& quantity, Blocks& blocks) {
  const std::vector<double> classes =
      quantity.classes ? classes_of(quantity) : std::vector<double>();
  return {{"name", quantity.name},
          {"label", quantity.label},
          {"unit", quantity.unit},
          {"help", quantity.help},
          {"on", quantity.on_triangles ? "triangles" : "cells"},
          {"classes", quantity.classes ? json_of_classes(quantity, classes) : Json()},
          {"logarithmic", quantity.logarithmic && quantity.least.value_or(0) > 0},
          {"worst", word_of(quantity.worst)},
          {"reference", quantity.reference},
          {"least", number_or_null(quantity.least)},
          {"mean", number_or_null(quantity.mean)},
          {"greatest", number_or_null(quantity.greatest)},
          {"missing", quantity.missing},
          {"values", quantity.classes ? blocks.add(places_of(quantity.values, classes), 0)
                                      : blocks.add(quantity.values)}};
}

/// The quantities whose scatter is the spacing law, if the mesh has both.
Json law_of(const ViewMesh& mesh) {
  std::map<std::string, std::size_t> index;
  for (std::size_t k = 0; k < mesh.quantities.size(); ++k)
    index.emplace(mesh.quantities[k].name, k);
  if (!index.contains("spacing") || !index.contains("prescribed"))
    return nullptr;
  return {{"spacing", index["spacing"]}, {"prescribed", index["prescribed"]}};
}

Json add_mesh(const ViewMesh& mesh, Blocks& blocks) {
  const Grid grid(mesh);
  Json low = Json::array(), step = Json::array();
  for (Eigen::Index k = 0; k < grid.dimensions; ++k) {
    low.push_back(grid.low[k]);
    step.push_back(grid.step);
  }
  Json json = {{"name", mesh.name},
               {"notice", mesh.notice},
               {"plane", !mesh.on_sphere},
               {"cells", mesh.cells},
               {"total", mesh.total},
               {"planned", mesh.planned > 0 ? Json(mesh.planned) : Json()},
               {"home", nullptr},
               {"radius", number_or_null(mesh.radius_km)},
               {"low", low},
               {"step", step},
               {"points", add_points(mesh.points, grid, blocks)},
               {"triangles", nullptr},
               {"copied", nullptr},
               {"corners", nullptr},
               {"number", nullptr},
               {"law", law_of(mesh)},
               {"measures", Json::array()}};
  if (mesh.home && mesh.on_sphere) {
    const LonLat home = lonlat_of(*mesh.home);
    json["home"] = {{"lon", home.longitude}, {"lat", home.latitude}};
  }
  if (mesh.triangles.cols() > 0)
    json["triangles"] =
        blocks.add({mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()}, 3);
  if (!mesh.copied.empty())
    json["copied"] = blocks.add(mesh.copied, 1);
  if (mesh.shapes)
    add_shapes(*mesh.shapes, grid, blocks, json);
  if (!mesh.number.empty())
    json["number"] = blocks.add(mesh.number, 1);
  for (const Quantity& quantity : mesh.quantities)
    json["measures"].push_back(add_quantity(quantity, blocks));
  return json;
}

/// Hundredths of a degree.
Json add_coastlines(Blocks& blocks) {
  constexpr double hundredths = 100;
  std::vector<std::int32_t> longitudes, latitudes, begin;
  for (const std::vector<LonLat>& line : coastlines()) {
    begin.push_back(static_cast<std::int32_t>(longitudes.size()));
    for (const LonLat& point : line) {
      longitudes.push_back(static_cast<std::int32_t>(std::lround(hundredths * point.longitude)));
      latitudes.push_back(static_cast<std::int32_t>(std::lround(hundredths * point.latitude)));
    }
  }
  return {{"lon", blocks.add(longitudes, 1)},
          {"lat", blocks.add(latitudes, 1)},
          {"begin", blocks.add(begin, 1)},
          {"unit", 1 / hundredths}};
}

Json history_of(const ViewPage& view) {
  if (view.history.empty() && view.states.empty())
    return nullptr;
  Json json = {{"series", Json::array()}, {"states", Json::array()}};
  for (const ViewSeries& series : view.history) {
    Json y = Json::array();
    for (const double value : series.y)
      y.push_back(number_or_null(value));
    json["series"].push_back({{"label", series.label},
                              {"x", series.x},
                              {"y", std::move(y)},
                              {"logarithmic", series.logarithmic}});
  }
  for (const ViewState& state : view.states)
    json["states"].push_back({{"iteration", state.iteration}, {"mesh", state.mesh}});
  return json;
}

Json header_of(const ViewPage& view, Blocks& blocks) {
  Json views = Json::array(), meshes = Json::array();
  for (std::size_t k = 0; k < view.side_by_side; ++k)
    views.push_back(k);
  for (const ViewMesh& mesh : view.meshes)
    meshes.push_back(add_mesh(mesh, blocks));
  return {{"version", 1},
          {"title", view.title},
          {"palettes", json_of_palettes()},
          {"coastlines", view.coastlines ? add_coastlines(blocks) : Json()},
          {"views", std::move(views)},
          {"meshes", std::move(meshes)},
          {"history", history_of(view)}};
}

/// JSON whose text cannot end a script element.
std::string script_safe(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
  for (const char letter : text)
    if (letter == '<')
      safe += "\\u003c";
    else
      safe += letter;
  return safe;
}

void replace(std::string& text, const std::string& mark, const std::string& by) {
  const std::size_t at = text.find(mark);
  if (at == std::string::npos)
    refuse("the page's template lacks " + mark);
  text.replace(at, mark.size(), by);
}

} // namespace

std::string page_of(const ViewPage& view) {
  Blocks blocks;
  const std::string header = script_safe(header_of(view, blocks));
  std::string data;
  for (std::size_t k = 0; k < blocks.base64().size(); ++k)
    data += "<script type=\"application/octet-stream\" id=\"block-" + std::to_string(k) + "\">" +
            blocks.base64()[k] + "</script>\n";
  std::string page(page_template);
  replace(page, "<!-- style -->", "<style>\n" + std::string(page_style) + "</style>");
  replace(page, "<!-- header -->",
          "<script type=\"application/json\" id=\"header\">" + header + "</script>");
  replace(page, "<!-- script -->", "<script>\n" + std::string(page_script) + "</script>");
  replace(page, "<!-- blocks -->", data); // last: the others are short to search
  return page;
}

} // namespace calotte::tools
