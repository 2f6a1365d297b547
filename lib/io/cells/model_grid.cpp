// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/model_grid.h"
#include "base/require.h"
#include "io/netcdf/cf_values.h"

#include "base/lonlat.h"
#include "base/parallel.h"
#include "base/points.h"
#include "io/bytes/text.h"
#include "io/cells/polygons.h"
#include "voronoi/cell_fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace calotte::io_detail {
namespace {

/// Fills a variable with of(point) for each column.
template <class Of> NetcdfWriter::Fill<double> each(const Points3& points, const Of& of) {
  return table<double>(
      1, [&points, of](std::int64_t i, std::int64_t /*k*/) { return of(column(points, i)); });
}

} // namespace

Points3 on_sphere(Points3 points, double radius) {
  require(radius > 0 && std::isfinite(radius),
          "the sphere's radius is {}; give a positive number of metres", radius);
  constexpr double rounding = 0x1p-50; // of a norm, in which four operations round
  for_each_block(points.cols(), [&](std::int64_t /*block*/, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      if (!(std::abs(points.col(i).norm() - radius) <= rounding * radius))
        points.col(i) = radius * points.col(i).stableNormalized();
  });
  return points;
}

WriteOptions of_plane(WriteOptions options) {
  options.sphere_radius = 0; // as in planar meshes
  return options;
}

DoubleVector density_at_cells(const Voronoi& voronoi, const WriteOptions& options) {
  if (options.site_density.size() == 0)
    return voronoi_detail::relative_density(voronoi, options.density);
  return options.site_density / options.site_density.maxCoeff();
}

CellFields make_cell_fields(const Voronoi& voronoi, const WriteOptions& options) {
  if (options.site_density.size() == 0)
    return cell_fields(voronoi, options.density);
  CellFields fields = cell_fields(voronoi);
  fields.density = density_at_cells(voronoi, options);
  return fields;
}

CellGrid cell_grid(const Mesh& mesh) {
  Voronoi cells = voronoi(mesh);
  DoubleVector area = std::move(cells.cell_area);
  return {polygons_of(std::move(cells)), std::move(area), mesh.points};
}

CellGrid cell_grid(const Polygons& polygons) { return {polygons, areas_of(polygons), {}}; }

std::int64_t most_corners(const Voronoi& cells) {
  std::int64_t most = 0;
  for (Eigen::Index i = 0; i < cells.cells.cols(); ++i)
    most = std::max(most, cells.edges_on_cell.count(i));
  return most;
}

NetcdfWriter::Fill<double> longitudes_of(const Points3& points) {
  return each(points, [](const Vec3& p) { return eastern_lonlat_of(p).longitude; });
}

NetcdfWriter::Fill<double> latitudes_of(const Points3& points) {
  return each(points, [](const Vec3& p) { return eastern_lonlat_of(p).latitude; });
}

NetcdfWriter::Fill<double> lonlats_of(const Points3& points) {
  return table<double>(2, [&points](std::int64_t i, std::int64_t k) {
    const LonLat lonlat = eastern_lonlat_of(column(points, i));
    return k == 0 ? lonlat.longitude : lonlat.latitude;
  });
}

NetcdfWriter::Fill<double> coordinate_row(const Points3& points, int row) {
  return table<double>(
      1, [&points, row](std::int64_t i, std::int64_t /*k*/) { return points(row, i); });
}

NetcdfWriter::Fill<double> values_of(const DoubleVector& values) {
  return table<double>(1, [&values](std::int64_t i, std::int64_t /*k*/) { return values[i]; });
}

NetcdfWriter::Fill<std::int32_t> constant(std::int64_t value) {
  return table<std::int32_t>(1, [value](std::int64_t /*row*/, std::int64_t /*k*/) {
    return static_cast<std::int32_t>(value);
  });
}

NetcdfGridFile::NetcdfGridFile(const std::string& path, const WriteOptions& options,
                               const std::string& conventions)
    : file_(path, options.progress) {
  file_.attribute({"Conventions", conventions});
  file_.attribute({"sphere_radius", options.sphere_radius});
  if (options.sphere_radius == 1 && options.planet_radius)
    file_.attribute({planet_attribute, *options.planet_radius});
  if (!options.history.empty())
    file_.attribute({"history", options.history});
}

