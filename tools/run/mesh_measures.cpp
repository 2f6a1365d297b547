// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/mesh_measures.h"

#include "run/operator_measures.h"
#include "run/shapes.h"
#include "text/text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <numbers>
#include <numeric>
#include <sstream>

namespace calotte::tools {
namespace {

ValueRange scaled(const ValueRange& range, double factor) {
  return {range.min * factor, range.mean * factor, range.max * factor};
}

double ratio(const ValueRange& range) { return range.max / range.min; }

nlohmann::ordered_json to_json(const ValueRange& range) {
  return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

nlohmann::ordered_json to_json(const Percentiles& values) {
  return {{"min", values.min}, {"p1", values.p1},   {"p5", values.p5},  {"p50", values.p50},
          {"p95", values.p95}, {"p99", values.p99}, {"max", values.max}};
}

/// The shapes of cells, of which an open mesh has those of whole ones.
void add_shapes(const Quality& quality, nlohmann::ordered_json& json) {
  json["sigma"] = to_json(quality.sigma);
  json["cell_quality"] = to_json(quality.cell_quality);
  json["off_centring"] = to_json(quality.off_centring);
  json["dv_over_dc"] = to_json(quality.dv_over_dc);
  json["short_voronoi_edges"] = quality.short_edges;
}

void add_areas(const ValueRange& areas, nlohmann::ordered_json& json) {
  json["cell_area"] = to_json(areas);
  json["area_ratio"] = ratio(areas);
}

void add_cells(const Quality& quality, nlohmann::ordered_json& json) {
  add_shapes(quality, json);
  add_areas(quality.cell_area, json);
  json["residual"] = quality.residual;
  json["energy"] = quality.energy;
  json["energy_times_cells"] = quality.energy * static_cast<double>(quality.cells);
  json["limit"] = quality.limit;
  json["excess"] = quality.excess;
  json["dc_over_h"] = to_json(quality.dc_over_h);
  json["mismatched_edges"] = quality.mismatched_edges;
  json["bad_cells"] = quality.bad_cells;
  json["bad_spacing"] = to_json(quality.bad_spacing);
  json["cells_area"] = quality.cells_area;
}

/// Sites with a closed ring of triangles.
std::int64_t whole_cells(const Quality& quality) {
  return std::accumulate(quality.degrees.begin(), quality.degrees.end(), std::int64_t(0));
}

/// Cells whose bdyMaskCell is in a range.
std::int64_t cells_of(const std::vector<std::int64_t>& masks, std::size_t first, std::size_t last) {
  std::int64_t count = 0;
  for (std::size_t mask = first; mask <= last && mask < masks.size(); ++mask)
    count += masks[mask];
  return count;
}

void add_boundary(const Measured& measured, nlohmann::ordered_json& json) {
  json["boundary_edges"] = measured.open->boundary;
  json["boundary_loops"] = measured.open->loops;
  json["whole_cells"] = whole_cells(measured.quality);
  if (measured.masks.empty())
    return;
  json["cells_by_mask"] = measured.masks;
  json["cells_inside"] = cells_of(measured.masks, 0, 0);
  json["cells_of_relaxation"] = cells_of(measured.masks, 1, 5);
  json["cells_specified"] = cells_of(measured.masks, 6, 7);
}

/// The measures of cells that an open mesh has.
void add_whole_cells(const Measured& measured, nlohmann::ordered_json& json) {
  const Quality& quality = measured.quality;
  if (whole_cells(quality) > 0 || measured.areas)
    add_areas(measured.areas.value_or(quality.cell_area), json);
  if (measured.areas)
    json["cells_area"] = measured.cells_area;
  if (whole_cells(quality) == 0)
    return;
  add_shapes(quality, json);
  json["bad_cells"] = quality.bad_cells;
  json["bad_spacing"] = to_json(quality.bad_spacing);
}

/// The counts that are not 0, each after its index.
std::string counts_text(const std::vector<std::int64_t>& counts) {
  std::vector<std::string> list;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] > 0)
      list.push_back(message("{}: {}", i, counts[i]));
  return listed(list);
}

/// Aligned rows of names and values.
class Table {
public:
  template <class Value> void row(const std::string& name, const Value& value, int digits = 6) {
    out_ << std::left << std::setw(22) << name << std::setprecision(digits) << value << "\n";
  }
  template <class Value>
  void row(const std::string& name, const Value& min, const Value& mean, const Value& max) {
    out_ << std::left << std::setw(22) << name << std::setprecision(6) << std::setw(14) << min
         << std::setw(14) << mean << max << "\n";
  }
  void row(const std::string& name, const ValueRange& range) {
    row(name, range.min, range.mean, range.max);
  }
  /// Two lines: the names of the percentiles, and their values.
  void row(const std::string& name, const Percentiles& values) {
    line<std::string>("", {"min", "1%", "5%", "50%", "95%", "99%", "max"});
    line<double>(
        name, {values.min, values.p1, values.p5, values.p50, values.p95, values.p99, values.max});
  }
  std::string text() const { return out_.str(); }

private:
  template <class Value> void line(const std::string& name, const std::array<Value, 7>& values) {
    out_ << std::left << std::setw(22) << name << std::setprecision(4);
    for (std::size_t k = 0; k < values.size(); ++k)
      out_ << std::setw(k + 1 < values.size() ? 11 : 0) << values[k];
    out_ << "\n";
  }

