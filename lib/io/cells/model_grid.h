// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/lonlat.h"
#include "base/vec3.h"
#include "io/cells/netcdf_fields.h"
#include "io/cells/polygons.h"
#include "io/cells/room.h"
#include "io/netcdf/cf_axes.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"

#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// What NetCDF files of grids as polygons on longitudes and latitudes have in common (UGRID, SCRIP,
/// ESMF).
namespace calotte::io_detail {

// ---- Writing

/// `radius` times the unit vectors; a point whose norm is that but for rounding keeps its bits.
/// \throws Error invalid_argument for a radius that is not positive and finite.
Points3 on_sphere(Points3 points, double radius);

/// Options of a file of a plane.
WriteOptions of_plane(WriteOptions options);

/// Cells as a file of polygons shall hold them.
struct CellGrid {
  Polygons polygons;
  DoubleVector area; ///< steradians; in a plane the square of its unit
  Points3 sites;     ///< of the cells, with their norms; 3 x 0 where they have none
};

/// The options' density at the cells, that of the sites first, divided by its maximum; empty if it
/// is uniform. \throws Error invalid_argument.
DoubleVector density_of(const Voronoi& voronoi, const WriteOptions& options);
/// The cells' fields with that density. \throws Error invalid_argument.
CellFields fields_of(const Voronoi& voronoi, const WriteOptions& options);

CellGrid cell_grid(const Mesh& mesh); ///< the Voronoi cells. \throws Error as voronoi().
CellGrid cell_grid(const Polygons& polygons);

/// The number of corners of the cell that has most.
std::int64_t most_corners(const Voronoi& cells);

/// Columns of points as contents of variables; unit columns, where it is their longitude and
/// latitude. The points must outlive them.
NetcdfWriter::Fill<double> longitudes_of(const Points3& points);
NetcdfWriter::Fill<double> latitudes_of(const Points3& points);
NetcdfWriter::Fill<double> lonlats_of(const Points3& points); ///< two a row
NetcdfWriter::Fill<double> row_of(const Points3& points, int row);
NetcdfWriter::Fill<double> values_of(const DoubleVector& values);
NetcdfWriter::Fill<std::int32_t> constant(std::int64_t value);

/// of(row, k) for 0 <= k < width of each row.
template <class T, class Of> NetcdfWriter::Fill<T> table(std::int64_t width, const Of& of) {
  return [width, of](std::int64_t begin, std::int64_t end, T* out) {
    for (std::int64_t row = begin; row < end; ++row)
      for (std::int64_t k = 0; k < width; ++k)
        *out++ = of(row, k);
  };
}

/// A file whose variables are announced together with their contents.
class NetcdfGridFile {
public:
  /// With the attributes that all such files have. \throws Error file.
  NetcdfGridFile(const std::string& path, const WriteOptions& options,
                 const std::string& conventions);
  NetcdfGridFile(const NetcdfGridFile&) = delete;
  NetcdfGridFile& operator=(const NetcdfGridFile&) = delete;

  NetcdfWriter& netcdf() { return file_; }
  template <class T>
  void variable(const std::string& name, NetcdfType type, const std::vector<int>& dimensions,
                const NetcdfAttributes& attributes, const NetcdfWriter::Fill<T>& contents) {
    const int id = file_.variable(name, type, dimensions, attributes);
    stages_.back().puts.emplace_back([this, id, contents] { file_.put(id, contents); });
  }
  void doubles(const std::string& name, const std::vector<int>& dimensions,
               const NetcdfAttributes& attributes, const NetcdfWriter::Fill<double>& contents) {
    variable(name, NetcdfType::float64, dimensions, attributes, contents);
  }
  void ints(const std::string& name, const std::vector<int>& dimensions,
            const NetcdfAttributes& attributes, const NetcdfWriter::Fill<std::int32_t>& contents) {
    variable(name, NetcdfType::int32, dimensions, attributes, contents);
  }
  /// Bytes as the file has them, see NetcdfWriter::put(); of variables of records, too.
  void bytes(const std::string& name, NetcdfType type, const std::vector<int>& dimensions,
             const NetcdfAttributes& attributes, const NetcdfWriter::FillBytes& contents) {
    const int id = file_.variable(name, type, dimensions, attributes);
    stages_.back().puts.emplace_back(
        [this, id, type, contents] { file_.put(id, size_of(type), contents); });
  }
  struct Announced {
    std::string name;
    std::vector<int> dimensions;
    NetcdfAttributes attributes;
    bool integer = false; ///< int32, otherwise float64
  };
  /// Variables of as many rows, in this order in the file, whose contents are made together.
  void together(const std::vector<Announced>& variables, const NetcdfWriter::GroupFill& contents);
  /// A computation in commit() between the writing of what is announced before and of what is
  /// announced after it.
  void then(std::function<void()> computation) {
    stages_.back().puts.push_back(std::move(computation));
  }
  /// What is announced from here on has contents that such a computation makes. It runs in
  /// commit(), after those before it, and beside the writing of what was announced before, so that
  /// the disk need not wait for it.
  void after(std::function<void()> computation);
  /// \throws Error file; what contents and computation throw.
  void commit();

private:
  using Step = std::function<void()>;
  /// A computation, and the writing that needs it and those before.
  struct Stage {
    Step computation;
    std::vector<Step> puts;
  };

  NetcdfWriter file_;
  std::vector<Stage> stages_ = {{[] {}, {}}};
};

/// The variables of SCRIP and ESMF with 0 for cells that do not count.
inline constexpr std::array<const char*, 2> mask_names{"grid_imask", "elementMask"};

/// A mask of SCRIP or ESMF, of which each format has a variable of its own.
bool is_mask(const MeshField& field);

/// The mask among the options' fields, under the name that SCRIP or ESMF gives it; 1 without.
NetcdfWriter::Fill<std::int32_t> mask_of(const WriteOptions& options);

// ---- Reading

/// How far floats may be from an angle of up to 360 degrees, radians.
inline constexpr double float_rounding = 4e-7;

/// Removes areas of SCRIP and ESMF that are those of the polygons but for rounding, and masks that
/// are 1 at all cells: what a writer makes anew.
void drop_derived_fields(RawMesh& raw);

/// Places in degrees, as many of each.
struct LonLats {
  std::vector<double> longitudes, latitudes; ///< finite; from -90 to 90
};

/// \param variables are named in messages. \throws Error parse, for a place that is not finite or
/// beyond a pole.
LonLats checked(const NetcdfReader& file, const std::string& variables, LonLats places);

/// From a variable each, of that shape. \throws Error parse, file.
LonLats read_degrees(const NetcdfReader& file, const std::string& longitude,
                     const std::string& latitude, const std::vector<std::int64_t>& shape = {-1});

/// Unit columns.
Points3 from_degrees(const std::vector<double>& longitudes, const std::vector<double>& latitudes);

/// From a variable each, of that shape. \throws Error parse, file.
Points3 read_lonlats(const NetcdfReader& file, const std::string& longitude,
                     const std::string& latitude, const std::vector<std::int64_t>& shape = {-1});

} // namespace calotte::io_detail
