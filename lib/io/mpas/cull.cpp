// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/cut.h>

#include "base/require.h"
#include "io/command.h"
#include "io/mpas/mpas_cull.h"
#include "io/mpas/mpas_subset.h"
#include "io/mpas/mpas_variables.h"

#include <calotte/error.h>
#include <calotte/read.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

void require_options(const CullOptions& options, const std::string& target) {
  require(options.land_fraction >= 0 && options.land_fraction < 1,
          "the fraction of land is not from 0 to less than 1; give one such as 0.5");
  require(!options.coast.rings.empty() || options.raster.values.size() > 0 ||
              !options.field.variable.empty() || !options.barriers.empty(),
          "there is no land; give a coast, a raster, a field or a barrier");
  require(options.land_path.empty() || options.land_path != target,
          "the file of the sea and that of all other cells have one name; give another");
  require(!options.sea_ice_latitude ||
              (*options.sea_ice_latitude >= 0 && *options.sea_ice_latitude <= 90),
          "the latitude of sea ice is not from 0 to 90 degrees; give one such as 43");
  require(!options.sphere_radius ||
              (*options.sphere_radius > 0 && std::isfinite(*options.sphere_radius)),
          "the radius of the sphere is not positive and finite; give another");
}

/// Requires cells that cover the sphere: coasts and rasters are traced through them around the
/// whole sphere.
/// \throws Error invalid_argument, for a part of the sphere.
void require_global(const MpasSource& source, const Voronoi& cells) {
  require(
      cells.cells_on_cell.items.minCoeff() >= 0,
      "{} does not cover the sphere, so that coasts and rasters leave its cells; leave the land "
      "out of the global mesh with calotte cull and cut the region from that ocean with calotte "
      "cut, or tell the sea by a field",
      source.netcdf().path());
}

/// The cells of the source, as far as the options need them.
struct SourceCells {
  IdLists cells_on_cell;
  std::optional<Voronoi> cells; ///< for coasts, rasters and lines
};

SourceCells read_source_cells(const MpasSource& source, const CullOptions& options) {
  if (options.coast.rings.empty() && options.raster.values.size() == 0 &&
      options.passages.empty() && options.barriers.empty() && options.seeds.cols() == 0)
    return {source.lists(mpas::cells_on_cell, source.cells()), {}};
  Voronoi cells = read_tessellation(source);
  if (!options.coast.rings.empty() || options.raster.values.size() > 0)
    require_global(source, cells);
  return {cells.cells_on_cell, std::move(cells)};
}

/// The land fractions by the coast or the raster; the larger one, if there are both; empty without
/// these.
DoubleVector compute_fractions(const SourceCells& source_cells, const CullOptions& options) {
  DoubleVector fractions;
  if (!options.coast.rings.empty())
    fractions = land_fractions(*source_cells.cells, options.coast);
  if (options.raster.values.size() == 0)
    return fractions;
  const DoubleVector sampled = land_fractions(*source_cells.cells, options.raster);
  return fractions.size() > 0 ? DoubleVector(fractions.cwiseMax(sampled)) : sampled;
}

/// Whether each cell is land.
struct Land {
  std::vector<std::uint8_t> flags;
  DoubleVector fractions;
};

Land find_land(const std::string& source, const SourceCells& source_cells,
               const CullOptions& options) {
  const std::int64_t n = source_cells.cells_on_cell.size();
  Land land{std::vector<std::uint8_t>(static_cast<std::size_t>(n), 0),
            compute_fractions(source_cells, options)};
  const SeaField& field = options.field;
  DoubleVector values;
  if (!field.variable.empty())
    values = read_cell_field(field.path.empty() ? source : field.path, field.variable, n).values;
  for (std::int64_t i = 0; i < n; ++i) {
    const bool by_fraction = land.fractions.size() > 0 && land.fractions[i] > options.land_fraction;
    const bool by_field =
        values.size() > 0 && !(values[i] >= field.lower && values[i] < field.upper);
    land.flags[static_cast<std::size_t>(i)] = by_fraction || by_field ? 1 : 0;
  }
  return land;
}

/// Flags the cells from a latitude on, degrees, towards both poles.
std::vector<std::uint8_t> flag_poleward(const MpasSource& source, double latitude) {
  const double least = std::sin(latitude * std::numbers::pi / 180);
  const Points3 generators = source.generators();
  std::vector<std::uint8_t> flags;
  for (const auto& at : generators.colwise())
    flags.push_back(std::abs(at.z()) >= least * at.norm() ? 1 : 0);
  return flags;
}