void NetcdfGridFile::together(const std::vector<Announced>& variables,
                              const NetcdfWriter::GroupFill& contents) {
  std::vector<int> ints, doubles;
  for (const auto& [name, dimensions, attributes, integer] : variables)
    (integer ? ints : doubles)
        .push_back(file_.variable(name, integer ? NetcdfType::int32 : NetcdfType::float64,
                                  dimensions, attributes));
  then([this, ints, doubles, contents] { file_.put(ints, doubles, contents); });
}

void NetcdfGridFile::after(std::function<void()> computation) {
  stages_.push_back({std::move(computation), {}});
}

void NetcdfGridFile::commit() {
  file_.begin();
  stages_.push_back({[] {}, {}});
  for (std::size_t k = 1; k < stages_.size(); ++k)
    for_each_task(2, [&](std::int64_t task) {
      if (task == 0)
        stages_[k].computation();
      else
        for (const Step& put : stages_[k - 1].puts)
          put();
    });
  file_.commit();
}

bool is_mask(const MeshField& field) {
  return field.location == FieldLocation::cells && field.count() == 1 &&
         std::find(mask_names.begin(), mask_names.end(), field.name) != mask_names.end();
}

namespace {

bool is_area(const MeshField& field) {
  return field.location == FieldLocation::cells && field.count() == 1 &&
         (field.name == "grid_area" || field.name == "elementArea" || field.name == "cell_area");
}

} // namespace

NetcdfWriter::Fill<std::int32_t> make_mask(const WriteOptions& options) {
  const auto mask = std::find_if(options.fields.begin(), options.fields.end(), is_mask);
  if (mask == options.fields.end())
    return constant(1);
  const DoubleVector& values = mask->values;
  return table<std::int32_t>(1, [&values](std::int64_t i, std::int64_t /*k*/) {
    return static_cast<std::int32_t>(values[i]);
  });
}

void drop_derived_fields(RawMesh& raw) {
  std::erase_if(raw.fields, [&](const MeshField& field) {
    return (is_mask(field) && (field.values.array() == 1).all()) ||
           (is_area(field) && are_areas_of(raw.polygons, field.values));
  });
}

LonLats checked(const NetcdfReader& file, const std::string& variables, LonLats points) {
  constexpr double pole = 90 * (1 + 0x1p-50); // from radians, a pole may come a rounding beyond it
  for (std::size_t i = 0; i < points.longitudes.size(); ++i) {
    double& latitude = points.latitudes[i];
    if (!std::isfinite(points.longitudes[i]) || !(std::abs(latitude) <= pole))
      file.fail("{} hold no place on the sphere at index {} (0-based): longitude {}, latitude {} "
                "degrees; make the file again",
                variables, i, points.longitudes[i], latitude);
    latitude = std::clamp(latitude, -90.0, 90.0);
  }
  return points;
}

LonLats read_degrees(const NetcdfReader& file, const std::string& longitude,
                     const std::string& latitude, const std::vector<std::int64_t>& shape) {
  LonLats points{cf_values(file, longitude, shape), {}};
  points.latitudes = cf_values(file, latitude, file.shape_of(longitude));
  scale(points.longitudes, degrees_per_unit(file, longitude));
  scale(points.latitudes, degrees_per_unit(file, latitude));
  return checked(file, longitude + " and " + latitude, std::move(points));
}

Points3 from_degrees(const std::vector<double>& longitudes, const std::vector<double>& latitudes) {
  Points3 points;
  points.resize(3, std::ssize(longitudes));
  for_each_block(points.cols(), [&](std::int64_t /*block*/, std::int64_t begin, std::int64_t end) {
    from_lonlats(longitudes.data() + begin, latitudes.data() + begin, end - begin,
                 reinterpret_cast<Vec3*>(points.data()) + begin);
  });
  return points;
}

Points3 read_lonlats(const NetcdfReader& file, const std::string& longitude,
                     const std::string& latitude, const std::vector<std::int64_t>& shape) {
  const LonLats points = read_degrees(file, longitude, latitude, shape);
  return from_degrees(points.longitudes, points.latitudes);
}

double find_rounding(const NetcdfReader& file, const std::string& variable) {
  return file.has_variable(variable) && file.is_float(variable) ? float_rounding : 0;
}

} // namespace calotte::io_detail
