// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/cell_outline.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "io/formats/format_table.h"
#include "io/formats/formats.h"

#include "base/points.h"

#include <calotte/voronoi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

// GeoJSON (Butler et al., RFC 7946, 2016), with a feature for each cell. Coordinates of the site
// are properties, since the polygon does not determine it.

namespace calotte::io_detail {
namespace {

/// Writes a number such that readers get the same double: -0 would be read as the integer 0.
void put_number(Writer& out, double value) {
  if (!std::isfinite(value))
    out.text("null");
  else if (value == 0)
    out.text(std::signbit(value) ? "-0.0" : "0.0");
  else
    out.number(value);
}

void put_position(Writer& out, const LonLat& position) {
  out.text("[");
  put_number(out, position.longitude);
  out.text(",");
  put_number(out, position.latitude);
  out.text("]");
}

/// Writes the coordinates of a polygon: one ring, which repeats its first position at the end.
void put_polygon(Writer& out, const std::vector<LonLat>& ring) {
  out.text("[[");
  for (const LonLat& position : ring) {
    put_position(out, position);
    out.text(",");
  }
  put_position(out, ring.front());
  out.text("]]");
}

void put_geometry(Writer& out, const std::vector<std::vector<LonLat>>& rings) {
  if (rings.empty()) {
    out.text("null");
    return;
  }
  const bool several = rings.size() > 1;
  out.text(several ? R"({"type":"MultiPolygon","coordinates":[)"
                   : R"({"type":"Polygon","coordinates":)");
  for (std::size_t r = 0; r < rings.size(); ++r) {
    out.text(r > 0 ? "," : "");
    put_polygon(out, rings[r]);
  }
  out.text(several ? "]}" : "}");
}

void put_property(Writer& out, const char* name, double value) {
  out.text(",\"").text(name).text("\":");
  put_number(out, value);
}

std::vector<Vec3> list_corners(const Polygons& cells, std::int64_t cell) {
  std::vector<Vec3> corners;
  for (const std::int32_t id : cells.ids[cell])
    corners.push_back(column(cells.corners, id));
  return corners;
}

/// The rings of a cell. In a plane x and y replace longitude and latitude.
std::vector<std::vector<LonLat>> make_rings(const Polygons& cells, std::int64_t cell) {
  const std::vector<Vec3> corners = list_corners(cells, cell);
  if (cells.surface.is_sphere())
    return cell_outline(corners);
  std::vector<LonLat> ring;
  for (const Vec3& corner : corners)
    ring.push_back({corner.x, corner.y});
  return {ring};
}

constexpr std::array of_polygons{"id", "x", "y", "z", "area"};
constexpr std::array of_voronoi_cells{"id",      "x",       "y",       "z",     "area",
                                      "density", "spacing", "quality", "degree"};

/// Selects the fields at cells whose name is not that of another property.
std::vector<const MeshField*> select_cell_fields(const WriteOptions& options,
                                                 std::span<const char* const> own_properties) {
  std::vector<const MeshField*> fields;
  for (const MeshField& field : options.fields)
    if (find_fault(Format::geojson, field) == FieldFault::none &&
        std::find(own_properties.begin(), own_properties.end(), field.name) == own_properties.end())
      fields.push_back(&field);
  return fields;
}

void put_site(Writer& out, const Vec3& site) {
  put_property(out, "x", site.x);
  put_property(out, "y", site.y);
  put_property(out, "z", site.z);
}

void put_collection(Writer& out, std::int64_t cells, const auto& put_cell) {
  out.text(R"({"type":"FeatureCollection","features":[)");
  for (std::int64_t i = 0; i < cells; ++i) {
    out.text(i > 0 ? ",\n" : "\n");
    put_cell(i);
  }
  out.text("\n]}\n").flush();
}

/// \param properties writes the properties after the id.
void put_feature(Writer& out, const Polygons& cells, std::int64_t cell, const auto& properties) {
  out.text(R"({"type":"Feature","geometry":)");
  put_geometry(out, make_rings(cells, cell));
  out.text(R"(,"properties":{"id":)").number(cell);
  properties();
  out.text("}}");
}

/// A text as JSON. Bytes that are not UTF-8 become the replacement character.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void put_fields(Writer& out, const std::vector<const MeshField*>& fields, std::int64_t cell) {
  for (const MeshField* field : fields) {
    out.text(",").text(quoted(field->name)).text(":");
    if (field->integer && std::isfinite(field->values[cell]))
      out.number(static_cast<std::int64_t>(field->values[cell]));
    else
      put_number(out, field->values[cell]);
  }
}

} // namespace

void put_geojson(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  Voronoi voronoi = calotte::voronoi(mesh);
  const CellFields fields = make_cell_fields(voronoi, options);
  const Polygons cells = with_merged_corners(polygons_of(std::move(voronoi)), fields.area);
  const std::vector<const MeshField*> others = select_cell_fields(options, of_voronoi_cells);
  Writer out(sink);
  put_collection(out, cells.size(), [&](std::int64_t i) {
    put_feature(out, cells, i, [&] {
      put_site(out, column(mesh.points, i));
      put_property(out, "area", fields.area[i]);
      put_property(out, "density", fields.density[i]);
      put_property(out, "spacing", fields.spacing[i]);
      put_property(out, "quality", fields.quality[i]);
      out.text(R"(,"degree":)").number(std::int64_t{fields.degree[i]});
      put_fields(out, others, i);
    });
  });
}

void put_geojson(const Sink& sink, const Polygons& given, const WriteOptions& options) {
  const DoubleVector areas = areas_of(given);
  const Polygons polygons = with_merged_corners(given, areas);
  const std::vector<const MeshField*> others = select_cell_fields(options, of_polygons);
  Writer out(sink);
  put_collection(out, polygons.size(), [&](std::int64_t i) {
    put_feature(out, polygons, i, [&] {
      if (polygons.centres.cols() > 0)
        put_site(out, column(polygons.centres, i));
      put_property(out, "area", areas[i]);
      put_fields(out, others, i);
    });
  });
}

} // namespace calotte::io_detail
