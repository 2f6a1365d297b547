// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/poly_data.h"

#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/bytes/scalars.h"
#include "io/bytes/text.h"
#include "io/cells/mesh_intake.h"
#include "io/cells/model_grid.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace calotte::io_detail {
namespace {

constexpr const char* site_name = "site";
constexpr const char* triangle_name = "triangle";

/// Maximum error of a direction in single precision, and of the circumcentre of three such
/// directions, in radians.
constexpr double single_rounding = 4 * 0x1p-24;

/// Whether an array of the cells is computed from the mesh whenever it is written.
bool is_derived(const std::string& name) {
  constexpr std::array<std::string_view, 4> derived{"area", "spacing", "quality", "degree"};
  return std::find(derived.begin(), derived.end(), name) != derived.end();
}

bool has_centres(const std::string& name) { return name == site_name || name == "Center"; }

const DataArray* find(const PolyData& poly_data, const std::string& name, bool of_polygons) {
  const auto found =
      std::find_if(poly_data.arrays.begin(), poly_data.arrays.end(), [&](const DataArray& array) {
        return array.name == name && array.of_polygons == of_polygons && array.components == 3;
      });
  return found == poly_data.arrays.end() ? nullptr : &*found;
}

Points3 as_points(const DataArray& array) {
  return Eigen::Map<const Points3>(array.values.data(), 3, array.values.size() / 3);
}

bool all_triangles(const PolyData& poly_data) {
  for (std::int64_t i = 0; i <= poly_data.size(); ++i)
    if (poly_data.ids.begin[i] != 3 * i)
      return false;
  return true;
}

// ---- Voronoi cells as calotte writes them

Triangles read_triangles(const std::string& name, const DataArray& array, std::int64_t sites) {
  Triangles triangles(3, array.values.size() / 3);
  for (Eigen::Index k = 0; k < array.values.size(); ++k) {
    const auto id = number_as<std::int32_t>(array.values[k]);
    if (id < 0 || id >= sites)
      fail_file(
          in_array(name, triangle_name), k / 3,
          "it has a site at point {} that is not one of the {} cells; make the file again, or "
          "remove the array to read the cells alone",
          k / 3, sites);
    triangles.data()[k] = id;
  }
  return triangles;
}

/// Requires that each corner of a cell belongs to a triangle of its site. Another program may have
/// removed or renumbered cells.
void require_triangles_of_cells(const std::string& name, const PolyData& poly_data,
                                const Triangles& triangles) {
  for (std::int64_t i = 0; i < poly_data.size(); ++i)
    for (const std::int32_t corner : poly_data.ids[i])
      if (!(triangles.col(corner).array() == i).any())
        fail_file(
            in_array(name, triangle_name), i,
            "cell {} has the corner {}, whose triangle is not one of the cell; the cells were "
            "changed, so remove the array to read them alone",
            i, corner);
}

// ---- Fields

void add_field(DataArray& array, FieldLocation location, std::set<std::string>& names,
               RawMesh& raw) {
  if (location == FieldLocation::cells && is_derived(array.name))
    return;
  const bool first = names.insert(array.name).second;
  if (!first)
    raw.ignored.push_back(std::move(array.name));
  else if (location == FieldLocation::cells && array.name == "density")
    raw.density = std::move(array.values);
  else
    raw.fields.push_back(
        {.name = std::move(array.name), .location = location, .values = std::move(array.values)});
}

/// Adds arrays of one component as fields.
void add_fields(PolyData& poly_data, bool polygons_are_cells, RawMesh& raw) {
  std::set<std::string> names;
  raw.ignored = std::move(poly_data.ignored);
  for (DataArray& array : poly_data.arrays)
    if (array.components == 1 && array.values.size() > 0)
      add_field(array,
                array.of_polygons == polygons_are_cells ? FieldLocation::cells
                                                        : FieldLocation::vertices,
                names, raw);
    else if (array.name != site_name && array.name != triangle_name && !polygons_are_cells)
      raw.ignored.push_back(array.name);
}

// ---- Cells

Points3 directions(const std::string& name, const Points3& points) {
  require_directions(name, points);
  return on_sphere(points, 1);
}

RawMesh make_cells(const std::string& name, PolyData& poly_data, const DataArray* centres) {
  RawMesh raw;
  if (lies_in_plane(poly_data.points)) {
    if (centres == nullptr)
      refuse_path(name, "z is 0 at all points; of a plane only triangles, and cells with an array "
                        "site, are read");
    raw.points = as_points(*centres);
    raw.polygons = {std::move(poly_data.points), std::move(poly_data.ids), raw.points,
                    Surface::plane()};
    return raw;
  }
  raw.polygons = {directions(name, poly_data.points), std::move(poly_data.ids), Points3(3, 0)};
  if (centres != nullptr) {
    raw.points = as_points(*centres);
    raw.polygons.centres = directions(in_array(name, centres->name), raw.points);
  }
  raw.corner_rounding = poly_data.single ? single_rounding : 0;
  return raw;
}

} // namespace

std::string in_array(const std::string& name, const std::string& array) {
  return message("{}: array {}", name, in_quotes(array));
}

bool is_read(const std::string& name, bool of_polygons, std::int64_t components) {
  return components == 1 ||
         (components == 3 && (of_polygons ? has_centres(name) : name == triangle_name));
}

void require_polygons(const std::string& name, const PolyData& poly_data,
                      const PolyDataNames& names) {
  const std::int64_t count = poly_data.size();
  const auto& [begins, ids] = poly_data.ids;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t begin = begins[i], end = begins[i + 1];
    if (end > ids.size())
      fail_file(in_array(name, names.offsets), i,
                "polygon {} ends at {}, but there are {} corners; make the file again", i, end,
                ids.size());
    if (end < begin || end - begin < 3)
      fail_file(
          in_array(name, names.offsets), i,
          "polygon {} runs from {} to {}, so it has fewer than 3 corners; make the file again", i,
          begin, end);
    for (std::int64_t k = begin; k < end; ++k)
      if (ids[k] < 0 || ids[k] >= poly_data.points.cols())
        fail_file(in_array(name, names.ids), i,
                  "polygon {} has a corner that is not one of the {} points; make the file again",
                  i, poly_data.points.cols());
  }
  if (const std::int64_t used = count > 0 ? begins[count] : 0; used != ids.size())
    fail_file(in_array(name, names.ids),
              "it has {} corners, but the {} polygons have {}; make the file again", ids.size(),
              count, used);
}

RawMesh make_raw_mesh(const std::string& name, PolyData&& poly_data) {
  const DataArray* const site = find(poly_data, site_name, true);
  const DataArray* const triangle = find(poly_data, triangle_name, false);
  const bool cells = poly_data.size() > 0 && (site != nullptr || !all_triangles(poly_data));
  RawMesh raw;
  if (cells && site != nullptr && triangle != nullptr) {
    raw.points = as_points(*site);
    raw.triangles = read_triangles(name, *triangle, poly_data.size());
    require_triangles_of_cells(name, poly_data, raw.triangles);
  } else if (cells) {
    raw = make_cells(name, poly_data, site != nullptr ? site : find(poly_data, "Center", true));
  } else {
    raw.points = std::move(poly_data.points);
    raw.triangles = Eigen::Map<const Triangles>(poly_data.ids.items.data(), 3, poly_data.size());
  }
  raw.has_cells = cells;
  add_fields(poly_data, cells, raw);
  return raw;
}

} // namespace calotte::io_detail
