// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/field_grid.h>

#include "base/lonlat.h"
#include "base/message.h"
#include "base/require.h"
#include "io/bytes/file_error.h"
#include "io/cells/centroids.h"
#include "io/cells/model_grid.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/polygons.h"
#include "io/command.h"
#include "io/fields/cell_dimension.h"
#include "io/fields/centres.h"
#include "io/fields/projected_grid.h"
#include "io/fields/raster_grid.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/cf_values.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/delaunay.h>
#include <calotte/locate.h>
#include <calotte/voronoi.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::require;

Surface surface_of(const FieldGrid& grid) {
  return grid.boxes       ? Surface::sphere()
         : grid.positions ? grid.positions->surface
                          : grid.mesh.surface();
}

} // namespace

void require_one_surface(const FieldGrid& source, const FieldGrid& target) {
  const auto words = [](const FieldGrid& grid) {
    const Surface surface = surface_of(grid);
    return std::string(surface.is_sphere()          ? "on the sphere"
                       : surface.period().isZero(0) ? "in a plane"
                                                    : "in a periodic plane");
  };
  const Surface from = surface_of(source), to = surface_of(target);
  require(from.is_sphere() == to.is_sphere() && from.period() == to.period(),
          "{} is {}, and {} is {}{}; give grids of one surface", source.name, words(source),
          target.name, words(target), words(source) == words(target) ? " of another period" : "");
}

namespace {

std::int64_t count_cells(const MeshFile& mesh) {
  return mesh.polygons ? mesh.polygons->size() : mesh.mesh ? mesh.mesh->points.cols() : 0;
}

} // namespace

Points3 centres_of(const MeshFile& mesh) {
  if (!mesh.polygons)
    return mesh.mesh->points;
  return mesh.polygons->centres.cols() > 0 ? mesh.polygons->centres : centroids_of(*mesh.polygons);
}

Points3 centres_of(const FieldGrid& grid) {
  return grid.boxes       ? nodes(*grid.boxes)
         : grid.positions ? grid.positions->points
                          : centres_of(grid.mesh);
}