  std::ostringstream out_;
};

/// \param of_whole the areas of whole cells, where those of all are not known.
void add_area_row(const Measured& measured, const ValueRange& of_whole, Table& table) {
  table.row(measured.domain_area ? "cell area" : "cell area, " + measured.unit.area,
            scaled(measured.areas.value_or(of_whole), measured.unit.of_steradian));
}

/// The shapes of cells, which those of an open mesh have, too.
void add_shape_rows(const Measured& measured, Table& table) {
  const Quality& quality = measured.quality;
  table.row("sigma", quality.sigma);
  table.row("cell quality", quality.cell_quality);
  add_area_row(measured, quality.cell_area, table);
  table.row("off-centring", quality.off_centring);
  table.row("dv / dc", quality.dv_over_dc);
  table.row("area ratio", ratio(measured.areas.value_or(quality.cell_area)));
  table.row("dv / dc below " + shortest(short_voronoi_edge), quality.short_edges);
}

void add_bad_cells(const Measured& measured, Table& table) {
  table.row("cells to object to", measured.quality.bad_cells);
  if (measured.quality.bad_cells > 0)
    table.row("their spacing", scaled(measured.quality.bad_spacing, measured.unit.of_radian));
}

/// The boundary of an open mesh, and its cells by bdyMaskCell.
void add_boundary_rows(const Measured& measured, Table& table) {
  if (!measured.masks.empty()) {
    table.row("  in the region", cells_of(measured.masks, 0, 0));
    table.row("  relaxation, 1 to 5", cells_of(measured.masks, 1, 5));
    table.row("  specified, 6 and 7", cells_of(measured.masks, 6, 7));
    table.row("bdyMaskCell: cells", counts_text(measured.masks));
  }
  table.row("boundary edges", measured.open->boundary);
  table.row("boundary loops", measured.open->loops);
  table.row("whole cells", whole_cells(measured.quality));
}

void add_cell_rows(const Measured& measured, Table& table) {
  const Quality& quality = measured.quality;
  const bool plane = measured.domain_area.has_value();
  const double area = measured.domain_area.value_or(1);
  add_shape_rows(measured, table);
  table.row("density", measured.density);
  table.row("residual / h", quality.residual);
  table.row("energy", quality.energy, 7);
  table.row(plane ? "energy * cells / A^2" : "energy * cells",
            quality.energy * static_cast<double>(quality.cells) / (area * area), 7);
  table.row("its limit", quality.limit / (area * area), 7);
  table.row("excess, percent", 100 * quality.excess, 4);
  table.row("dc / h", quality.dc_over_h);
  table.row("outside 0.75 to 1.4", quality.mismatched_edges);
  add_bad_cells(measured, table);
  table.row(plane ? "cells / domain" : "cells / 4 pi", quality.cells_area, 15);
}

} // namespace

std::string to_json(const Measured& measured) {
  const Quality& quality = measured.quality;
  nlohmann::ordered_json json;
  if (!measured.changes.empty())
    json["changes"] = measured.changes;
  if (!measured.remarks.empty())
    json["remarks"] = measured.remarks;
  json["cells"] = quality.cells;
  json["triangles"] = quality.triangles;
  json["degrees"] = nlohmann::ordered_json::object();
  for (std::size_t degree = 0; degree < quality.degrees.size(); ++degree)
    if (quality.degrees[degree] > 0)
      json["degrees"][std::to_string(degree)] = quality.degrees[degree];
  json["obtuse"] = quality.obtuse;
  json["spacing"] = to_json(quality.spacing);
  json["triangle_quality"] = to_json(quality.triangle_quality);
  json["angles"] = to_json(quality.angles);
  if (measured.radius_km) {
    json["radius_km"] = *measured.radius_km;
    json["spacing_km"] = to_json(scaled(quality.spacing, *measured.radius_km));
    json["least_dc_km"] = quality.spacing.min * *measured.radius_km;
    if (const ValueRange area = measured.areas.value_or(quality.cell_area); area.max > 0)
      json["cell_area_km2"] = to_json(scaled(area, *measured.radius_km * *measured.radius_km));
  }
  if (measured.open)
    add_boundary(measured, json);
  if (measured.cells && measured.open) {
    add_whole_cells(measured, json);
  } else if (measured.cells) {
    json["density"] = measured.density;
    add_cells(quality, json);
  }
  if (measured.domain_area)
    json["domain_area"] = *measured.domain_area;
  else
    json["triangles_area"] = quality.triangles_area;
  if (measured.operators)
    json["operators"] = operators_to_json(*measured.operators, !measured.domain_area);
  if (measured.gates)
    json["demands"] = to_json(*measured.gates);
  return json.dump(2) + "\n";
}

