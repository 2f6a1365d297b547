// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats/formats.h"
#include "io/formats/room.h"

#include <calotte/matrices.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <string>
#include <vector>

/// Polygons with data, as files of graphics programs hold them: VTK and PLY.
namespace calotte::io_detail {

template <class T> using Column = Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// Data of the points or of the polygons.
struct DataArray {
  std::string name;
  bool of_polygons = false;
  int components = 1;
  DoubleVector values; ///< tuple after tuple
};

/// A file's contents, before it is known whether its points are sites or corners of cells.
struct PolyData {
  Points3 points;                   ///< as in the file
  bool single = false;              ///< the file holds the points in single precision
  IdLists ids;                      ///< of each polygon: 0-based points, in order around it
  std::vector<DataArray> arrays;    ///< those that is_read() selects, others are left out
  std::vector<std::string> ignored; ///< names of other arrays

  std::int64_t size() const { return ids.size(); } ///< number of polygons
};

/// Whether raw_mesh_of() uses an array of that name.
bool is_read(const std::string& name, bool of_polygons, std::int64_t components);

/// What a file calls the parts of poly data, for messages.
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
RawMesh raw_mesh_of(const std::string& name, PolyData&& poly_data);

/// The name of an array of a file, for messages.
std::string in_array(const std::string& name, const std::string& array);

} // namespace calotte::io_detail
