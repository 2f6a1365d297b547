// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "help/help.h"
#include "io/command.h"
#include "options/config_option.h"
#include "options/files.h"
#include "options/format_options.h"
#include "options/mesh_source.h"
#include "options/numbers.h"
#include "run/exit_code.h"
#include "run/interruption.h"
#include "run/mesh_findings.h"
#include "run/progress.h"
#include "text/text.h"

#include <calotte/rotate.h>
#include <calotte/version.h>

#include <CLI/App.hpp>

#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

struct RotateRequest {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<FormatWords> format;
  std::shared_ptr<std::string> config;
  std::string from, to, output;
  double bearing = 0;
};

/// \throws Error invalid_argument for other text.
Eigen::Vector2d lonlat_of(const char* option, const std::string& word) {
  const auto degrees = numbers_of<2>(word);
  require(degrees && std::abs((*degrees)[0]) <= 720 && std::abs((*degrees)[1]) <= 90,
          "{} {}: this is no place; give LON,LAT in degrees, as in -105,40", option, word);
  return {(*degrees)[0], (*degrees)[1]};
}

Rotation rotation_of(const RotateRequest& request) {
  require(std::isfinite(request.bearing) && std::abs(request.bearing) <= 720,
          "--bearing {}: give degrees, clockwise from north, as in 30", request.bearing);
  return {lonlat_of("--from", request.from), lonlat_of("--to", request.to), request.bearing};
}

/// Checks all options that can fail, before any input is read.
void require_request(const RotateRequest& request) {
  rotation_of(request);
  const Format format = options_of(*request.format, request.output).format;
  if (!info_of(format).points)
    refuse_path(request.output, "the format holds triangles without points, which a rotation does "
                                "not change; write the mesh to a format with points, such as .vtp");
  require_outputs({{"mesh", request.output}},
                  {request.source->path, request.source->points, *request.config});
}

/// Whether no option asks for another format than that of an MPAS file.
bool keeps_mpas(const RotateRequest& request) {
  const FormatWords& words = *request.format;
  return !words.format && !words.order && !words.sphere_radius && !words.model &&
         is_mpas(options_of(words, request.output).format);
}

std::string history_of(const RotateRequest& request) {
  return message("calotte " CALOTTE_VERSION " rotate: {} --from {} --to {}{}", request.source->path,
                 request.from, request.to,
                 request.bearing == 0 ? "" : " --bearing " + shortest(request.bearing));
}

WriteOptions write_options(const RotateRequest& request, const MeshFile& file) {
  WriteOptions options = options_of(*request.format, request.output);
  if (!request.format->sphere_radius && !request.format->model)
    options.sphere_radius = file.radius_in_metres();
  if (!request.format->model)
    options.vertex_order = file.vertex_order;
  if (!request.format->order)
    options.numbering = Numbering::input;
  options.history = history_of(request);
  return options;
}

std::string describe_fields(const RotateRequest& request, const TurnedFields& fields) {
  std::string lines;
  const auto list = [&](const std::string& what, const std::vector<std::string>& names) {
    if (!names.empty())
      lines += message("{}: {}: {}\n", request.output, what, listed(names));
  };
  list("turned with the mesh", fields.turned);
  list("computed anew from the latitude", fields.coriolis);
  list("moved with the mesh, with the values of the old place (make anew what is geography)",
       fields.moved);
  list("NOT turned, wrong at the new place", fields.unturned);
  return lines;
}

std::string describe_written(const RotateRequest& request, const MeshFile& file,
                             const WrittenFields& written) {
  std::string lines;
  if (!written.dropped.empty())
    lines += message("{}: the format does not hold {}\n", request.output, listed(written.dropped));
  if (!file.ignored.empty())
    lines += message("{}: not read: {}\n", request.output, listed(file.ignored));
  return lines;
}

/// Copies an MPAS file, and rotates what depends on the place.
std::string copy_mpas(const RotateRequest& request, Progress& progress) {
  announce_files();
  const RotateReport report = rotate(request.source->path, request.output, rotation_of(request),
                                     {.history = history_of(request), .progress = progress.bar()});
  std::string lines = describe_fields(request, report.fields);
  for (const std::string& name : report.left_out)
    lines += message("{}: without the variable {}\n", request.output, name);
  return lines;
}

