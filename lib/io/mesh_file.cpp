// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/file.h"
#include "io/file_names.h"
#include "io/formats.h"
#include "io/netcdf_reader.h"
#include "mesh/adjacency.h"

#include "base/monitor.h"
#include "base/points.h"
#include "mesh/ids.h"
#include "mesh/renumber.h"

#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/io.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace calotte {
namespace {

using namespace io_detail;

// ---- Writing

[[noreturn]] void refuse(const std::string& path, const std::string& problem) {
  throw Error(ErrorCode::bad_option, path + ": " + problem);
}

void require_options(const std::string& path, const WriteOptions& options) {
  if (!(options.sphere_radius > 0 && std::isfinite(options.sphere_radius)))
    refuse(path, "the sphere's radius is " + std::to_string(options.sphere_radius) +
                     "; give a positive number");
  evaluate(options.density, Points3(3, 0)); // throws where it is ill-formed
}

/// Of either kind of mesh.
template <class AnyMesh> void require_ids(const std::string& path, const AnyMesh& mesh) {
  const std::int64_t sites = mesh.points.cols();
  if (!are_ids(mesh.triangles, sites) || !are_ids(mesh.site_of_input, sites))
    refuse(path, "the mesh has an id that is not one of its " + std::to_string(sites) + " points");
}

void require_mesh(const std::string& path, const Mesh& mesh, Format format) {
  require_ids(path, mesh);
  if (holds_cells(format) && !mesh.closed())
    refuse(path, "the mesh is open, and its outer cells have no end; write its triangles (.vtp, "
                 ".vtu, .off, .ply, .msh), or add sites all around the sphere");
}

Numbering numbering_of(const WriteOptions& options) {
  if (options.numbering != Numbering::by_format)
    return options.numbering;
  return is_netcdf(options.format) ? Numbering::curve : Numbering::input;
}

/// A file from front to back.
template <class Put>
void put_file(const std::string& path, const ProgressCallback& progress, std::int64_t expected,
              const Put& put) {
  OutputFile file(path);
  file.watch(progress, expected);
  put([&](std::string_view bytes) { file.append(bytes); });
  file.commit();
}

void put_mesh(const Sink& sink, const Mesh& mesh, const WriteOptions& options) {
  switch (options.format) {
  case Format::vtp:
    return put_vtp(sink, mesh, options);
  case Format::vtu:
    return put_vtu(sink, mesh, options);
  case Format::vtp_cells:
    return put_vtp_cells(sink, mesh, options);
  case Format::vtu_cells:
    return put_vtu_cells(sink, mesh, options);
  case Format::geojson:
    return put_geojson(sink, mesh, options);
  case Format::off:
    return put_off(sink, mesh);
  case Format::ply:
    return put_ply(sink, mesh);
  case Format::msh:
    return put_msh(sink, mesh);
  default:
    return put_triangles_text(sink, mesh);
  }
}

/// A site's share of a file, roughly: progress alone depends on it.
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

/// A caller's callback for the part of a run from one fraction on.
ProgressCallback rest_of(const ProgressCallback& progress, double from) {
  if (!progress)
    return {};
  return [&progress, from](const Progress& part) {
    constexpr double end = 0.99; // the file has yet to be brought to the disk
    return progress({part.stage, from + (end - from) * part.fraction});
  };
}

void write_numbered(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  switch (options.format) {
  case Format::mpas:
    return write_mpas(path, mesh, options);
  case Format::mpas_minimal:
    return write_mpas_minimal(path, mesh, options);
  case Format::ugrid:
    return write_ugrid(path, mesh, options);
  case Format::ugrid_triangles:
    return write_ugrid_triangles(path, mesh, options);
  case Format::scrip:
    return write_scrip(path, mesh, options);
  case Format::esmf:
    return write_esmf(path, mesh, options);
  case Format::mpi_scvt:
    return write_mpi_scvt(path, mesh, options);
  default:
    put_file(path, options.progress, expected_bytes(options.format) * mesh.points.cols(),
             [&](const Sink& sink) { put_mesh(sink, mesh, options); });
  }
}

/// At z = 0.
Mesh in_space(const PlanarMesh& mesh) {
  Mesh out{Points3::Zero(3, mesh.points.cols()), mesh.triangles, mesh.neighbours,
           mesh.site_of_input};
  out.points.topRows<2>() = mesh.points;
  return out;
}

// ---- Reading

/// All sites on one great circle have no mesh of the sphere: more likely they are a plane's.
void require_sphere(const std::string& name, const Points3& points) {
  if (points.cols() >= 3 && (points.row(2).array() == 0).all())
    throw Error(
        ErrorCode::bad_option,
        name +
            ": z is 0 at all points, which makes a mesh of the plane; read it as one of the plane");
}

void require_directions(const std::string& name, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (!points.col(i).allFinite() || (points.col(i).array() == 0).all())
      throw Error(ErrorCode::parse,
                  name + ": point " + std::to_string(i) +
                      " has no direction (NaN, infinite or zero); make the file again",
                  i);
}

void require_ids(const std::string& name, const Triangles& triangles, std::int64_t points) {
  for (Eigen::Index t = 0; t < triangles.cols(); ++t)
    for (int i = 0; i < 3; ++i)
      if (triangles(i, t) < 0 || triangles(i, t) >= points)
        throw Error(ErrorCode::parse,
                    name + ": triangle " + std::to_string(t) +
                        " has an id that is not one of the " + std::to_string(points) +
                        " points; make the file again",
                    t);
}

/// \param triangulate gives the mesh. \throws what it throws, with the file's name.
auto named(const std::string& name, const auto& triangulate) {
  try {
    return triangulate();
  } catch (const Error& error) {
    throw Error(error.code(), name + ": " + error.what(), error.index());
  }
}

Mesh mesh_of(const std::string& name, Soup soup) {
  require_sphere(name, soup.points);
  require_directions(name, soup.points);
  if (soup.triangles.cols() == 0)
    return named(name, [&] { return spherical_delaunay(soup.points); });
  require_ids(name, soup.triangles, soup.points.cols());
  Mesh mesh{std::move(soup.points), std::move(soup.triangles), {}, {}};
  mesh.neighbours = neighbours_of(mesh.triangles, mesh.points.cols());
  mesh.site_of_input = themselves(mesh.points.cols());
  return mesh;
}

void require_places(const std::string& name, const Points3& points) {
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!points.col(i).allFinite())
      throw Error(ErrorCode::parse,
                  name + ": point " + std::to_string(i) +
                      " has no place (NaN or infinite); make the file again",
                  i);
    if (points(2, i) != 0)
      throw Error(ErrorCode::bad_option,
                  name + ": z is not 0 at point " + std::to_string(i) +
                      ", so it is not a planar mesh; read it as one of the sphere",
                  i);
  }
}

