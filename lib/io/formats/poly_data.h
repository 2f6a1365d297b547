// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/formats.h"
#include "io/formats/room.h"

#include <calotte/matrices.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <string>
#include <vector>

/// Polygons with data, as in files of graphics programs: VTK and PLY.
namespace calotte::io_detail {

template <class T> using Column = Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// Data of the points or of the polygons.
struct DataArray {
  std::string name;
  bool of_polygons = false;
  int components = 1;
  DoubleVector values; ///< all components of one tuple, then those of the next
};

/// The contents of a file, before it is known whether its points are sites or corners of cells.
struct PolyData {
  Points3 points;                   ///< as in the file
  bool single = false;              ///< whether the points in the file have single precision
  IdLists ids;                      ///< corners of each polygon: 0-based points, in order
  std::vector<DataArray> arrays;    ///< arrays that is_read() selects
  std::vector<std::string> ignored; ///< names of other arrays

  std::int64_t size() const { return ids.size(); } ///< number of polygons
};

/// Whether make_raw_mesh() uses an array of that name.
bool is_read(const std::string& name, bool of_polygons, std::int64_t components);

/// The names of the parts of poly data in a file, for messages.
struct PolyDataNames {
  std::string offsets = "offsets", ids = "connectivity";
};

/// \throws Error parse, naming the first polygon whose corners are fewer than three, out of range,
/// or not among the ids.
void require_polygons(const std::string& name, const PolyData& poly_data,
                      const PolyDataNames& names = {});

/// The mesh of poly data whose polygons are valid.
///
/// - Polygons with the array `site`, and the array `triangle` of the points: Voronoi cells as
///   calotte writes them. The result has the sites and their triangles.
/// - Triangles, or points alone: the points are the sites.
/// - Other polygons: cells, with centres where there is an array `site` or `Center`.
///
/// Arrays of one component become fields, `density` of the cells the density. Those that calotte
/// derives from a mesh are left out.
/// \throws Error parse; invalid_argument for polygons in a plane without centres.
RawMesh make_raw_mesh(const std::string& name, PolyData&& poly_data);

/// The name of an array of a file, for messages.
std::string in_array(const std::string& name, const std::string& array);

} // namespace calotte::io_detail