std::string write_rotated(const RotateRequest& request, const RotatedFile& file,
                          Progress& progress) {
  WriteOptions options = write_options(request, file.file);
  options.progress = progress.writing(request.output);
  const WrittenFields written = write(request.output, file.file, options);
  return describe_fields(request, file.fields) + describe_written(request, file.file, written);
}

MeshFile read_source(const RotateRequest& request, bool& copy) {
  const std::string& path = request.source->path;
  copy = path != "-" && keeps_mpas(request) && is_netcdf_file(path);
  if (copy) {
    MeshFile file = read_mesh_file(*request.source, FieldChoice::none);
    copy = file.format == "MPAS";
    if (copy)
      return file;
  }
  return read_mesh_file(*request.source, FieldChoice::all);
}

void run(const RotateRequest& request) {
  require_request(request);
  const Rotation rotation = rotation_of(request);
  std::string words, failure;
  {
    Progress progress;
    progress.stage("reading " + request.source->path);
    bool copy = false;
    const MeshFile file = read_source(request, copy);
    if (!file.surface().is_sphere())
      refuse_path(request.source->path,
                  "it holds a mesh of a plane, but a rotation moves meshes of "
                  "the sphere; add to its coordinates instead");
    words = changes_of(*request.source, file);
    const std::int64_t cells =
        file.has_cells && file.polygons ? file.polygons->size() : file.mesh->points.cols();
    const RotatedFile turned = rotated(file, rotation);
    progress.stage("checking the rotated mesh");
    failure = failure_of(turned.file, progress.bar());
    words += copy ? copy_mpas(request, progress) : write_rotated(request, turned, progress);
    words += message("{}: {} cells, {} moved to {}", request.output, spaced(cells), request.from,
                     request.to);
    if (failure.empty()) {
      words += ", the mesh passes its check";
    } else if (failure_of(file, {}) == failure) {
      words += message("; as before, {}", failure);
      failure.clear();
    }
  }
  std::cout << words << "\n";
  if (!failure.empty())
    finish(check_failed, message("{}: failed: {}", request.output, failure));
}

} // namespace

void add_rotate(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "rotate", "Rotates a mesh of the sphere, so that a point of it moves to where it is needed. "
                "Ids, connectivity, areas and scalar fields stay; coordinates, angles and "
                "directions turn.");
  auto request = std::make_shared<RotateRequest>();
  request->source = add_mesh_source(*command, "IN");
  command
      ->add_option("--from", request->from,
                   "A point of the mesh in IN, degrees, such as the centre of its fine cells")
      ->type_name("LON,LAT")
      ->required();
  command->add_option("--to", request->to, "Where that point is to be, degrees")
      ->type_name("LON,LAT")
      ->required();
  command
      ->add_option("--bearing", request->bearing,
                   "Where to what was north of --from points from --to: degrees, clockwise from "
                   "north. North at a pole is along the meridian of the longitude given there")
      ->type_name("DEGREES")
      ->capture_default_str();
  command
      ->add_option("-o,--output", request->output,
                   "Output mesh. From MPAS file to MPAS file, without the options --for, --format, "
                   "--sphere-radius and --order, all variables are copied, and those turned that "
                   "depend on the place. Otherwise the mesh and its fields are written as calotte "
                   "convert does")
      ->type_name("FILE")
      ->required();
  request->format = add_format(*command, {.radius = "that of IN", .order = "input"});
  request->config = add_config(*command);
  set_help(
      *command,
      {.common = {"IN", "--points", "--from", "--to", "--bearing", "--output", "--for", "--format",
                  "--sphere-radius", "--order", "--config"},
       .examples = {"calotte rotate x4.163842.grid.nc --from 0,0 --to -105,40 -o rockies.nc",
                    "calotte rotate earth.nc --from 0,90 --to 0,0 --bearing 90 -o turned.nc"}});
  command->callback([request] { run(*request); });
}

} // namespace calotte::tools