PlanarMesh planar_mesh_of(const std::string& name, const Soup& soup) {
  require_places(name, soup.points);
  const Points2 places = soup.points.topRows<2>();
  if (soup.triangles.cols() == 0)
    return named(name, [&] { return planar_delaunay(places); });
  require_ids(name, soup.triangles, places.cols());
  return {places, soup.triangles, neighbours_of(soup.triangles, places.cols()),
          themselves(places.cols())};
}

Soup read_netcdf(const std::string& path) {
  const NetcdfReader file(path);
  if (is_mpas(file))
    return read_mpas(file);
  if (is_ugrid(file))
    return read_ugrid(file);
  if (is_scrip(file))
    return read_scrip(file);
  if (is_esmf(file))
    return read_esmf(file);
  file.fail("a NetCDF file, but no mesh of MPAS, UGRID, SCRIP or ESMF; convert it to one of them");
}

/// Whether the first bytes are those of a classic NetCDF file or of HDF5.
bool starts_as_netcdf(const std::string& path) {
  std::array<char, 4> start{};
  std::ifstream in(path, std::ios::binary);
  in.read(start.data(), start.size());
  const std::string_view bytes(start.data(), start.size());
  return bytes.starts_with("CDF") || bytes == "\x89HDF";
}

/// MPI-SCVT's centres of regions. Its triangles of these say nothing that the centres do not, so
/// that either file stands for both. Nothing where the name is none of the two.
std::optional<Soup> read_centres(const std::string& path) {
  if (format_of_name(path).value_or(Format::triangles) != Format::triangles)
    return std::nullopt;
  if (sibling(path, centres_name, centres_name))
    return Soup{read_points(path), {}};
  const std::optional<std::string> centres = sibling(path, centre_triangles_name, centres_name);
  if (!centres)
    return std::nullopt;
  if (!std::ifstream(*centres))
    throw Error(ErrorCode::file, path + ": it holds the centres' triangles only, and " + *centres +
                                     ", which holds the centres, cannot be read; put it there");
  return Soup{read_points(*centres), {}};
}

Soup read_stream(const std::string& path, Format format) {
  std::ifstream in = open_input(path);
  switch (format) {
  case Format::vtp:
    return get_vtp(in, path);
  case Format::vtu:
    return get_vtu(in, path);
  case Format::off:
    return get_off(in, path);
  case Format::ply:
    return get_ply(in, path);
  case Format::msh:
    return get_msh(in, path);
  default:
    return get_geojson(in, path);
  }
}

