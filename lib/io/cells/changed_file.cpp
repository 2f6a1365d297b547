// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/lists.h"
#include "base/points.h"
#include "base/require.h"
#include "base/split_mix.h"
#include "exact/space.h"
#include "io/cells/field_order.h"
#include "io/cells/limited_area_masks.h"
#include "io/cells/polygons.h"
#include "mesh/rows.h"
#include "mesh/stars.h"

#include <calotte/error.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/remap.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::column;
using base_detail::require;
using mesh_detail::Corner;

/// The weights that give values at new cells.
struct Sources {
  const ChangedMesh& changed;
  std::vector<std::int32_t> added; ///< new cells
  GridWeights linear, nearest;     ///< weights from old cells to new ones
  GridWeights conservative = {};   ///< the same; only if a field needs it

  const GridWeights& of(Interpolation kind) const {
    return kind == Interpolation::conservative ? conservative
           : kind == Interpolation::nearest    ? nearest
                                               : linear;
  }
};

GridWeights weights_at(const Mesh& old, const Points3& points, Interpolation kind) {
  GridWeights out;
  out.weights = interpolation_weights(old, points, kind);
  out.target_fraction = DoubleVector::Ones(points.cols());
  return out;
}

Sources make_sources(const Mesh& old, const ChangedMesh& changed) {
  std::vector<std::int32_t> added;
  for (std::int32_t i = 0; i < changed.old_of_new.size(); ++i)
    if (changed.old_of_new[i] < 0)
      added.push_back(i);
  const Points3 points = changed.mesh.points(Eigen::all, added);
  return {changed, std::move(added), weights_at(old, points, Interpolation::linear),
          weights_at(old, points, Interpolation::nearest)};
}

/// The old cells whose area new ones may share: removed cells and some rows around them, since
/// cells there may have become smaller.
std::vector<std::int32_t> cells_near(const IdLists& neighbours, const Ids& new_of_old, int rows) {
  std::vector<std::uint8_t> gone(static_cast<std::size_t>(new_of_old.size()));
  std::transform(new_of_old.begin(), new_of_old.end(), gone.begin(),
                 [](std::int32_t id) { return static_cast<std::uint8_t>(id < 0); });
  const std::vector<std::uint8_t> near = mesh_detail::grown(neighbours, std::move(gone), rows);
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (near[i] != 0)
      ids.push_back(static_cast<std::int32_t>(i));
  return ids;
}

/// Only old cells around the patches contribute, in as many rows as cover the new cells.
GridWeights make_conservative_weights(const Mesh& old, const std::optional<Polygons>& old_cells,
                                      const std::optional<Polygons>& new_cells,
                                      const Sources& sources) {
  constexpr double covered = 1 - 1e-9;
  constexpr int first_rows = 4, most_rows = 32;
  GridWeights out;
  out.weights.resize(std::ssize(sources.added), old.points.cols());
  if (sources.added.empty())
    return out;
  const auto cells_of = [](const std::optional<Polygons>& polygons, const Mesh& mesh) {
    return polygons ? *polygons : polygons_of(voronoi(mesh));
  };
  const Polygons before = cells_of(old_cells, old),
                 after = selected(cells_of(new_cells, sources.changed.mesh), sources.added);
  const IdLists around = neighbours(old);
  for (int rows = first_rows; rows <= most_rows; rows *= 2) {
    const std::vector<std::int32_t> near = cells_near(around, sources.changed.new_of_old, rows);
    out = conservative_weights(selected(before, near), after);
    Weights of_all(out.weights.rows(), old.points.cols());
    of_all.reserve(out.weights.nonZeros());
    for (Eigen::Index row = 0; row < out.weights.rows(); ++row) {
      of_all.startVec(row);
      for (Weights::InnerIterator at(out.weights, row); at; ++at)
        of_all.insertBack(row, near[static_cast<std::size_t>(at.col())]) = at.value();
    }
    of_all.finalize();
    out.weights = std::move(of_all);
    if (out.target_fraction.minCoeff() >= covered)
      break;
  }
  return out;
}

/// Transfers a field from old cells to new cells. New cells outside of the triangles of an open
/// mesh get the nearest value.
MeshField carried(const Sources& sources, const MeshField& field, Interpolation kind) {
  const Ids& old_of_new = sources.changed.old_of_new;
  const std::int64_t count = field.count();
  const int* const begin = sources.of(kind).weights.outerIndexPtr();
  const auto has_none = [&](std::size_t k) { return begin[k] == begin[k + 1]; };
  const MeshField weighted = interpolate(sources.of(kind), field);
  std::optional<MeshField> near;
  for (std::size_t k = 0; k < sources.added.size() && !near; ++k)
    if (has_none(k))
      near = interpolate(sources.nearest, field);
  MeshField out = field;
  out.values.resize(old_of_new.size() * count);
  for (Eigen::Index i = 0; i < old_of_new.size(); ++i)
    if (old_of_new[i] >= 0)
      out.values.segment(i * count, count) = field.values.segment(old_of_new[i] * count, count);
  for (std::size_t k = 0; k < sources.added.size(); ++k)
    out.values.segment(sources.added[k] * count, count) =
        (has_none(k) ? *near : weighted)
            .values.segment(static_cast<Eigen::Index>(k) * count, count);
  return out;
}