namespace {

/// The cell that contains each position; -1 without one. Sites without cells, at corners of
/// triangles, count for their triangles.
Ids find_cells(const MeshFile& mesh, const Points3& positions) {
  if (mesh.polygons)
    return cells_at(*mesh.polygons, positions);
  const Locations at = locate(*mesh.mesh, positions);
  return (at.triangle.array() >= 0).select(at.nearest, -1);
}

Weights nearest(const FieldGrid& source, const Points3& positions) {
  const Ids cells = find_cells(source.mesh, positions);
  Weights weights(positions.cols(), source.size());
  weights.reserve(cells.size());
  for (Eigen::Index i = 0; i < cells.size(); ++i) {
    weights.startVec(i);
    if (cells[i] >= 0)
      weights.insertBack(i, cells[i]) = 1;
  }
  weights.finalize();
  return weights;
}

/// Weights of the triangles between centres. If the cells have no triangles of their own, positions
/// outside of all cells have no weights.
Weights on_triangles(const FieldGrid& source, const Points3& positions, Interpolation kind) {
  if (source.mesh.mesh)
    return interpolation_weights(*source.mesh.mesh, positions, kind);
  const Points3 centres = centres_of(source);
  const Mesh mesh =
      delaunay(centres, surface_of(source).is_sphere() ? Surface::sphere() : Surface::plane());
  require(mesh.points.cols() == centres.cols(),
          "{} has cells with the same centre; give the method conservative or nearest",
          source.name);
  Weights weights = interpolation_weights(mesh, positions, kind);
  const Ids cells = cells_at(*source.mesh.polygons, positions);
  weights.prune([&](Eigen::Index row, Eigen::Index, double) { return cells[row] >= 0; });
  weights.makeCompressed();
  return weights;
}

Weights at_positions(const FieldGrid& source, const Points3& positions, Interpolation kind) {
  if (source.boxes)
    return interpolation_weights(*source.boxes, positions, kind);
  return kind == Interpolation::nearest ? nearest(source, positions)
                                        : on_triangles(source, positions, kind);
}

/// Calls body(cells) with the cells of a grid, in place if it has them.
template <class Body> GridWeights with_cells(const FieldGrid& grid, const Body& body) {
  return grid.mesh.polygons ? body(*grid.mesh.polygons) : body(cells_of(grid));
}

GridWeights conservative(const FieldGrid& source, const FieldGrid& target) {
  if (source.boxes && target.boxes)
    return conservative_weights(*source.boxes, *target.boxes);
  if (source.boxes)
    return with_cells(
        target, [&](const Polygons& cells) { return conservative_weights(*source.boxes, cells); });
  return with_cells(source, [&](const Polygons& from) {
    if (target.boxes)
      return conservative_weights(from, *target.boxes);
    return with_cells(target, [&](const Polygons& to) { return conservative_weights(from, to); });
  });
}

/// Finds the dimension of the cells by its name or size.
/// \throws Error parse.
std::string find_cell_dimension(const NetcdfReader& file, const FieldGrid& mesh) {
  const std::string usual = cell_dimension(mesh.mesh.format);
  if (file.dimension(usual) == mesh.size())
    return usual;
  std::vector<std::string> found;
  for (const NetcdfDimension& dimension : file.dimensions())
    if (dimension.size == mesh.size())
      found.push_back(dimension.name);
  if (const std::int64_t of_file = file.dimension(usual); found.empty() && of_file >= 0)
    file.fail("its {} is {}, and {} has {} cells; give the mesh of these fields", usual, of_file,
              mesh.name, mesh.size());
  if (found.size() != 1)
    file.fail("{} of {}, the number of cells of {}; give the fields of that mesh",
              found.empty() ? "no dimension" : "several dimensions", mesh.size(), mesh.name);
  return found.front();
}

/// Whether a variable is a coordinate of the cells.
bool is_coordinate(const NetcdfReader& file, const std::string& name) {
  return is_longitude(file, name) || is_latitude(file, name) || name == "x" || name == "y";
}

// ---- The order of the cells

/// Whether a variable is a longitude of cells, by its attributes or as in MPAS. The same of
/// latitudes.
bool is_longitude_of_cells(const NetcdfReader& file, const std::string& name) {
  return is_longitude(file, name) || (name == "lonCell" && file.is_numeric(name));
}
bool is_latitude_of_cells(const NetcdfReader& file, const std::string& name) {
  return is_latitude(file, name) || (name == "latCell" && file.is_numeric(name));
}

/// The degrees in a unit of a variable; none for units other than degrees and radians.
std::optional<double> find_degrees(const NetcdfReader& file, const std::string& name) {
  const std::string units = file.text(name, "units");
  if (units.starts_with("rad") || (units.empty() && name.ends_with("Cell")))
    return 180 / std::numbers::pi;
  return units.empty() || units.starts_with("deg") ? std::optional(1.0) : std::nullopt;
}

/// Reads a coordinate of the cells, degrees; empty without one.
template <class Is>
std::vector<double> read_coordinate(const NetcdfReader& file, const std::string& cells,
                                    const Is& is_it) {
  for (const std::string& name : file.variable_names())
    if (file.dimensions_of(name) == std::vector<std::string>{cells} && is_it(file, name))
      if (const std::optional<double> degrees = find_degrees(file, name)) {
        std::vector<double> values = cf_values(file, name, {file.dimension(cells)});
        scale(values, *degrees);
        return values;
      }
  return {};
}

/// Reads the directions of the cells in a file of fields; NaN where it has none, and no columns
/// without longitudes and latitudes.
Points3 read_positions(const NetcdfReader& file, const std::string& cells) {
  const std::vector<double> lon = read_coordinate(file, cells, is_longitude_of_cells),
                            lat = read_coordinate(file, cells, is_latitude_of_cells);
  if (lon.empty() || lat.empty())
    return {};
  Points3 positions(3, std::ssize(lon));
  positions.setConstant(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < lon.size(); ++i)
    if (std::isfinite(lon[i]) && std::abs(lat[i]) <= 90) {
      const base_detail::Vec3 at = base_detail::from_lonlat(lon[i], lat[i]);
      positions.col(static_cast<Eigen::Index>(i)) << at.x, at.y, at.z;
    }
  return positions;
}

/// "longitude 30, latitude -10": the position of a cell.
std::string position_words(const Eigen::Vector3d& direction) {
  const base_detail::LonLat at =
      base_detail::lonlat_of({direction.x(), direction.y(), direction.z()});
  return base_detail::message("longitude {}, latitude {}", at.longitude, at.latitude);
}

// ---- Masks

/// Reads the mask of a mesh file, which is read whatever fields are chosen; none if it excludes no
/// cell.
Ids read_mask(const std::string& path, std::int64_t cells) {
  if (!is_netcdf_file(path))
    return {};
  const NetcdfReader file(path);
  for (const char* const name : mask_names)
    if (file.has_variable(name) && file.is_integer(name) &&
        file.shape_of(name) == std::vector<std::int64_t>{cells}) {
      const std::vector<std::int32_t> values = file.ints(name, {cells});
      const Ids mask =
          Eigen::Map<const Ids>(values.data(), cells).unaryExpr([](std::int32_t value) {
            return value == 0 ? 0 : 1;
          });
      return mask.minCoeff() == 1 ? Ids() : mask;
    }
  return {};
}

/// Makes values of masked cells missing, and removes the mask from the fields.
void apply_mask(FieldGrid& grid) {
  std::erase_if(grid.fields, is_mask);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (MeshField& field : grid.fields)
    for (Eigen::Index i = 0; i < grid.mask.size(); ++i)
      if (grid.mask[i] == 0)
        field.values.segment(i * field.count(), field.count()).setConstant(none);
}

bool counts(const FieldGrid& grid, Eigen::Index cell) {
  return grid.mask.size() == 0 || grid.mask[cell] != 0;
}

/// Removes masked cells from weights. Rows are divided by the sum that remains.
void leave_masked_out(const FieldGrid& source, const FieldGrid& target, GridWeights& out) {
  if (source.mask.size() == 0 && target.mask.size() == 0)
    return;
  Weights& weights = out.weights;
  DoubleVector left = DoubleVector::Zero(weights.rows());
  weights.prune([&](Eigen::Index row, Eigen::Index column, double weight) {
    const bool stays = counts(target, row) && counts(source, column);
    left[row] += stays ? weight : 0;
    return stays;
  });
  weights.makeCompressed();
  out.target_fraction.array() *= left.array();
  DoubleVector shared = DoubleVector::Zero(weights.cols()); // of areas, if these are known
  for (Eigen::Index row = 0; row < weights.rows(); ++row)
    for (Weights::InnerIterator entry(weights, row); entry; ++entry) {
      entry.valueRef() /= left[row];
      if (out.target_area.size() > 0)
        shared[entry.col()] += entry.value() * out.target_fraction[row] * out.target_area[row];
    }
  if (out.source_area.size() > 0)
    out.source_fraction =
        (out.source_area.array() > 0).select(shared.array() / out.source_area.array(), 0.0);
  else
    for (Eigen::Index i = 0; i < out.source_fraction.size(); ++i)
      out.source_fraction[i] *= counts(source, i) ? 1 : 0;
}

} // namespace

