// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lists.h"
#include "base/lonlat.h"
#include "base/points.h"
#include "base/require.h"
#include "io/cells/centroids.h"
#include "io/cells/model_grid.h"
#include "io/cells/polygons.h"
#include "io/netcdf/netcdf_reader.h"
#include "remap/weight_rows.h"

#include <calotte/field_grid.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::require;
using remap_detail::matrix_of;
using remap_detail::Weight;
using remap_detail::WeightRow;

// ---- The grids beside the weights

/// A grid in a file of weights, with points in degrees.
struct DescribedGrid {
  std::string name;
  std::vector<std::int32_t> dimensions; ///< sizes of the dimensions of the grid, the fastest first
  Points3 centres;                      ///< unit columns
  std::optional<LonLatBoxes> boxes;     ///< the cells, if they are boxes
  Polygons cells;                       ///< otherwise the cells; none if they are unknown
  DoubleVector area, fraction;
  Ids mask; ///< empty if all are 1

  std::int64_t corners() const { return boxes ? 4 : most_corners(cells); }
};

DescribedGrid described(const FieldGrid& grid, const DoubleVector& area, DoubleVector fraction) {
  DescribedGrid out{.name = grid.name,
                    .dimensions = {static_cast<std::int32_t>(grid.size())},
                    .centres = {},
                    .boxes = grid.boxes,
                    .cells = {},
                    .area = area,
                    .fraction = std::move(fraction),
                    .mask = grid.mask};
  if (grid.boxes) {
    out.dimensions = {static_cast<std::int32_t>(grid.boxes->longitudes.size()),
                      static_cast<std::int32_t>(grid.boxes->latitudes.size())};
    out.centres = nodes(*grid.boxes);
    if (area.size() == 0)
      out.area = areas(*grid.boxes);
    return out;
  }
  out.cells = cells_of(grid);
  out.centres = grid.mesh.polygons
                    ? (out.cells.centres.cols() > 0 ? out.cells.centres : centroids_of(out.cells))
                    : grid.mesh.mesh->points;
  if (area.size() == 0)
    out.area = areas(out.cells);
  return out;
}

void require_sphere(const FieldGrid& grid) {
  require(!grid.positions, "{} has positions, without cells; give a mesh or a raster", grid.name);
  require(grid.boxes || grid.mesh.surface().is_sphere(),
          "{} is in a plane, and files of weights hold longitudes and latitudes; leave the weights "
          "out",
          grid.name);
}

/// The longitude and latitude of corner k of a cell.
base_detail::LonLat corner_lonlat(const DescribedGrid& grid, std::int64_t cell, std::int64_t k) {
  if (!grid.boxes)
    return base_detail::eastern_lonlat_of(
        base_detail::column(grid.cells.corners, corner_or_last(grid.cells, cell, k)));
  const LonLatBoxes& boxes = *grid.boxes;
  const Eigen::Index i = cell % boxes.longitudes.size(), j = cell / boxes.longitudes.size();
  const bool descends = boxes.parallels[j] > boxes.parallels[j + 1], north = (k >= 2) != descends;
  return {boxes.meridians[i + (k == 1 || k == 2 ? 1 : 0)], boxes.parallels[j + (north ? 1 : 0)]};
}

NetcdfAttributes units(const std::string& unit) { return {{"units", unit}}; }

/// The names of a grid's variables in one of the formats.
struct GridNames {
  std::string size, corners, rank, dimensions, center_lat, center_lon, corner_lat, corner_lon, mask,
      area, fraction;
};

GridNames esmf_grid(const std::string& which, const std::string& role) {
  return {"n_" + which,    "nv_" + which,   role + "_grid_rank", role + "_grid_dims",
          "yc_" + which,   "xc_" + which,   "yv_" + which,       "xv_" + which,
          "mask_" + which, "area_" + which, "frac_" + which};
}

GridNames scrip_grid(const std::string& role) {
  const std::string grid = role + "_grid_";
  return {grid + "size",       grid + "corners",    grid + "rank",       grid + "dims",
          grid + "center_lat", grid + "center_lon", grid + "corner_lat", grid + "corner_lon",
          grid + "imask",      grid + "area",       grid + "frac"};
}