/// Transfers the density, which becomes larger where cells have become finer. Its -1/4th power,
/// which is proportional to cell widths, is interpolated linearly.
DoubleVector carried_density(const Sources& sources, const DoubleVector& density) {
  constexpr double least = 1e-150;
  const Eigen::Index cells = sources.changed.new_of_old.size();
  const DoubleVector old =
      density.size() == cells ? density : DoubleVector(DoubleVector::Ones(cells));
  const DoubleVector widths =
      carried(sources, {.name = "width", .values = old.array().max(least).pow(-0.25)},
              Interpolation::linear)
          .values;
  DoubleVector out(widths.size());
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const std::int32_t before = sources.changed.old_of_new[i];
    out[i] = before >= 0 ? old[before] : std::pow(widths[i] * sources.changed.width_ratio[i], -4);
  }
  return out / std::max(out.maxCoeff(), least);
}

constexpr const char* map_name = "mapNewToBase";

/// The method by which a field is transferred to new cells.
Interpolation choose_method(const MeshField& field, const FieldMethods& methods) {
  const auto is_in = [&](const std::vector<std::string>& names) {
    return std::ranges::count(names, field.name) > 0;
  };
  return is_in(methods.conservative)               ? Interpolation::conservative
         : field.integer || is_in(methods.nearest) ? Interpolation::nearest
                                                   : Interpolation::linear;
}

void carry_fields(const Sources& sources, const std::vector<MeshField>& fields,
                  const FieldMethods& methods, ChangedFile& out) {
  const std::int64_t cells = sources.changed.new_of_old.size();
  for (const MeshField& field : fields) {
    if (field.name == map_name || is_derived_mask(field.name, fields))
      continue;
    if (field.location != FieldLocation::cells || !has_values_for(field, cells)) {
      out.left_out.push_back(field.name);
      continue;
    }
    const Interpolation kind = choose_method(field, methods);
    if (kind == Interpolation::nearest)
      out.nearest.push_back(field.name);
    out.file.fields.push_back(carried(sources, field, kind));
  }
  out.file.fields.push_back({.name = map_name,
                             .long_name =
                                 "number of the cell in the file that this was made from, 1-based; "
                                 "0 for a new cell",
                             .values = (sources.changed.old_of_new.array() + 1).cast<double>(),
                             .integer = true});
}

// ---- Polygons

/// Finds the common corner of any three old cells.
class OldCorners {
public:
  explicit OldCorners(const Polygons& polygons) {
    const auto cells = base_detail::lists_by_key<std::vector<std::int32_t>>(
        polygons.corners.cols(), [&](const auto& put) {
          for (std::int32_t i = 0; i < polygons.size(); ++i)
            for (const std::int32_t corner : polygons.ids[i])
              put(corner, i); // ascending
        });
    corner_of_.reserve(static_cast<std::size_t>(cells.size()));
    for (std::int64_t corner = 0; corner < cells.size(); ++corner) {
      const auto of = cells[corner];
      for (std::size_t c = 2; c < of.size(); ++c)
        for (std::size_t b = 1; b < c; ++b)
          for (std::size_t a = 0; a < b; ++a)
            corner_of_.emplace(Cells{of[a], of[b], of[c]}, static_cast<std::int32_t>(corner));
    }
  }

  /// -1 if there is none.
  std::int32_t of(std::array<std::int32_t, 3> cells) const {
    std::sort(cells.begin(), cells.end());
    const auto at = corner_of_.find(cells);
    return at == corner_of_.end() ? -1 : at->second;
  }

private:
  using Cells = std::array<std::int32_t, 3>; ///< ascending
  struct Hash {
    std::size_t operator()(const Cells& cells) const {
      std::uint64_t hash = 0;
      for (const std::int32_t cell : cells)
        hash = base_detail::hash_with(hash, static_cast<std::uint64_t>(cell));
      return hash;
    }
  };
  std::unordered_map<Cells, std::int32_t, Hash> corner_of_;
};

template <Space S> Vec3 make_corner(const Mesh& mesh, const S& space, std::int64_t t) {
  return space.circumcentre(column(mesh.points, mesh.triangles(0, t)),
                            column(mesh.points, mesh.triangles(1, t)),
                            column(mesh.points, mesh.triangles(2, t)));
}

