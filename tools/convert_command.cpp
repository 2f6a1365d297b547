// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/coast_option.h"
#include "options/config_option.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/mesh_source.h"
#include "options/numbers.h"
#include "options/sphere_radius_option.h"
#include "run/exit_code.h"
#include "run/progress.h"
#include "run/shapes.h"
#include "text/text.h"

#include <calotte/mesh_file.h>
#include <calotte/version.h>

#include <CLI/App.hpp>

#include <array>
#include <iostream>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

struct ConvertRequest {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::shared_ptr<FormatWords> format;
  std::shared_ptr<DomainWords> domain; ///< of a mesh of the plane
  CoastWords coast;                    ///< for models of the coastal ocean
  std::shared_ptr<std::string> config;
  std::string output;
};

/// Checks all options that can fail, before any input is read.
void require_request(const ConvertRequest& request) {
  const MeshSource& source = *request.source;
  const Format format = options_of(*request.format, request.output)
                            .format; // throws for a file that cannot be written
  require_coast(request.coast, request.output, format);
  const WidthWords& widths = request.density->widths;
  std::vector<std::string> inputs = files_of(request.coast);
  inputs.insert(inputs.end(), {source.path, source.points, widths.file, widths.raster,
                               request.domain->file.value_or(""), *request.config});
  require_outputs({{"mesh", request.output}}, inputs);
  if (source.points.empty() && (source.path == "-" || holds_triangles(source.path)))
    refuse(message("{} holds triangles without points; give the points with --points FILE, or, if "
                   "the file holds points, triangulate them with calotte delaunay",
                   source.path));
}

/// Whether the radius is that of the file.
bool keeps_radius(const ConvertRequest& request) {
  return !request.format->sphere_radius && !request.format->model;
}

/// Whether neither the options nor the file say what density the mesh was made for. Writers of
/// other programs store 1 then.
bool lacks_density(const ConvertRequest& request, const MeshFile& file) {
  return request.density->densities.empty() && !request.density->widths.given() &&
         (file.density.size() == 0 || file.density.minCoeff() == file.density.maxCoeff());
}

WriteOptions write_options(const ConvertRequest& request, const Density& density,
                           const MeshFile& file) {
  WriteOptions options = options_of(*request.format, request.output);
  if (keeps_radius(request))
    options.sphere_radius = file.radius_in_metres();
  if (!request.format->model)
    options.vertex_order = file.vertex_order;
  options.density = density;
  if (is_mpas(options.format) && lacks_density(request, file))
    options.site_density = spacing_density(file);
  set_coast(request.coast, file, options);
  options.history = "calotte " CALOTTE_VERSION " convert: " + request.source->path;
  return options;
}

std::string describe_mesh(const MeshFile& file) {
  const Mesh* plane = file.plane();
  if (plane && file.polygons)
    return message("{} {}", file.polygons->size(),
                   plane->surface.period().maxCoeff() > 0 ? "cells of a channel"
                                                          : "clipped cells of a plane");
  if (const Polygons* cells = plane ? nullptr : file.other_cells())
    return message("{} cells, not Voronoi cells: {}", cells->size(), file.not_voronoi.text());
  const Mesh& mesh = *file.mesh;
  return message("{} sites, {} triangles, {}", mesh.points.cols(), mesh.triangles.cols(),
                 !plane                  ? (mesh.closed() ? "closed" : "open")
                 : mesh.surface.is_box() ? "a periodic plane"
                                         : "a plane");
}

std::string renamed(const std::vector<std::array<std::string, 2>>& names) {
  std::vector<std::string> list;
  for (const auto& [from, to] : names)
    list.push_back(message("\"{}\" became {}", from, to));
  return listed(list);
}

/// What the output does not hold of the input, and a unit that was assumed.
std::string remarks(const ConvertRequest& request, const MeshFile& file,
                    const WriteOptions& options, const WrittenFields& written) {
  std::string lines;
  if (file.radius_in_metres() != file.sphere_radius && keeps_radius(request) &&
      request.output.ends_with(".nc"))
    lines += message("{}: the radius {} is taken as kilometres and written as {} metres\n",
                     request.output, shortest(file.sphere_radius), shortest(options.sphere_radius));
  if (!written.dropped.empty())
    lines += message("{}: the format does not hold {}\n", request.output, listed(written.dropped));
  if (!written.renamed.empty())
    lines +=
        message("{}: names that NetCDF refuses: {}\n", request.output, renamed(written.renamed));
  if (!file.ignored.empty())
    lines += message("{}: not converted: {}\n", request.output, listed(file.ignored));
  if (options.site_density.size() > 0)
    lines += derived_density(request.output, options.site_density);
  if (!file.plane())
    lines += suited_models(request.output, options);
  return lines;
}

/// \throws Error invalid_argument, where the domain of a plane is missing or has no effect.
MeshFile read_input(const ConvertRequest& request) {
  MeshFile file = read_mesh_file(*request.source, FieldChoice::all);
  const bool unbounded = file.plane() && file.mesh->surface.period().maxCoeff() == 0;
  const std::optional<Surface> part = surface_of(*request.domain);
  if (part && !unbounded)
    refuse(message("{} holds no mesh of a bounded plane; leave --domain and --rectangle out",
                   request.source->path));
  const Format format = options_of(*request.format, request.output).format;
  if (part)
    file.mesh->surface = *part;
  else if (unbounded && !file.polygons && info_of(format).cells)
    refuse_path(request.output, "the cells of a bounded plane need its domain, which clips them; "
                                "give --domain FILE or --rectangle X0,Y0,X1,Y1");
  return file;
}

void run(const ConvertRequest& request) {
  require_request(request);
  const Density density = density_of(*request.density);
  std::string words, fault;
  {
    Progress progress;
    progress.stage("reading " + request.source->path);
    MeshFile file = read_input(request);
    const std::string ears =
        remove_ears(request.output, options_of(*request.format, request.output).format, file);
    WriteOptions options = write_options(request, density, file);
    options.progress = progress.writing(request.output);
    const WrittenFields written = write(request.output, file, options);
    words = changes_of(*request.source, file) + ears +
            missing_depths(request.output, options, file) +
            remarks(request, file, options, written) +
            message("{}: {}\n", request.output, describe_mesh(file));
    if (file.polygons)
      fault = without_area(shapes(*file.polygons));
  }
  std::cout << words;
  if (!fault.empty())
    finish(check_failed, message("{}: {}", request.source->path, fault));
}

} // namespace

void add_convert(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "convert", "Converts a mesh, its density and its fields to another format. Points, "
                 "triangles and cells do not change.");
  auto request = std::make_shared<ConvertRequest>();
  request->source = add_mesh_source(*command, "IN,--input");
  add_plane(*command, *request->source);
  command->add_option("OUT,-o,--output", request->output, help_of_output())
      ->type_name("FILE")
      ->required();
  request->domain = add_bounded_domain(*command);
  request->format =
      add_format(*command, {.radius = "the radius of the points if all lie on one sphere, else 1"});
  add_coast(*command, request->coast);
  request->density = add_density(*command);
  request->config = add_config(*command);
  set_help(*command,
           {.common = {"IN", "OUT", "--points", "--domain", "--for", "--format", "--sphere-radius",
                       "--order", "--density", "--cell-width", "--config"},
            .examples = {"calotte convert mesh.vtp mesh.nc --for mpas-atmosphere",
                         "calotte convert mesh.nc grid.nc --format scrip"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