/// Declares a grid. \returns the dimension of its cells.
int add_grid(NetcdfGridFile& file, const DescribedGrid& grid, const GridNames& names) {
  const int size = file.netcdf().dimension(names.size, grid.centres.cols()),
            rank = file.netcdf().dimension(names.rank, std::ssize(grid.dimensions));
  file.ints(names.dimensions, {rank}, units("1"),
            table<std::int32_t>(1, [&grid](std::int64_t k, std::int64_t) {
              return grid.dimensions[static_cast<std::size_t>(k)];
            }));
  file.doubles(names.center_lat, {size}, units("degrees"), latitudes_of(grid.centres));
  file.doubles(names.center_lon, {size}, units("degrees"), longitudes_of(grid.centres));
  const std::int64_t width = grid.corners();
  const int corners = file.netcdf().dimension(names.corners, width);
  const auto put = [&](const std::string& name, double base_detail::LonLat::*angle) {
    file.doubles(name, {size, corners}, units("degrees"),
                 table<double>(width, [&grid, angle](std::int64_t cell, std::int64_t k) {
                   return corner_lonlat(grid, cell, k).*angle;
                 }));
  };
  put(names.corner_lat, &base_detail::LonLat::latitude);
  put(names.corner_lon, &base_detail::LonLat::longitude);
  file.ints(names.mask, {size}, units("unitless"),
            grid.mask.size() == 0 ? constant(1)
                                  : table<std::int32_t>(1, [&grid](std::int64_t i, std::int64_t) {
                                      return grid.mask[i];
                                    }));
  file.doubles(names.area, {size}, units("square radians"), values_of(grid.area));
  file.doubles(names.fraction, {size}, units("unitless"), values_of(grid.fraction));
  return size;
}

// ---- The weights

std::string method_name(Interpolation kind, WeightsFormat format) {
  switch (kind) {
  case Interpolation::conservative:
    return "Conservative remapping";
  case Interpolation::nearest:
    return format == WeightsFormat::scrip ? "Distance weighted avg of nearest neighbors"
                                          : "Nearest source to destination";
  default:
    return "Bilinear remapping";
  }
}

/// The rows of the links, 1-based.
NetcdfWriter::Fill<std::int32_t> make_rows(const Weights& weights) {
  return [&weights](std::int64_t begin, std::int64_t end, std::int32_t* out) {
    const int* const first = weights.outerIndexPtr();
    std::int64_t row =
        std::upper_bound(first, first + weights.rows() + 1, begin) - first; // 1-based
    for (std::int64_t k = begin; k < end; ++k) {
      while (first[row] <= k)
        ++row;
      *out++ = static_cast<std::int32_t>(row);
    }
  };
}

NetcdfWriter::Fill<std::int32_t> make_columns(const Weights& weights) {
  return table<std::int32_t>(
      1, [&weights](std::int64_t k, std::int64_t) { return weights.innerIndexPtr()[k] + 1; });
}

NetcdfWriter::Fill<double> make_links(const Weights& weights) {
  return table<double>(1,
                       [&weights](std::int64_t k, std::int64_t) { return weights.valuePtr()[k]; });
}

void add_links(NetcdfGridFile& file, const Weights& weights, WeightsFormat format) {
  const bool esmf = format == WeightsFormat::esmf;
  const int links = file.netcdf().dimension(esmf ? "n_s" : "num_links", weights.nonZeros());
  file.ints(esmf ? "col" : "src_address", {links}, {}, make_columns(weights));
  file.ints(esmf ? "row" : "dst_address", {links}, {}, make_rows(weights));
  if (esmf)
    file.doubles("S", {links}, {}, make_links(weights));
  else
    file.doubles("remap_matrix", {links, file.netcdf().dimension("num_wgts", 1)}, {},
                 make_links(weights));
}

void add_attributes(NetcdfGridFile& file, const DescribedGrid& source, const DescribedGrid& target,
                    Interpolation kind, WeightsFormat format) {
  const auto add = [&](const std::string& name, const std::string& value) {
    file.netcdf().attribute({name, value});
  };
  add("title", "weights of calotte");
  add("normalization", kind == Interpolation::conservative ? "fracarea" : "none");
  add("map_method", method_name(kind, format));
  if (format == WeightsFormat::esmf) {
    add("conventions", "NCAR-CSM");
    add("domain_a", source.name);
    add("domain_b", target.name);
    add("grid_file_src", source.name);
    add("grid_file_dst", target.name);
  } else {
    add("conventions", "SCRIP");
    add("source_grid", source.boxes ? "lonlat" : "unstructured");
    add("dest_grid", target.boxes ? "lonlat" : "unstructured");
    file.netcdf().attribute({"remap_order", std::int32_t{1}});
  }
}

// ---- Reading

struct LinkNames {
  std::string source_size, target_size, column, row, weight, target_fraction, source_fraction,
      source_area, target_area;
};

std::optional<LinkNames> find_names(const NetcdfReader& file) {
  if (file.has_variable("S") && file.has_variable("row") && file.has_variable("col"))
    return LinkNames{"n_a", "n_b", "col", "row", "S", "frac_b", "frac_a", "area_a", "area_b"};
  if (file.has_variable("remap_matrix") && file.has_variable("src_address") &&
      file.has_variable("dst_address"))
    return LinkNames{"src_grid_size", "dst_grid_size", "src_address",
                     "dst_address",   "remap_matrix",  "dst_grid_frac",
                     "src_grid_frac", "src_grid_area", "dst_grid_area"};
  return std::nullopt;
}