SeaOptions sea_options(const MpasSource& source, const SourceCells& source_cells,
                       const CullOptions& options) {
  SeaOptions sea;
  sea.fill = options.fill;
  if (options.sea_ice_latitude)
    sea.need_open_vertex = flag_poleward(source, *options.sea_ice_latitude);
  if (!options.passages.empty())
    sea.opened = cells_on_lines(*source_cells.cells, options.passages);
  if (!options.barriers.empty())
    sea.closed = cells_on_lines(*source_cells.cells, options.barriers);
  for (const auto seed : options.seeds.colwise())
    sea.seeds.push_back(cells_on_lines(*source_cells.cells, {Points3(seed)}).front());
  return sea;
}

/// The passages that are on land and do not connect to the sea, as in cells that are wider than a
/// gulf.
/// \throws Error invalid_argument, naming the first one, if all passages are so.
std::vector<std::int64_t> stranded_passages(const SourceCells& source_cells, const Land& land,
                                            const Ids& sea, const CullOptions& options) {
  std::vector<std::int64_t> stranded;
  for (std::size_t p = 0; p < options.passages.size(); ++p) {
    const std::vector<std::int32_t> cells =
        cells_on_lines(*source_cells.cells, {options.passages[p]});
    if (std::all_of(cells.begin(), cells.end(), [&](std::int32_t cell) {
          return land.flags[static_cast<std::size_t>(cell)] != 0 && sea[cell] < 0;
        }))
      stranded.push_back(static_cast<std::int64_t>(p));
  }
  if (!stranded.empty() && stranded.size() == options.passages.size())
    refuse(message("passage {} lies on land only and reaches no sea; begin and end it in the sea, "
                   "and give longitudes first",
                   stranded.front()),
           stranded.front());
  return stranded;
}

/// The middle of each part of the sea that is left out.
Points3 middles(const MpasSource& source, const std::vector<SeaPart>& parts) {
  Points3 found(3, std::ssize(parts));
  if (parts.empty())
    return found;
  const Points3 generators = source.generators();
  for (std::size_t k = 0; k < parts.size(); ++k)
    found.col(static_cast<Eigen::Index>(k)) = generators.col(parts[k].middle).normalized();
  return found;
}

void add_maps(const MpasPart& part, NetcdfSubset& subset) {
  const auto add = [&](const MpasKind& kind, const Kept& kept) {
    const std::string name = kind.base_numbers();
    subset.left_out.push_back(name); // left by an earlier cull
    subset.added.push_back({name, kind.dimension(), "0-based id in the mesh before culling",
                            [&kept](std::int64_t i) { return kept.old[i]; }});
  };
  add(mpas_cell, part.cells);
  add(mpas_edge, part.edges);
  add(mpas_vertex, part.vertices);
}

// ---- Files beside the grid

/// Writes the masks that the culler of MPAS-Tools reads.
void put_mask(const Ids& sea, const DoubleVector& fractions, NetcdfWriter& file) {
  const int cells = file.dimension(mpas_cell.dimension(), sea.size()),
            regions = file.dimension("nRegions", 1);
  const auto define = [&](const std::string& name, NetcdfType type, std::vector<int> dimensions,
                          const std::string& long_name) {
    return file.variable(name, type, dimensions,
                         {{"units", std::string("1")}, {"long_name", long_name}});
  };
  const int cull = define("cullCell", NetcdfType::int32, {cells}, "1 for cells that are culled"),
            masks = define("regionCellMasks", NetcdfType::int32, {cells, regions},
                           "1 for cells of land");
  const int ocean = define("oceanCell", NetcdfType::int32, {cells},
                           "0-based id in the mesh of the sea, or -1"),
            land = define("landCell", NetcdfType::int32, {cells},
                          "0-based id in the mesh of all other cells, or -1");
  const int fraction = fractions.size() > 0 ? define("landFraction", NetcdfType::float64, {cells},
                                                     "fraction of each cell that is land")
                                            : -1;
  file.begin();
  const NetcdfWriter::Fill<std::int32_t> flags = [&](std::int64_t begin, std::int64_t end,
                                                     std::int32_t* out) {
    for (std::int64_t i = begin; i < end; ++i)
      *out++ = sea[i] < 0 ? 1 : 0;
  };
  file.put(cull, flags);
  file.put(masks, flags);
  const auto put_ids = [&](int variable, bool of_sea) {
    std::int32_t next = 0;
    Ids ids(sea.size());
    for (Eigen::Index i = 0; i < sea.size(); ++i)
      ids[i] = (sea[i] >= 0) == of_sea ? next++ : -1;
    file.put(variable, NetcdfWriter::Fill<std::int32_t>(
                           [&](std::int64_t begin, std::int64_t end, std::int32_t* out) {
                             std::copy_n(ids.data() + begin, end - begin, out);
                           }));
  };
  put_ids(ocean, true);
  put_ids(land, false);
  if (fraction >= 0)
    file.put(fraction,
             NetcdfWriter::Fill<double>([&](std::int64_t begin, std::int64_t end, double* out) {
               std::copy_n(fractions.data() + begin, end - begin, out);
             }));
}

