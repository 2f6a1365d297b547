// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/mesh_source.h"
#include "run/progress.h"

#include <calotte/error.h>
#include <calotte/io.h>
#include <calotte/quality.h>

#include <nlohmann/json.hpp>

#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

namespace calotte::tools {
namespace {

struct Request {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::shared_ptr<DomainWords> domain; ///< of a mesh of the plane
  std::string report;
};

/// What was measured, and where.
struct Measured {
  Quality quality;
  std::optional<double> domain_area; ///< of a plane
};

double ratio(const Range& range) { return range.max / range.min; }

nlohmann::ordered_json to_json(const Range& range) {
  return {{"min", range.min}, {"mean", range.mean}, {"max", range.max}};
}

std::string to_json(const Measured& measured) {
  const Quality& quality = measured.quality;
  nlohmann::ordered_json json;
  json["cells"] = quality.cells;
  json["triangles"] = quality.triangles;
  json["degrees"] = nlohmann::ordered_json::object();
  for (std::size_t degree = 0; degree < quality.degrees.size(); ++degree)
    if (quality.degrees[degree] > 0)
      json["degrees"][std::to_string(degree)] = quality.degrees[degree];
  json["obtuse"] = quality.obtuse;
  json["spacing"] = to_json(quality.spacing);
  json["sigma"] = to_json(quality.sigma);
  json["cell_quality"] = to_json(quality.cell_quality);
  json["cell_area"] = to_json(quality.cell_area);
  json["area_ratio"] = ratio(quality.cell_area);
  json["triangle_quality"] = to_json(quality.triangle_quality);
  json["angles"] = to_json(quality.angles);
  json["off_centring"] = to_json(quality.off_centring);
  json["residual"] = quality.residual;
  json["energy"] = quality.energy;
  json["energy_times_cells"] = quality.energy * static_cast<double>(quality.cells);
  json["cells_area"] = quality.cells_area;
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

/// A name and what belongs to it, beneath those before.
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
  std::string text() const { return out_.str(); }

private:
  std::ostringstream out_;
};

std::string table(const Measured& measured) {
  const Quality& quality = measured.quality;
  const bool plane = measured.domain_area.has_value();
  const double area = measured.domain_area.value_or(1);
  Table table;
  table.row("cells", quality.cells);
  table.row("triangles", quality.triangles);
  table.row("degree: cells", degrees(quality));
  table.row<std::string>("", "min", "mean", "max");
  table.row(plane ? "spacing" : "spacing, radians", quality.spacing);
  table.row("sigma", quality.sigma);
  table.row("cell quality", quality.cell_quality);
  table.row(plane ? "cell area" : "cell area, steradians", quality.cell_area);
  table.row("triangle quality", quality.triangle_quality);
  table.row("angles, degrees", quality.angles);
  table.row("off-centring", quality.off_centring);
  table.row("area ratio", ratio(quality.cell_area));
  table.row("obtuse triangles", quality.obtuse);
  table.row("residual / h", quality.residual);
  table.row("energy", quality.energy, 7);
  table.row(plane ? "energy * cells / A^2" : "energy * cells",
            quality.energy * static_cast<double>(quality.cells) / (area * area), 7);
  table.row(plane ? "cells / domain" : "cells / 4 pi", quality.cells_area, 15);
  if (!plane)
    table.row("triangles / 4 pi", quality.triangles_area, 15);
  return table.text();
}

void require_outputs(const Request& request) {
  if (request.report.empty())
    return;
  require_folder(request.report);
  require_distinct(request.report, request.source->path);
  require_distinct(request.report, request.source->points);
}

/// The domain that is given, or the box of the mesh.
PlanarDomain domain_of(const Request& request, const PlanarMesh& mesh) {
  if (const std::optional<PlanarDomain> given = domain_of(*request.domain))
    return *given;
  if (mesh.period.minCoeff() > 0)
    return periodic_box(mesh.period);
  throw Error(ErrorCode::bad_option, request.source->path +
                                         ": a planar mesh needs its domain, which clips the cells; "
                                         "give --domain, --rectangle or --periodic");
}

Measured read_and_measure(const Request& request) {
  const bool plane = request.source->plane;
  const Density density = density_of(*request.density, plane);
  Progress progress;
  progress.stage("reading " + request.source->path);
  if (plane) {
    const PlanarMesh mesh = read_planar_mesh(*request.source);
    const PlanarDomain domain = domain_of(request, mesh);
    progress.stage("measuring " + request.source->path);
    return {quality(mesh, domain, density), area(domain)};
  }
  const Mesh mesh = read_mesh(*request.source);
  progress.stage("measuring " + request.source->path);
  return {quality(mesh, density), {}};
}

void run(const Request& request) {
  if (request.domain->given() && !request.source->plane)
    throw Error(ErrorCode::bad_option,
                "a domain requires --plane; add --plane, or leave the domain out");
  require_outputs(request);
  const Measured measured = read_and_measure(request);
  if (!request.report.empty())
    write_file(request.report, to_json(measured));
  std::cout << table(measured);
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
  command->add_option("--report", request->report, "Write the same quantities to this JSON file");
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