void require_records(const std::string& path, const FieldGrid& grid, FieldChoice choice) {
  if (choice == FieldChoice::none || !grid.fields.empty() || !is_netcdf_file(path))
    return;
  const NetcdfReader file(path);
  for (const std::string& name : grid.ignored)
    if (file.has_variable(name))
      for (const std::string& dimension : file.dimensions_of(name))
        if (file.dimension(dimension) == 0)
          file.fail(
              "its dimension {} has the size 0, so that {} holds no numbers; give a file with "
              "records",
              dimension, name);
}

} // namespace io_detail

std::int64_t FieldGrid::size() const {
  return boxes       ? boxes->size()
         : positions ? positions->points.cols()
                     : io_detail::count_cells(mesh);
}

FieldGrid read_field_grid(const std::string& path, FieldChoice choice,
                          const std::vector<FieldIndex>& choices) {
  using namespace io_detail;
  if (is_netcdf_file(path)) {
    const NetcdfReader file(path);
    if (const std::optional<RasterAxes> axes = raster_axes(file)) {
      FieldGrid raster = read_raster_grid(file, *axes, choice, choices);
      require_records(path, raster, choice);
      return raster;
    }
    if (const std::optional<ProjectedAxes> axes = projected_axes(file)) {
      const ProjectedRaster all(file, *axes);
      FieldGrid raster = all.read(0, all.rows(), choice, choices);
      require_records(path, raster, choice);
      return raster;
    }
    if (const std::optional<RasterAxes> axes = curvilinear_axes(file)) {
      FieldGrid raster = read_curvilinear_grid(file, *axes, choice, choices);
      require_records(path, raster, choice);
      return raster;
    }
  }
  FieldGrid grid{.name = path};
  grid.mesh = read_mesh_file(path, nullptr, choice, choices);
  grid.fields = std::move(grid.mesh.fields);
  grid.ignored = std::move(grid.mesh.ignored);
  std::erase_if(grid.fields, [&](const MeshField& field) {
    if (field.location == FieldLocation::cells)
      return false;
    grid.ignored.push_back(field.name);
    return true;
  });
  grid.mesh.fields.clear();
  grid.mask = read_mask(path, grid.size());
  apply_mask(grid);
  require_records(path, grid, choice);
  return grid;
}

