// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/points.h"
#include "base/require.h"
#include "base/split_mix.h"
#include "exact/space.h"
#include "io/cells/field_order.h"
#include "mesh/faces.h"
#include "mesh/ring_law.h"

#include <calotte/conservative.h>
#include <calotte/mesh_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

namespace calotte {
namespace io_detail {
namespace {

using base_detail::column;
using base_detail::require;
using mesh_detail::Corner;
using mesh_detail::RingStarts;

/// Where values of new cells come from.
struct Sources {
  const ChangedMesh& changed;
  std::vector<std::int32_t> added; ///< new cells
  GridWeights linear, nearest;     ///< from old cells to these; a row outside of an open mesh is
                                   ///< empty in `linear`

  bool is_outside(std::size_t k) const {
    const int* const begin = linear.weights.outerIndexPtr() + k;
    return begin[0] == begin[1];
  }
};

Sources sources_of(const Mesh& old, const ChangedMesh& changed) {
  Sources out{changed, {}, {}, {}};
  for (std::int32_t i = 0; i < changed.old_of_new.size(); ++i)
    if (changed.old_of_new[i] < 0)
      out.added.push_back(i);
  const Points3 places = changed.mesh.points(Eigen::all, out.added);
  for (GridWeights* const weights : {&out.linear, &out.nearest}) {
    weights->weights = interpolation_weights(
        old, places, weights == &out.linear ? Interpolation::linear : Interpolation::nearest);
    weights->target_fraction = DoubleVector::Ones(places.cols());
  }
  return out;
}

/// A field at old cells as one at new cells.
MeshField carried(const Sources& sources, const MeshField& field, bool nearest) {
  const Ids& old_of_new = sources.changed.old_of_new;
  const std::int64_t count = field.count();
  const MeshField near = interpolate(sources.nearest, field),
                  between = nearest ? near : interpolate(sources.linear, field);
  MeshField out = field;
  out.values.resize(old_of_new.size() * count);
  for (Eigen::Index i = 0; i < old_of_new.size(); ++i)
    if (old_of_new[i] >= 0)
      out.values.segment(i * count, count) = field.values.segment(old_of_new[i] * count, count);
  for (std::size_t k = 0; k < sources.added.size(); ++k)
    out.values.segment(sources.added[k] * count, count) =
        (sources.is_outside(k) ? near : between)
            .values.segment(static_cast<Eigen::Index>(k) * count, count);
  return out;
}

/// Denser where the cells are finer; between old cells its -1/4th power, which widths are
/// proportional to, is linear.
DoubleVector carried_density(const Sources& sources, const DoubleVector& density) {
  constexpr double least = 1e-150;
  const Eigen::Index cells = sources.changed.new_of_old.size();
  const DoubleVector old =
      density.size() == cells ? density : DoubleVector(DoubleVector::Ones(cells));
  const DoubleVector widths =
      carried(sources, {.name = "width", .values = old.array().max(least).pow(-0.25)}, false)
          .values;
  DoubleVector out(widths.size());
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const std::int32_t before = sources.changed.old_of_new[i];
    out[i] = before >= 0 ? old[before] : std::pow(widths[i] * sources.changed.width_ratio[i], -4);
  }
  return out / std::max(out.maxCoeff(), least);
}

constexpr const char* map_name = "mapNewToBase";

void carry_fields(const Sources& sources, const std::vector<MeshField>& fields,
                  const std::vector<std::string>& nearest, ChangedFile& out) {
  const std::int64_t cells = sources.changed.new_of_old.size();
  for (const MeshField& field : fields) {
    if (field.name == map_name)
      continue;
    if (field.location != Location::cells || !has_values_for(field, cells)) {
      out.left_out.push_back(field.name);
      continue;
    }
    const bool as_nearest = field.integer || std::ranges::count(nearest, field.name) > 0;
    if (as_nearest)
      out.nearest.push_back(field.name);
    out.file.fields.push_back(carried(sources, field, as_nearest));
  }
  out.file.fields.push_back({.name = map_name,
                             .long_name = "number of the cell in the file that this was made from",
                             .values = (sources.changed.old_of_new.array() + 1).cast<double>(),
                             .integer = true});
}

void require_names(const MeshFile& old, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    require(std::ranges::any_of(old.fields,
                                [&](const MeshField& field) {
                                  return field.name == name && field.location == Location::cells;
                                }),
            "the file has no field \"" + name + "\" at cells; give the name of one");
}

// ---- Polygons

/// Corners by the old cells, three of each, whose common corners they are.
class OldCorners {
public:
  explicit OldCorners(const Polygons& polygons) {
    std::vector<Cells> cells(static_cast<std::size_t>(polygons.corners.cols()), Cells{-1, -1, -1});
    for (std::int32_t i = 0; i < polygons.size(); ++i)
      for (const std::int32_t corner : polygons.ids[i])
        if (Cells& here = cells[static_cast<std::size_t>(corner)]; here[2] < 0)
          here[here[0] < 0 ? 0 : here[1] < 0 ? 1 : 2] = i;
    corner_of_.reserve(cells.size());
    for (std::size_t corner = 0; corner < cells.size(); ++corner)
      if (cells[corner][2] >= 0)
        corner_of_.emplace(cells[corner], static_cast<std::int32_t>(corner));
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

template <Space S> Vec3 corner_of(const Mesh& mesh, const S& space, std::int64_t t) {
  return space.circumcentre(column(mesh.points, mesh.triangles(0, t)),
                            column(mesh.points, mesh.triangles(1, t)),
                            column(mesh.points, mesh.triangles(2, t)));
}

/// Cells at a boundary keep their corners; the others have one for each of their triangles, that of
/// the old triangle where it stayed.
template <Space S>
Polygons changed_polygons(const Polygons& old, const ChangedMesh& changed, const S& space) {
  const Mesh& mesh = changed.mesh;
  const OldCorners old_corners(old);
  const mesh_detail::Faces faces = faces_of(mesh);
  const RingStarts rings = mesh_detail::make_ring_starts(faces);
  Polygons out;
  out.on_sphere = old.on_sphere;
  out.period = old.period;
  out.centres.resize(3, mesh.points.cols());
  for (Eigen::Index i = 0; i < out.centres.cols(); ++i)
    if (const std::int32_t before = changed.old_of_new[i]; before >= 0)
      out.centres.col(i) = old.centres.col(before);
    else
      base_detail::set_column(out.centres, i,
                              space.coordinates(space.position(column(mesh.points, i))));

  std::vector<std::int32_t> corner(static_cast<std::size_t>(mesh.triangles.cols()));
  std::vector<Vec3> added;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const auto old_id = [&](int i) { return changed.old_of_new[mesh.triangles(i, t)]; };
    const std::array<std::int32_t, 3> cells{old_id(0), old_id(1), old_id(2)};
    std::int32_t& here = corner[static_cast<std::size_t>(t)];
    here = std::min({cells[0], cells[1], cells[2]}) < 0 ? -1 : old_corners.of(cells);
    if (here < 0) {
      here = static_cast<std::int32_t>(old.corners.cols() + std::ssize(added));
      added.push_back(corner_of(mesh, space, t));
    }
  }
  std::vector<std::int32_t> items;
  out.ids.begin = Offsets::Zero(mesh.points.cols() + 1);
  for (std::int32_t i = 0; i < mesh.points.cols(); ++i) {
    std::vector<std::int32_t> around;
    bool closed = false;
    if (const std::int32_t first = rings.first[static_cast<std::size_t>(i)]; first >= 0)
      closed = !exists(mesh_detail::walk_around(
          Corner{first, slot_of(faces, first, i)},
          [&](Corner at) { return next_around(faces, at); },
          [&](Corner at) { around.push_back(corner[static_cast<std::size_t>(at.triangle)]); }));
    if (!closed) {
      const auto kept = old.ids[changed.old_of_new[i]];
      around.assign(kept.begin(), kept.end());
    }
    items.insert(items.end(), around.begin(), around.end());
    out.ids.begin[i + 1] = std::ssize(items);
  }

  // Corners that no cell has any more go.
  std::vector<std::int32_t> number(static_cast<std::size_t>(old.corners.cols()) + added.size(), -1);
  for (const std::int32_t id : items)
    number[static_cast<std::size_t>(id)] = 0;
  std::int32_t count = 0;
  for (std::int32_t& id : number)
    id = id < 0 ? -1 : count++;
  out.corners.resize(3, count);
  for (std::size_t k = 0; k < number.size(); ++k)
    if (number[k] >= 0) {
      const auto index = static_cast<Eigen::Index>(k);
      base_detail::set_column(out.corners, number[k],
                              index < old.corners.cols()
                                  ? column(old.corners, index)
                                  : added[k - static_cast<std::size_t>(old.corners.cols())]);
    }
  out.ids.items.resize(std::ssize(items));
  for (std::size_t k = 0; k < items.size(); ++k)
    out.ids.items[static_cast<Eigen::Index>(k)] = number[static_cast<std::size_t>(items[k])];
  return out;
}

} // namespace
} // namespace io_detail

ChangedFile changed_file(const MeshFile& old, ChangedMesh changed,
                         const std::vector<std::string>& nearest) {
  using namespace io_detail;
  require(old.mesh.has_value() && old.mesh->points.cols() == changed.new_of_old.size(),
          "the changed mesh is not that of the file; give what refine() made of it");
  require(!old.polygons || old.polygons->size() == changed.new_of_old.size(),
          "the cells of the file are not those of its mesh; give a file of Voronoi cells");
  require_names(old, nearest);
  ChangedFile out;
  out.file.format = old.format;
  out.file.not_voronoi = old.not_voronoi;
  out.file.sphere_radius = old.sphere_radius;
  const Sources sources = sources_of(*old.mesh, changed);
  out.file.density = carried_density(sources, old.density);
  carry_fields(sources, old.fields, nearest, out);
  if (old.polygons)
    out.file.polygons =
        exact_detail::in_space_of(old.mesh->surface, [&](const exact_detail::Space auto& space) {
          return changed_polygons(*old.polygons, changed, space);
        });
  out.file.mesh = std::move(changed.mesh);
  return out;
}

} // namespace calotte
