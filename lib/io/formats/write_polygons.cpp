// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/command.h"
#include "io/formats/write_mesh.h"

#include "io/cells/model_grid.h"

#include <calotte/error.h>

#include <cmath>

namespace calotte::io_detail {

void refuse_to_write(const std::string& path, const std::string& problem) {
  throw Error(ErrorCode::invalid_argument, path + ": " + problem);
}

void require_options(const std::string& path, const WriteOptions& options) {
  if (!(options.sphere_radius > 0 && std::isfinite(options.sphere_radius)))
    refuse_to_write(path, "the sphere's radius is " + std::to_string(options.sphere_radius) +
                              "; give a positive number");
  evaluate(options.density, Points3(3, 0)); // throws where it is ill-formed
}

std::int64_t expected_bytes(Format format) {
  switch (format) {
  case Format::ply:
  case Format::triangles:
    return 50;
  case Format::geojson:
    return 600;
  case Format::vtp_cells:
  case Format::vtu_cells:
    return 200;
  default:
    return 100;
  }
}

ProgressCallback rest_of(const ProgressCallback& progress, double from) {
  if (!progress)
    return {};
  return [&progress, from](const Progress& part) {
    constexpr double end = 0.99; // the file has yet to be brought to the disk
    return progress({part.stage, from + (end - from) * part.fraction});
  };
}

namespace {

void put_polygons(const Sink& sink, const Polygons& polygons, const WriteOptions& options) {
  switch (options.format) {
  case Format::vtp_cells:
    return put_vtp_cells(sink, polygons, options);
  case Format::vtu_cells:
    return put_vtu_cells(sink, polygons, options);
  case Format::off:
    return put_off(sink, polygons);
  case Format::ply:
    return put_ply(sink, polygons);
  default:
    return put_geojson(sink, polygons, options);
  }
}

/// SCRIP, ESMF and Exodus hold the sphere only.
void require_plane_format(const std::string& path, Format format) {
  if (format == Format::scrip || format == Format::esmf || format == Format::exodus)
    refuse_to_write(path, "the format holds cells of the sphere, but the mesh is planar; write " +
                              formats_of_polygons(false) + ", or mpas");
}

} // namespace

std::optional<Format> polygon_format(Format format) {
  switch (format) {
  case Format::vtp:
    return Format::vtp_cells;
  case Format::vtu:
    return Format::vtu_cells;
  case Format::off:
  case Format::ply:
    return format;
  default:
    return holds_cells(format) ? std::optional(format) : std::nullopt;
  }
}

std::string formats_of_polygons(bool on_sphere) {
  return on_sphere ? "ugrid, scrip, esmf, exodus, vtp-cells, vtu-cells or geojson"
                   : "ugrid, vtp-cells, vtu-cells or geojson";
}

void write_polygons(const std::string& path, const CellGrid& grid, const WriteOptions& options) {
  if (!grid.polygons.on_sphere)
    require_plane_format(path, options.format);
  switch (options.format) {
  case Format::ugrid:
    return write_ugrid(path, grid, options);
  case Format::scrip:
    return write_scrip(path, grid, options);
  case Format::esmf:
    return write_esmf(path, grid, options);
  case Format::exodus:
    return write_exodus(path, grid, options);
  default:
    put_file(path, options.progress, expected_bytes(options.format) * grid.polygons.size(),
             [&](const Sink& sink) { put_polygons(sink, grid.polygons, options); });
  }
}

} // namespace calotte::io_detail
