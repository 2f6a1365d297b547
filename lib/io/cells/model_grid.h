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

/// Common code for NetCDF files of grids as polygons on longitudes and latitudes (UGRID, SCRIP,
/// ESMF).
namespace calotte::io_detail {

// ---- Writing

/// Scales unit vectors by `radius`. A point that has that norm, up to rounding, keeps its bits.
/// \throws Error invalid_argument for a radius that is not positive and finite.
Points3 on_sphere(Points3 points, double radius);

/// The options for a file of a plane.
WriteOptions of_plane(WriteOptions options);

/// Cells as a file of polygons stores them.
struct CellGrid {
  Polygons polygons;
  DoubleVector area; ///< steradians; in a plane the square of its unit
  Points3 sites;     ///< of the cells, with their norms; 3 x 0 without sites
};

/// The density of the options at the cells, divided by its maximum. The density by site takes
/// precedence. Empty if it is uniform.
/// \throws Error invalid_argument.
DoubleVector density_at_cells(const Voronoi& voronoi, const WriteOptions& options);
/// The fields of the cells, with that density.
/// \throws Error invalid_argument.
CellFields make_cell_fields(const Voronoi& voronoi, const WriteOptions& options);

CellGrid cell_grid(const Mesh& mesh); ///< the Voronoi cells. \throws Error as voronoi().
CellGrid cell_grid(const Polygons& polygons);

/// Maximum number of corners of a cell.
std::int64_t most_corners(const Voronoi& cells);

/// Contents of variables: coordinates of columns of points. Longitudes and latitudes require unit
/// columns. The points must outlive the result.
NetcdfWriter::Fill<double> longitudes_of(const Points3& points);
NetcdfWriter::Fill<double> latitudes_of(const Points3& points);
NetcdfWriter::Fill<double> lonlats_of(const Points3& points); ///< both in each row
NetcdfWriter::Fill<double> coordinate_row(const Points3& points, int row);
NetcdfWriter::Fill<double> values_of(const DoubleVector& values);
NetcdfWriter::Fill<std::int32_t> constant(std::int64_t value);

/// Contents of a variable: of(row, k) for 0 <= k < width in each row.
template <class T, class Of> NetcdfWriter::Fill<T> table(std::int64_t width, const Of& of) {
  return [width, of](std::int64_t begin, std::int64_t end, T* out) {
    for (std::int64_t row = begin; row < end; ++row)
      for (std::int64_t k = 0; k < width; ++k)
        *out++ = of(row, k);
  };
}

/// The attribute of files on the unit sphere that has the radius of the planet, metres.
inline constexpr const char* planet_attribute = "planet_radius";

/// The smallest radius of a sphere in metres that is taken for a planet's.
inline constexpr double smallest_planet = 1e4;

/// A file whose variables are declared together with their contents.
class NetcdfGridFile {
public:
  /// Sets the attributes that all such files have. \throws Error file.
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
  /// Declares a variable whose contents are big-endian bytes, see NetcdfWriter::put(). It may have
  /// records.
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
  /// Declares variables with the same number of rows whose contents are computed together. They are
  /// in this order in the file.
  void together(const std::vector<Announced>& variables, const NetcdfWriter::GroupFill& contents);
  /// Adds a computation that commit() runs between writing the variables declared before it and
  /// those declared after it.
  void then(std::function<void()> computation) {
    stages_.back().puts.push_back(std::move(computation));
  }
  /// Adds a computation that makes the contents of all variables declared after it. commit() runs
  /// it after earlier computations and concurrently with writing the variables declared before it,
  /// so that the disk need not wait.
  void after(std::function<void()> computation);
  /// \throws Error file; what contents and computation throw.
  void commit();

private:
  using Step = std::function<void()>;
  /// A computation, and the writes that depend on it and on those before it.
  struct Stage {
    Step computation;
    std::vector<Step> puts;
  };

  NetcdfWriter file_;
  std::vector<Stage> stages_ = {{[] {}, {}}};
};

/// The mask variables of SCRIP and ESMF, with 0 for masked cells.
inline constexpr std::array<const char*, 2> mask_names{"grid_imask", "elementMask"};

/// Whether a field is the mask of SCRIP or ESMF. Each format has its own variable for it.
bool is_mask(const MeshField& field);

/// The mask among the fields of the options, under either name; 1 without one.
NetcdfWriter::Fill<std::int32_t> make_mask(const WriteOptions& options);

// ---- Reading

/// Maximum rounding error of an angle up to 360 degrees in single precision, in radians.
inline constexpr double float_rounding = 4e-7;

/// That of a variable of angles or of unit vectors; 0 in double precision, and without it.
double find_rounding(const NetcdfReader& file, const std::string& variable);

/// Removes fields that a writer computes: areas of SCRIP and ESMF that are those of the polygons up
/// to rounding, and masks that are 1 at all cells.
void drop_derived_fields(RawMesh& raw);

/// Points in degrees, as many longitudes as latitudes.
struct LonLats {
  std::vector<double> longitudes, latitudes; ///< finite; from -90 to 90
};

/// Checks points.
/// \param variables names for messages.
/// \throws Error parse, for a point that is not finite or beyond a pole.
LonLats checked(const NetcdfReader& file, const std::string& variables, LonLats points);

/// Reads longitudes and latitudes from two variables of that shape. \throws Error parse, file.
LonLats read_degrees(const NetcdfReader& file, const std::string& longitude,
                     const std::string& latitude, const std::vector<std::int64_t>& shape = {-1});

/// Unit columns.
Points3 from_degrees(const std::vector<double>& longitudes, const std::vector<double>& latitudes);

/// The same as unit columns. \throws Error parse, file.
Points3 read_lonlats(const NetcdfReader& file, const std::string& longitude,
                     const std::string& latitude, const std::vector<std::int64_t>& shape = {-1});

} // namespace calotte::io_detail