std::string table(const Measured& measured) {
  const Quality& quality = measured.quality;
  const bool plane = measured.domain_area.has_value();
  Table table;
  table.row("cells", quality.cells);
  if (measured.open)
    add_boundary_rows(measured, table);
  table.row("triangles", quality.triangles);
  if (const std::string degrees = counts_text(quality.degrees); !degrees.empty())
    table.row("degree: cells", degrees);
  table.row<std::string>("", "min", "mean", "max");
  table.row(plane ? "spacing" : "spacing, " + measured.unit.name,
            scaled(quality.spacing, measured.unit.of_radian));
  table.row("triangle quality", quality.triangle_quality);
  table.row("angles, degrees", quality.angles);
  table.row("obtuse triangles", quality.obtuse);
  if (measured.cells && measured.open) {
    if (whole_cells(quality) > 0) {
      add_shape_rows(measured, table);
      add_bad_cells(measured, table);
    } else if (measured.areas) {
      add_area_row(measured, {}, table);
    }
  } else if (measured.cells) {
    add_cell_rows(measured, table);
  }
  if (measured.areas)
    table.row("cells / 4 pi", measured.cells_area, 15);
  if (!plane)
    table.row("triangles / 4 pi", quality.triangles_area, 15);
  return table.text() +
         (measured.operators
              ? operator_rows(*measured.operators, plane ? Unit() : measured.unit, !plane)
              : "") +
         (measured.gates ? tools::table(*measured.gates) : "");
}

std::string table(const Polygons& polygons, const std::optional<Mesh>& mesh, const Unit& unit) {
  std::vector<std::int64_t> sides;
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    const auto count = static_cast<std::size_t>(polygons.ids.count(i));
    sides.resize(std::max(sides.size(), count + 1));
    ++sides[count];
  }
  Table table;
  table.row("cells", polygons.size());
  table.row("corners", polygons.corners.cols());
  table.row("sides: cells", counts_text(sides));
  const PolygonShapes found = shapes(polygons);
  table.row<std::string>("", "min", "mean", "max");
  const bool plane = !polygons.surface.is_sphere();
  if (found.spacing.max > 0)
    table.row(plane ? "spacing" : "spacing, " + unit.name, scaled(found.spacing, unit.of_radian));
  table.row(plane ? "cell area" : "cell area, " + unit.area, scaled(found.area, unit.of_steradian));
  const double sum = areas(polygons).sum();
  table.row(plane ? "sum of areas" : "cells / 4 pi", plane ? sum : sum / (4 * std::numbers::pi),
            15);
  return table.text() + shape_rows(found, mesh, 22);
}

std::string to_json(const Polygons& polygons, const std::optional<Mesh>& mesh,
                    const Measured& measured) {
  const PolygonShapes found = shapes(polygons);
  nlohmann::ordered_json json;
  json["changes"] = measured.changes;
  json["remarks"] = measured.remarks;
  json["cells"] = polygons.size();
  json["corners"] = polygons.corners.cols();
  if (found.spacing.max > 0)
    json["spacing"] = to_json(found.spacing);
  json["cell_area"] = to_json(found.area);
  if (measured.radius_km) {
    json["radius_km"] = *measured.radius_km;
    json["spacing_km"] = to_json(scaled(found.spacing, *measured.radius_km));
    json["cell_area_km2"] = to_json(scaled(found.area, *measured.radius_km * *measured.radius_km));
  }
  json["cells_area"] =
      areas(polygons).sum() / (polygons.surface.is_sphere() ? 4 * std::numbers::pi : 1);
  add_shapes(found, mesh, json);
  return json.dump(2) + "\n";
}

} // namespace calotte::tools