/// Whether the file is NetCDF: its name says so, or its contents where the name says nothing.
/// \throws Error bad_option, where neither says a format.
bool holds_netcdf(const std::string& path) {
  const std::optional<Format> format = format_of_name(path);
  if (!format && !starts_as_netcdf(path))
    refuse_name(path);
  return !format || is_netcdf(*format);
}

[[noreturn]] void refuse_triangles_alone(const std::string& path) {
  throw Error(ErrorCode::bad_option, path + " holds triangles only; give the points they refer to");
}

/// Of all formats that hold points.
Soup read_soup(const std::string& path) {
  if (std::optional<Soup> centres = read_centres(path))
    return *std::move(centres);
  if (holds_netcdf(path))
    return read_netcdf(path);
  const std::optional<Format> format = format_of_name(path);
  if (*format == Format::triangles)
    refuse_triangles_alone(path);
  return *format == Format::mpi_scvt ? read_mpi_scvt(path) : read_stream(path, *format);
}

/// The points alone, without what goes with them where that costs a look or may fail.
Points3 sites_of(const std::string& path) {
  if (std::optional<Soup> centres = read_centres(path))
    return std::move(centres->points);
  if (format_of_name(path) == Format::mpi_scvt)
    return read_points(path);
  if (holds_netcdf(path))
    if (const NetcdfReader file(path); is_mpas(file))
      return read_mpas_sites(file);
  return read_soup(path).points;
}

} // namespace

void write(const std::string& path, const Mesh& mesh, const WriteOptions& options) {
  constexpr double numbered = 0.2; // of the time, where the cells are numbered anew
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  require_options(path, resolved);
  require_mesh(path, mesh, resolved.format);
  Monitor monitor(options.progress);
  monitor.begin("number", numbered, 1);
  const Numbering numbering = numbering_of(resolved);
  const bool stays =
      numbering == Numbering::input || (numbering == Numbering::curve && is_in_curve_order(mesh));
  resolved.progress = rest_of(options.progress, stays ? 0 : numbered);
  if (stays)
    write_numbered(path, mesh, resolved);
  else
    write_numbered(path, renumbered(mesh, numbering), resolved);
  monitor.finish("write");
}

void require_planar_format(const std::string& path, bool periodic, Format format) {
  const bool mpas = format == Format::mpas || format == Format::mpas_minimal;
  const bool places = format == Format::vtp || format == Format::vtu || format == Format::off ||
                      format == Format::ply || format == Format::msh;
  if (format == Format::triangles || (periodic ? mpas : places))
    return;
  refuse(path, periodic ? "a periodic plane is written as MPAS or as triangles alone; give a name "
                          "that ends in .nc, .txt or .tri"
                        : "a plane is written as triangles, .vtp, .vtu, .off, .ply or .msh; give a "
                          "name that ends so");
}

void write(const std::string& path, const PlanarMesh& mesh, const WriteOptions& options) {
  WriteOptions resolved = options;
  resolved.format = format_of(path, options.format);
  require_options(path, resolved);
  require_planar_format(path, mesh.period.minCoeff() > 0, resolved.format);
  if (options.numbering == Numbering::curve || options.numbering == Numbering::rcm)
    refuse(path, "the cells of a planar mesh keep their numbers; leave the order out");
  require_ids(path, mesh);
  resolved.progress = rest_of(options.progress, 0);
  if (resolved.format == Format::mpas)
    write_mpas(path, mesh, resolved);
  else if (resolved.format == Format::mpas_minimal)
    write_mpas_minimal(path, mesh, resolved);
  else
    write_numbered(path, in_space(mesh), resolved);
  Monitor(options.progress).finish("write");
}

Mesh read_mesh(const std::string& path, const Points3* points) {
  if (!points || format_of_name(path) != Format::triangles)
    return mesh_of(path, read_soup(path));
  std::ifstream in = open_input(path);
  return mesh_of_columns(*points, get_triangles_text(in, path, points->cols()));
}

Points3 read_sites(const std::string& path) {
  Points3 sites = sites_of(path);
  require_sphere(path, sites);
  require_directions(path, sites);
  return sites;
}

PlanarMesh read_planar_mesh(const std::string& path, const Points2* points) {
  if (holds_netcdf(path)) {
    const NetcdfReader file(path);
    if (!is_mpas(file))
      file.fail("not an MPAS mesh, the only NetCDF format of planar meshes");
    return read_planar_mpas(file);
  }
  const Format format = *format_of_name(path);
  require_planar_format(path, false, format);
  if (format != Format::triangles)
    return planar_mesh_of(path, read_stream(path, format));
  if (!points)
    refuse_triangles_alone(path);
  std::ifstream in = open_input(path);
  return mesh_of_columns(*points, get_triangles_text(in, path, points->cols()));
}

} // namespace calotte
