// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/mesh_source.h"
#include "options/sphere_radius_option.h"
#include "options/units_option.h"
#include "run/progress.h"
#include "run/shapes.h"

#include <calotte/check.h>
#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/quality.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <optional>
#include <sstream>

namespace calotte::tools {
namespace {

struct Request {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::shared_ptr<DomainWords> domain; ///< of a mesh of the plane
  std::optional<double> sphere_radius; ///< metres
  std::optional<std::string> units;    ///< --units
  std::string report;
};

/// The quality of a mesh, and the area of its domain.
struct Measured {
  Quality quality;
  std::optional<double> domain_area; ///< of a plane
  std::optional<double> radius_km;   ///< of the sphere, if known
  Unit unit;                         ///< of distances on it
  std::string density = "uniform";   ///< its name
  bool cells = true; ///< false for a mesh without Voronoi cells: its triangles alone are measured
  std::vector<std::string> changes; ///< that reading made
  std::vector<std::string> remarks; ///< about the mesh, one line each
};

Range scaled(const Range& range, double factor) {
  return {range.min * factor, range.mean * factor, range.max * factor};
}

double ratio(const Range& range) { return range.max / range.min; }

nlohmann::ordered_json to_json(const Range& range) {
  return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

nlohmann::ordered_json to_json(const Percentiles& values) {
  return {{"min", values.min}, {"p1", values.p1},   {"p5", values.p5},  {"p50", values.p50},
          {"p95", values.p95}, {"p99", values.p99}, {"max", values.max}};
}

void add_cells(const Quality& quality, nlohmann::ordered_json& json) {
  json["sigma"] = to_json(quality.sigma);
  json["cell_quality"] = to_json(quality.cell_quality);
  json["cell_area"] = to_json(quality.cell_area);
  json["area_ratio"] = ratio(quality.cell_area);
  json["off_centring"] = to_json(quality.off_centring);
  json["dv_over_dc"] = to_json(quality.dv_over_dc);
  json["short_voronoi_edges"] = quality.short_edges;
  json["residual"] = quality.residual;
  json["energy"] = quality.energy;
  json["energy_times_cells"] = quality.energy * static_cast<double>(quality.cells);
  json["limit"] = quality.limit;
  json["excess"] = quality.excess;
  json["dc_over_h"] = to_json(quality.dc_over_h);
  json["unfit_edges"] = quality.unfit_edges;
  json["bad_cells"] = quality.bad_cells;
  json["bad_spacing"] = to_json(quality.bad_spacing);
  json["cells_area"] = quality.cells_area;
}

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
  }
  if (measured.cells) {
    json["density"] = measured.density;
    add_cells(quality, json);
  }
  if (measured.domain_area)
    json["domain_area"] = *measured.domain_area;
  else
    json["triangles_area"] = quality.triangles_area;
  return json.dump(2) + "\n";
}

std::string degrees(const Quality& quality) {
  std::string list;
  for (std::size_t degree = 0; degree < quality.degrees.size(); ++degree)
    if (quality.degrees[degree] > 0)
      list += (list.empty() ? "" : ", ") + std::to_string(degree) + ": " +
              std::to_string(quality.degrees[degree]);
  return list;
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
  void row(const std::string& name, const Range& range) {
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

void add_cell_rows(const Measured& measured, Table& table) {
  const Quality& quality = measured.quality;
  const bool plane = measured.domain_area.has_value();
  const double area = measured.domain_area.value_or(1);
  table.row("sigma", quality.sigma);
  table.row("cell quality", quality.cell_quality);
  table.row(plane ? "cell area" : "cell area, " + measured.unit.area,
            scaled(quality.cell_area, measured.unit.of_steradian));
  table.row("off-centring", quality.off_centring);
  table.row("dv / dc", quality.dv_over_dc);
  table.row("area ratio", ratio(quality.cell_area));
  table.row("dv / dc below 0.2", quality.short_edges);
  table.row("density", measured.density);
  table.row("residual / h", quality.residual);
  table.row("energy", quality.energy, 7);
  table.row(plane ? "energy * cells / A^2" : "energy * cells",
            quality.energy * static_cast<double>(quality.cells) / (area * area), 7);
  table.row("its limit", quality.limit / (area * area), 7);
  table.row("excess, percent", 100 * quality.excess, 4);
  table.row("dc / h", quality.dc_over_h);
  table.row("outside 0.75 to 1.4", quality.unfit_edges);
  table.row("cells to object to", quality.bad_cells);
  if (quality.bad_cells > 0)
    table.row("their spacing", scaled(quality.bad_spacing, measured.unit.of_radian));
  table.row(plane ? "cells / domain" : "cells / 4 pi", quality.cells_area, 15);
}

std::string table(const Measured& measured) {
  const Quality& quality = measured.quality;
  const bool plane = measured.domain_area.has_value();
  Table table;
  table.row("cells", quality.cells);
  table.row("triangles", quality.triangles);
  table.row("degree: cells", degrees(quality));
  table.row<std::string>("", "min", "mean", "max");
  table.row(plane ? "spacing" : "spacing, " + measured.unit.name,
            scaled(quality.spacing, measured.unit.of_radian));
  table.row("triangle quality", quality.triangle_quality);
  table.row("angles, degrees", quality.angles);
  table.row("obtuse triangles", quality.obtuse);
  if (measured.cells)
    add_cell_rows(measured, table);
  if (!plane)
    table.row("triangles / 4 pi", quality.triangles_area, 15);
  return table.text();
}

/// The report replaces no input.
void require_report(const Request& request) {
  const WidthWords& widths = request.density->widths;
  require_outputs({{"report", request.report}},
                  {request.source->path, request.source->points, widths.file, widths.raster,
                   request.domain->file.value_or("")});
}

/// The given domain, or the box of the mesh.
PlanarDomain domain_of(const Request& request, const PlanarMesh& mesh) {
  if (const std::optional<PlanarDomain> given = domain_of(*request.domain))
    return *given;
  if (mesh.period.minCoeff() > 0)
    return periodic_box(mesh.period);
  throw Error(ErrorCode::bad_option, request.source->path +
                                         ": a planar mesh needs its domain, which clips the cells; "
                                         "give --domain, --rectangle or --periodic");
}

/// The radius that is given, that of a NetCDF file, or the one that the widths refer to.
std::optional<double> radius_of(const Request& request, const MeshFile& file) {
  constexpr double metres = 1000; // a km
  if (request.sphere_radius)
    return *request.sphere_radius / metres;
  if (const std::optional<double> of_file = radius_km(*request.source, file))
    return of_file;
  if (request.density->widths.in_km())
    return request.density->widths.radius;
  return std::nullopt;
}

/// The density that is given, or else that of the file.
Density density_of(const Request& request, const MeshFile& file, Measured& measured) {
  const Density given = density_of(*request.density, request.source->plane);
  measured.density = density_name(*request.density);
  if (!given.uniform() || file.density.size() == 0 || !file.mesh ||
      file.density.minCoeff() == file.density.maxCoeff())
    return given;
  measured.density = "of the file";
  measured.remarks.emplace_back("the density is the file's, interpolated between the sites");
  return interpolated_density(*file.mesh, file.density);
}

/// Whether a mesh has Voronoi cells that cover the sphere; if not, a remark tells why.
bool has_voronoi_cells(const Mesh& mesh, Measured& measured) {
  const EdgeCounts edges = count_edges(mesh);
  if (edges.boundary > 0)
    measured.remarks.push_back("the mesh is open: " + std::to_string(edges.boundary) +
                               " boundary edges in " + std::to_string(edges.loops) +
                               (edges.loops == 1 ? " loop" : " loops") +
                               "; its triangles are measured");
  if (edges.not_delaunay > 0)
    measured.remarks.push_back(std::to_string(edges.not_delaunay) +
                               " edges are not Delaunay; the triangles are measured");
  return edges.boundary == 0 && edges.not_delaunay == 0;
}

void measure_sphere(const Request& request, const MeshFile& file, Measured& measured) {
  const Mesh& mesh = *file.mesh;
  measured.radius_km = radius_of(request, file);
  measured.unit = unit_of(request.units, measured.radius_km);
  measured.cells = has_voronoi_cells(mesh, measured);
  measured.quality =
      measured.cells ? quality(mesh, density_of(request, file, measured)) : triangle_quality(mesh);
}

void measure_plane(const Request& request, const MeshFile& file, Measured& measured) {
  const PlanarDomain domain = domain_of(request, *file.plane);
  measured.density = density_name(*request.density);
  measured.quality = quality(*file.plane, domain, density_of(*request.density, true));
  measured.domain_area = area(domain);
}

/// Polygons that are not Voronoi cells: their number of sides and their areas.
std::string table(const Polygons& polygons, const std::optional<Mesh>& mesh, const Unit& unit) {
  const Eigen::VectorXd area = areas(polygons);
  std::vector<std::int64_t> sides;
  for (std::int64_t i = 0; i < polygons.size(); ++i) {
    const auto count = static_cast<std::size_t>(polygons.begin[i + 1] - polygons.begin[i]);
    sides.resize(std::max(sides.size(), count + 1));
    ++sides[count];
  }
  Quality counts;
  counts.degrees = sides;
  Table table;
  table.row("cells", polygons.size());
  table.row("corners", polygons.corners.cols());
  table.row("sides: cells", degrees(counts));
  table.row<std::string>("", "min", "mean", "max");
  table.row("cell area, " + unit.area,
            scaled({area.minCoeff(), area.mean(), area.maxCoeff()}, unit.of_steradian));
  table.row("cells / 4 pi", area.sum() / (4 * std::numbers::pi), 15);
  return table.text() + shape_rows(polygons, mesh, 22);
}

std::string to_json(const Polygons& polygons, const std::optional<Mesh>& mesh,
                    const Measured& measured) {
  const Eigen::VectorXd area = areas(polygons);
  nlohmann::ordered_json json;
  json["changes"] = measured.changes;
  json["remarks"] = measured.remarks;
  json["cells"] = polygons.size();
  json["corners"] = polygons.corners.cols();
  json["cell_area"] = to_json(Range{area.minCoeff(), area.mean(), area.maxCoeff()});
  json["cells_area"] = area.sum() / (4 * std::numbers::pi);
  add_shapes(polygons, mesh, json);
  return json.dump(2) + "\n";
}

std::string remarks_of(const Request& request, const Measured& measured) {
  std::string lines;
  for (const auto* list : {&measured.changes, &measured.remarks})
    for (const std::string& remark : *list)
      lines += request.source->path + ": " + remark + "\n";
  return lines;
}

/// The table to print. Writes the report, too.
std::string read_and_measure(const Request& request) {
  Progress progress;
  progress.stage("reading " + request.source->path);
  const MeshFile file = read_mesh_file(*request.source, FieldChoice::none);
  progress.stage("measuring " + request.source->path);
  Measured measured;
  measured.changes = file.changes;
  const bool as_polygons = !file.plane && file.polygons && !(file.mesh && !file.mesh->closed());
  if (as_polygons) {
    measured.remarks.push_back("the cells are not Voronoi cells: " + file.not_voronoi);
    measured.unit = unit_of(request.units, radius_of(request, file));
  } else if (file.plane)
    measure_plane(request, file, measured);
  else
    measure_sphere(request, file, measured);
  if (!request.report.empty())
    write_file(request.report,
               as_polygons ? to_json(*file.polygons, file.mesh, measured) : to_json(measured));
  return remarks_of(request, measured) +
         (as_polygons ? table(*file.polygons, file.mesh, measured.unit) : table(measured));
}

void require_radius(const Request& request) {
  require_sphere_radius(request.sphere_radius.value_or(1));
  if (request.sphere_radius && request.source->plane)
    throw Error(ErrorCode::bad_option, "--sphere-radius does not apply with --plane; leave it out");
  if (request.units && request.source->plane)
    throw Error(ErrorCode::bad_option, "--units does not apply with --plane; leave it out");
}

void run(const Request& request) {
  if (request.domain->given() && !request.source->plane)
    throw Error(ErrorCode::bad_option,
                "a domain requires --plane; add --plane, or leave the domain out");
  require_radius(request);
  require_report(request);
  std::cout << read_and_measure(request);
}

} // namespace

void add_info(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("info", "Measures a closed mesh or a planar mesh: spacing, quality of "
                                 "cells and triangles, and distance from a CVT.");
  auto request = std::make_shared<Request>();
  request->source = add_mesh_source(*command);
  add_plane(*command, *request->source);
  request->domain = add_domain(*command);
  request->density = add_density(*command);
  add_sphere_radius(*command, request->sphere_radius,
                    "Radius of the sphere, for distances in km: metres, > 0, or earth (6371229 m); "
                    "default: the one in a NetCDF file, or --earth-radius with --cell-width");
  add_units(*command, request->units);
  command->add_option("--report", request->report, "Write the same quantities to this JSON file")
      ->type_name("FILE");
  set_help(*command,
           {.common = {"MESH", "--points", "--plane", "--domain", "--density", "--cell-width",
                       "--sphere-radius", "--units", "--report"},
            .examples = {"calotte info mesh.nc",
                         "calotte info mesh.vtp --sphere-radius earth --cell-width 60km"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