/// The files beside the grid. They are written and finished at once, and renamed by commit().
class Companions {
public:
  Companions(const CullOptions& options, const Ids& sea, const DoubleVector& fractions,
             const Kept& cells) {
    if (!options.mask_path.empty()) {
      mask_ = std::make_unique<NetcdfWriter>(options.mask_path);
      put_mask(sea, fractions, *mask_);
      mask_->finish();
    }
    if (!options.cell_map_folder.empty())
      maps_.emplace(
          cell_map_paths(options.cell_map_folder),
          Ids(Eigen::Map<const Ids>(cells.number.begin(), cells.number.size()).array() - 1),
          Ids(Eigen::Map<const Ids>(cells.old.begin(), cells.count())));
  }
  void commit() {
    if (mask_)
      mask_->commit();
    if (maps_)
      maps_->commit();
  }

private:
  std::unique_ptr<NetcdfWriter> mask_;
  std::optional<CellMapFiles> maps_;
};

/// Writes a part of the source. \param commit is called when the file is complete, before it
/// appears. \returns the variables that are left out.
std::vector<std::string> write_cells(const MpasSource& source, const MpasPart& part,
                                     const std::string& path, const CullReport& report,
                                     const CullOptions& options,
                                     const std::function<void()>& commit) {
  const ReversedEdges reversed = reversed_edges(source, part);
  NetcdfSubset subset = make_subset(source, part);
  add_reversals(source, part, reversed, subset);
  add_kites(source, part, subset);
  add_maps(part, subset);
  add_radius(source, report.sphere_radius, subset);
  add_vertex_order(source, part, report.vertex_order, subset);
  set_sphere(source, report.sphere_radius, subset);
  subset.dimensions = options.dimensions;
  add_history(source, part, options.history, subset);
  return write_part(source, part, subset, path, options.progress, commit);
}

} // namespace
} // namespace io_detail

CullReport cull(const std::string& source_path, const std::string& target,
                const CullOptions& options) {
  using namespace io_detail;
  require_options(options, target);
  const MpasSource source(source_path);
  const double radius = options.sphere_radius.value_or(source.radius());
  const SourceCells source_cells = read_source_cells(source, options);
  const Land land = find_land(source_path, source_cells, options);
  CullReport report;
  report.land = std::count(land.flags.begin(), land.flags.end(), 1);
  const SeaCells decided =
      sea_cells(source_cells.cells_on_cell, land.flags, sea_options(source, source_cells, options));
  const Ids& sea = decided.mask;
  report.sea = decided.report;
  report.severed = middles(source, report.sea.severed_parts);
  report.stranded_passages = stranded_passages(source_cells, land, sea, options);
  const MpasPart part = select_part(source, sea);
  Companions companions(options, sea, land.fractions, part.cells);
  report.vertex_order = options.vertex_order.value_or(source.vertex_order());
  report.sphere_radius = radius;
  report.cells = part.cells.count();
  report.edges = part.edges.count();
  report.vertices = part.vertices.count();
  const auto write_sea = [&] {
    report.left_out =
        write_cells(source, part, target, report, options, [&] { companions.commit(); });
  };
  if (options.land_path.empty()) {
    write_sea();
    return report;
  }
  report.others = sea.size() - report.cells;
  require(report.others > 0, "all cells are sea; leave the file of the others out");
  write_cells(source, select_part(source, Ids(-1 - sea.array())), options.land_path, report,
              options,
              write_sea); // a failure of either leaves none
  return report;
}

} // namespace calotte