FieldGrid read_field_grid(const std::string& path, const std::string& mesh_path, FieldChoice choice,
                          const std::vector<FieldIndex>& choices) {
  using namespace io_detail;
  FieldGrid grid = read_field_grid(mesh_path, FieldChoice::none);
  require(!grid.boxes, "{} is a raster, whose fields are in its own file; give that alone",
          mesh_path);
  const NetcdfReader file(path);
  std::set<std::string> coordinates;
  for (const std::string& name : file.variable_names())
    if (is_coordinate(file, name))
      coordinates.insert(name);
  const std::string cells = find_cell_dimension(file, grid);
  require_order(path, grid.mesh, mesh_path);
  read_fields_on(
      file, {.dimensions = {cells}, .no_fields = coordinates, .choice = choice, .choices = choices},
      grid.fields, grid.ignored, &grid.not_scalars);
  grid.name = path;
  apply_mask(grid);
  require_records(path, grid, choice);
  return grid;
}

std::int64_t first_misplaced(const MeshFile& mesh, const Points3& positions) {
  using namespace io_detail;
  if (!mesh.surface().is_sphere())
    return -1;
  base_detail::require(positions.cols() == count_cells(mesh),
                       "there are {} positions of {} cells; give one for each", positions.cols(),
                       count_cells(mesh));
  constexpr double rounding = 1e-6;       // of single precision, several times
  constexpr std::size_t together = 65536; // so that the first of many is found soon
  const Points3 centres = centres_of(mesh);
  std::vector<std::int64_t> far;
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    if ((centres.col(i).normalized() - positions.col(i)).norm() > rounding) // false for NaN
      far.push_back(i);
    if (far.empty() || (far.size() < together && i + 1 < positions.cols()))
      continue;
    const Ids cells = find_cells(mesh, positions(Eigen::all, far));
    for (std::size_t k = 0; k < far.size(); ++k)
      if (cells[static_cast<Eigen::Index>(k)] != far[k])
        return far[k];
    far.clear();
  }
  return -1;
}

void require_order(const std::string& path, const MeshFile& mesh, const std::string& mesh_path) {
  using namespace io_detail;
  const NetcdfReader file(path);
  const std::int64_t n = count_cells(mesh);
  for (const NetcdfDimension& dimension : file.dimensions()) {
    if (dimension.size != n)
      continue;
    const Points3 positions = read_positions(file, dimension.name);
    const std::int64_t i = positions.cols() > 0 ? first_misplaced(mesh, positions) : -1;
    if (i >= 0)
      fail_file(
          path, i,
          "cell {} is at {}, and that of {} at {}; give the mesh of these fields, or one that "
          "is written in their order (order input)",
          i, position_words(positions.col(i)), mesh_path, position_words(centres_of(mesh).col(i)));
  }
}

std::optional<FieldGrid> raster_of(const std::string& columns_x_rows) {
  std::int64_t columns = 0, rows = 0;
  const char *const begin = columns_x_rows.data(), *const end = begin + columns_x_rows.size();
  const auto first = std::from_chars(begin, end, columns);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != 'x')
    return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, rows);
  if (second.ec != std::errc{} || second.ptr != end)
    return std::nullopt;
  FieldGrid grid{.name = columns_x_rows};
  grid.boxes = lon_lat_boxes(columns, rows);
  return grid;
}

Polygons cells_of(const FieldGrid& grid) {
  base_detail::require(!grid.positions, "{} has positions, without cells; give a mesh", grid.name);
  if (grid.mesh.polygons)
    return *grid.mesh.polygons;
  const Mesh& mesh = *grid.mesh.mesh;
  base_detail::require(mesh.closed() || (!mesh.surface.is_sphere() && mesh.surface.is_bounded()),
                       "{} has triangles of a part of the surface, without cells; give linear or "
                       "nearest as the method",
                       grid.name);
  return polygons_of(voronoi(mesh));
}

GridWeights interpolation_weights(const FieldGrid& source, const FieldGrid& target,
                                  Interpolation kind) {
  using namespace io_detail;
  require_one_surface(source, target);
  base_detail::require(!source.positions,
                       "{} has positions without cells; use interpolate_scattered()", source.name);
  base_detail::require(
      !target.positions || kind != Interpolation::conservative,
      "{} has positions without cells; give linear, nearest or natural as the method", target.name);
  GridWeights out;
  if (kind == Interpolation::conservative) {
    out = conservative(source, target);
  } else {
    out.weights = at_positions(source, centres_of(target), kind);
    out.source_fraction = DoubleVector::Ones(source.size());
    out.target_fraction.resize(target.size());
    for (Eigen::Index i = 0; i < target.size(); ++i) {
      const int* const begin = out.weights.outerIndexPtr();
      out.target_fraction[i] = begin[i + 1] > begin[i] ? 1 : 0;
    }
  }
  leave_masked_out(source, target, out);
  return out;
}

} // namespace calotte
