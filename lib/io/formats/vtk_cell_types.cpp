// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/vtk_cell_types.h"

#include "base/message.h"
#include "io/bytes/file_error.h"

#include <array>
#include <string_view>
#include <utility>

namespace calotte::io_detail {
namespace {

/// The name of a type that is not read (vtkCellType.h).
std::string type_name(std::int32_t type) {
  constexpr std::array<std::pair<std::int32_t, std::string_view>, 17> names{
      {{0, "empty cell"},
       {1, "vertex"},
       {2, "vertices"},
       {3, "line"},
       {4, "polyline"},
       {6, "triangle strip"},
       {8, "pixel"},
       {10, "tetrahedron"},
       {11, "voxel"},
       {12, "hexahedron"},
       {13, "wedge"},
       {14, "pyramid"},
       {21, "quadratic edge"},
       {22, "quadratic triangle"},
       {23, "quadratic quad"},
       {42, "polyhedron"},
       {69, "Lagrange triangle"}}};
  for (const auto& [number, name] : names)
    if (number == type)
      return message(" ({})", name);
  return {};
}

} // namespace

void require_cell_types(const std::string& name, const PolyData& poly_data, const Ids& types,
                        const std::string& array) {
  for (std::int64_t i = 0; i < poly_data.size(); ++i) {
    const std::int32_t type = types[i];
    if (type != triangle_type && type != polygon_type && type != quad_type)
      fail_file(in_array(name, array), i,
                "cell {} has the type {}{}; only 5 (triangle), 7 (polygon) and 9 (quad) are read, "
                "remove the others",
                i, type, type_name(type));
    const std::int64_t corners = poly_data.ids.count(i);
    if ((type == triangle_type && corners != 3) || (type == quad_type && corners != 4))
      fail_file(in_array(name, array), i,
                "cell {} has the type {} but {} corners; make the file again", i, type, corners);
  }
}

void refuse_strips(const std::string& name, std::int64_t strips) {
  fail_file(name,
            "it has {} triangle strips, which are not read; write triangles (vtkTriangleFilter)",
            strips);
}

} // namespace calotte::io_detail