/// Reads the weights of links; if a link has several, the first.
std::vector<double> first_weights(const NetcdfReader& file, const std::string& name,
                                  std::int64_t links) {
  const std::vector<std::int64_t> shape = file.shape_of(name);
  const std::vector<double> all = file.doubles(name, shape);
  const std::int64_t width = shape.size() == 2 ? shape[1] : 1;
  if (std::ssize(all) != links * width)
    file.fail("{} has {} values for {} links; make the weights again", name, all.size(), links);
  std::vector<double> weights(static_cast<std::size_t>(links));
  for (std::size_t k = 0; k < all.size(); ++k)
    if (k % static_cast<std::size_t>(width) == 0)
      weights[k / static_cast<std::size_t>(width)] = all[k];
    else if (all[k] != 0)
      file.fail("{} has gradients of second order; give weights of first order", name);
  return weights;
}

/// \param row, column of the links, 1-based. Weights of the same pair are added.
Weights make_matrix(std::int64_t rows, std::int64_t columns, const std::vector<std::int32_t>& row,
                    const std::vector<std::int32_t>& column, const std::vector<double>& weight) {
  const auto links = base_detail::lists_by_key<WeightRow>(rows, [&](const auto& put) {
    for (std::size_t k = 0; k < row.size(); ++k)
      put(row[k] - 1, Weight{column[k] - 1, weight[k]});
  });
  return matrix_of(rows, columns, [&](std::int64_t i, WeightRow& out) {
    out.assign(links[i].begin(), links[i].end());
    sort_by_column(out);
    merge_columns(out);
  });
}

Weights read_links(const NetcdfReader& file, const LinkNames& names) {
  const std::int64_t columns = file.dimension(names.source_size),
                     rows = file.dimension(names.target_size);
  if (columns < 0 || rows < 0)
    file.fail("no dimensions {} and {}; make the weights again", names.source_size,
              names.target_size);
  const std::vector<std::int32_t> column = file.ints(names.column, {-1}),
                                  row = file.ints(names.row, {std::ssize(column)});
  const std::vector<double> weight = first_weights(file, names.weight, std::ssize(column));
  for (std::size_t k = 0; k < column.size(); ++k)
    if (column[k] < 1 || column[k] > columns || row[k] < 1 || row[k] > rows)
      file.fail(
          "link {} (0-based) joins {} {} and {} {} of {} and {} cells; make the weights again", k,
          names.column, column[k], names.row, row[k], columns, rows);
  return make_matrix(rows, columns, row, column, weight);
}

DoubleVector values_or(const NetcdfReader& file, const std::string& name, std::int64_t size,
                       double otherwise) {
  if (!file.has_variable(name))
    return DoubleVector::Constant(size, otherwise);
  const std::vector<double> values = file.doubles(name, {size});
  return Eigen::Map<const DoubleVector>(values.data(), size);
}

} // namespace
} // namespace io_detail

void write_weights(const std::string& path, const GridWeights& weights, const FieldGrid& source,
                   const FieldGrid& target, Interpolation kind, WeightsFormat format,
                   const std::string& history) {
  using namespace io_detail;
  io_detail::require_sphere(source);
  io_detail::require_sphere(target);
  const DescribedGrid from = described(source, weights.source_area, weights.source_fraction),
                      to = described(target, weights.target_area, weights.target_fraction);
  WriteOptions options;
  options.history = history;
  NetcdfGridFile file(path, options, "CF-1.8");
  const bool esmf = format == WeightsFormat::esmf;
  add_attributes(file, from, to, kind, format);
  add_grid(file, from, esmf ? esmf_grid("a", "src") : scrip_grid("src"));
  add_grid(file, to, esmf ? esmf_grid("b", "dst") : scrip_grid("dst"));
  add_links(file, weights.weights, format);
  file.commit();
}

GridWeights read_weights(const std::string& path) {
  using namespace io_detail;
  const NetcdfReader file(path);
  const std::optional<LinkNames> names = find_names(file);
  if (!names)
    file.fail("no weights of ESMF (row, col, S) or SCRIP (src_address, dst_address, remap_matrix); "
              "give a file of weights");
  GridWeights out{.weights = read_links(file, *names),
                  .source_area = {},
                  .target_area = {},
                  .source_fraction = {},
                  .target_fraction = {}};
  const std::int64_t n = out.weights.cols(), m = out.weights.rows();
  out.source_area = values_or(file, names->source_area, n, 0);
  out.target_area = values_or(file, names->target_area, m, 0);
  out.source_fraction = values_or(file, names->source_fraction, n, 1);
  out.target_fraction = values_or(file, names->target_fraction, m, 1);
  return out;
}

} // namespace calotte
