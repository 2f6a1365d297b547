// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/formats.h"
#include "io/room.h"

#include <calotte/voronoi.h>

#include <cstdint>
#include <string>
#include <vector>

/// Polygons with data, as files of graphics programs hold them: VTK and PLY.
namespace calotte::io_detail {

template <class T> using Column = Eigen::Matrix<T, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// Data of the points or of the polygons.
struct SurfaceArray {
  std::string name;
  bool of_polygons = false;
  int components = 1;
  DoubleVector values; ///< tuple after tuple
};

/// A file's contents, before it is known whether its points are sites or corners of cells.
struct Surface {
  Points3 points;                   ///< as in the file
  bool single = false;              ///< the file holds the points in single precision
  Offsets begin;                    ///< n + 1: polygon i has the corners ids[begin[i]] and so on
  Ids ids;                          ///< 0-based points, in order around the polygon
  std::vector<SurfaceArray> arrays; ///< those that is_read() selects, others are left out
  std::vector<std::string> ignored; ///< names of other arrays

  std::int64_t size() const { return begin.size() > 0 ? begin.size() - 1 : 0; }
};

/// Whether raw_mesh_of() uses an array of that name.
bool is_read(const std::string& name, bool of_polygons, std::int64_t components);

/// What a file calls the parts of a surface, for messages.
struct SurfaceNames {
  std::string offsets = "offsets", ids = "connectivity";
};

/// \throws Error parse, naming the first polygon whose corners are fewer than three, out of range,
/// or not among the ids.
void require_polygons(const std::string& name, const Surface& surface,
                      const SurfaceNames& names = {});

/// The mesh of a surface whose polygons are valid.
///
/// - Polygons with the array `site`, and the array `triangle` of the points: Voronoi cells as
///   calotte writes them. The result has the sites and their triangles.
/// - Triangles, or points alone: the points are the sites.
/// - Other polygons: cells, with centres where there is an array `site` or `Center`.
///
/// Arrays of one component become fields, `density` of the cells the density. Those that calotte
/// derives from a mesh are left out.
/// \throws Error parse; invalid_argument for polygons in a plane without centres.
RawMesh raw_mesh_of(const std::string& name, Surface&& surface);

/// \throws Error parse: what is wrong with an array.
[[noreturn]] void fail_array(const std::string& name, const std::string& array,
                             const std::string& problem, std::int64_t index = -1);

} // namespace calotte::io_detail