/// Cells with the same neighbours as before keep their corners; so do all cells at a boundary. The
/// other cells have a corner for each of their triangles: that of the old triangle if it was kept.
template <Space S>
Polygons changed_polygons(const Polygons& old, const Mesh& old_mesh, const ChangedMesh& changed,
                          const S& space) {
  const Mesh& mesh = changed.mesh;
  const auto old_of = [&](std::int32_t site) { return changed.old_of_new[site]; };
  const OldCorners old_corners(old);
  const mesh_detail::Stars stars(faces_of(mesh));
  const IdLists before = neighbours(old_mesh), now = neighbours(mesh); // from the lowest on
  Polygons out;
  out.surface = old.surface;
  out.centres.resize(3, mesh.points.cols());
  constexpr std::int32_t unknown = -1;
  std::vector<std::int32_t> corner(static_cast<std::size_t>(mesh.triangles.cols()), unknown);
  std::vector<Vec3> added;
  const auto corner_at = [&](std::int32_t t) {
    std::int32_t& here = corner[static_cast<std::size_t>(t)];
    const auto old_id = [&](int i) { return old_of(mesh.triangles(i, t)); };
    const std::array<std::int32_t, 3> cells{old_id(0), old_id(1), old_id(2)};
    if (here == unknown && std::min({cells[0], cells[1], cells[2]}) >= 0)
      here = old_corners.of(cells);
    if (here == unknown) {
      here = static_cast<std::int32_t>(old.corners.cols() + std::ssize(added));
      added.push_back(make_corner(mesh, space, t));
    }
    return here;
  };
  std::vector<std::int32_t> items;
  out.ids.begin = Offsets::Zero(mesh.points.cols() + 1);
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i) {
    const std::int32_t id = old_of(i);
    if (id >= 0)
      out.centres.col(i) = old.centres.col(id);
    else
      base_detail::set_column(out.centres, i,
                              space.coordinates(space.position(column(mesh.points, i))));
    if (id >= 0 && std::ranges::equal(now[i], before[id], {}, old_of))
      items.insert(items.end(), old.ids[id].begin(), old.ids[id].end());
    else if (!stars.for_each_corner(i, [&](Corner at) { items.push_back(corner_at(at.triangle)); }))
      throw Error(ErrorCode::internal, "a cell at the boundary of a mesh changed; please report "
                                       "this input as a bug");
    out.ids.begin[i + 1] = std::ssize(items);
  }
  out.ids.items = Eigen::Map<const Ids>(items.data(), std::ssize(items));
  out.corners.resize(3, old.corners.cols() + std::ssize(added));
  out.corners.leftCols(old.corners.cols()) = old.corners;
  for (std::size_t k = 0; k < added.size(); ++k)
    base_detail::set_column(out.corners, old.corners.cols() + static_cast<Eigen::Index>(k),
                            added[k]);
  return with_used_corners(std::move(out));
}

} // namespace
} // namespace io_detail

void require_fields(const MeshFile& file, const FieldMethods& methods) {
  using base_detail::require;
  for (const std::vector<std::string>* const names : {&methods.nearest, &methods.conservative})
    for (const std::string& name : *names)
      require(std::ranges::any_of(file.fields,
                                  [&](const MeshField& field) {
                                    return field.name == name &&
                                           field.location == FieldLocation::cells;
                                  }),
              "the file has no field \"{}\" at cells; give the name of one", name);
  for (const std::string& name : methods.conservative)
    require(std::ranges::count(methods.nearest, name) == 0,
            "the field \"{}\" is to be both nearest and conservative; give it one of the two",
            name);
}

ChangedFile changed_file(const MeshFile& old, ChangedMesh changed, const FieldMethods& methods) {
  using namespace io_detail;
  require(old.mesh.has_value() && old.mesh->points.cols() == changed.new_of_old.size(),
          "the changed mesh is not that of the file; give what refine() made of it");
  require(!old.polygons || old.polygons->size() == changed.new_of_old.size(),
          "the cells of the file are not those of its mesh; give a file of Voronoi cells");
  require_fields(old, methods);
  ChangedFile out;
  out.file.format = old.format;
  out.file.not_voronoi = old.not_voronoi;
  out.file.sphere_radius = old.sphere_radius;
  out.file.planet_radius = old.planet_radius;
  out.file.vertex_order = old.vertex_order;
  const bool clipped = old.is_clipped(); // the boundary determines the cells
  if (old.polygons && !clipped)
    out.file.polygons =
        exact_detail::in_space_of(old.mesh->surface, [&](const exact_detail::Space auto& space) {
          return changed_polygons(*old.polygons, *old.mesh, changed, space);
        });
  Sources sources = make_sources(*old.mesh, changed);
  if (!methods.conservative.empty())
    sources.conservative = make_conservative_weights(
        *old.mesh, clipped ? std::nullopt : old.polygons, out.file.polygons, sources);
  out.file.density = carried_density(sources, old.density);
  carry_fields(sources, old.fields, methods, out);
  out.file.mesh = std::move(changed.mesh);
  return out;
}

} // namespace calotte
