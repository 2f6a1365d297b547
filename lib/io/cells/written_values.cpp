// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/written_values.h"
#include "io/bytes/file_error.h"

#include "io/cells/field_order.h"
#include "mesh/canonical_order.h"

#include <cmath>
#include <iterator>

namespace calotte::io_detail {
namespace {

void require_size(const std::string& path, const std::string& what, std::int64_t size,
                  std::int64_t expected) {
  if (size != expected)
    refuse_path(path, "{} has {} values; give one for each of {}", what, size, expected);
}

void require_density(const std::string& path, const DoubleVector& density, std::int64_t sites) {
  require_size(path, "the density of the sites", density.size(), sites);
  for (Eigen::Index i = 0; i < density.size(); ++i)
    if (!(density[i] >= 0 && std::isfinite(density[i])))
      refuse_path(path, "the density is {} at site {}; give finite numbers that are not negative",
                  density[i], i);
  if (density.maxCoeff() == 0)
    refuse_path(path, "the density is zero at every site; make it positive somewhere");
}

/// Requires depths that FESOM accepts: it needs three levels, and takes numbers beyond 11 km for
/// ids of an earlier version.
void require_depths(const std::string& path, const WriteOptions& options, std::int64_t sites) {
  constexpr double deepest = 11000; // metres
  const DoubleVector levels = options.depth_levels.cwiseAbs();
  if (options.depth_levels.size() < 3 || options.depth_levels[0] != 0)
    refuse_path(path,
                "the levels of depth are fewer than 3, or do not begin with 0; give such as 0, "
                "10, 30, 100, in metres");
  for (Eigen::Index k = 1; k < levels.size(); ++k)
    if (!(levels[k] > levels[k - 1] && levels[k] <= deepest &&
          std::signbit(options.depth_levels[k]) == std::signbit(options.depth_levels[1])))
      refuse_path(path,
                  "level {} of the depths is {} m; each lies deeper than the one before, and none "
                  "deeper than 11000 m",
                  k, options.depth_levels[k]);
  require_size(path, "the depth of the bottom", options.site_depth.size(), sites);
  for (Eigen::Index i = 0; i < options.site_depth.size(); ++i)
    if (!(std::abs(options.site_depth[i]) <= deepest))
      refuse_path(path, "the bottom is {} m deep at site {}; give metres, at most 11000",
                  options.site_depth[i], i);
}

/// Requires depths of other models.
void require_site_depths(const std::string& path, const DoubleVector& depths, std::int64_t sites) {
  require_size(path, "the depth of the bottom", depths.size(), sites);
  for (Eigen::Index i = 0; i < depths.size(); ++i)
    if (!std::isfinite(depths[i]))
      refuse_path(path, "the depth is {} at site {}; give a number of metres everywhere", depths[i],
                  i);
}

void require_dimensions(const std::string& path, const MeshField& field) {
  for (const FieldDimension& dimension : field.dimensions)
    if (dimension.size < 1)
      refuse_path(path, "the dimension {} of the field {} has the size {}; give one from 1 on",
                  dimension.name, field.name, dimension.size);
  if (field.leading < 0 || field.leading > std::ssize(field.dimensions))
    refuse_path(path,
                "the field {} has {} dimensions, of which {} cannot come before its location's; "
                "correct `leading`",
                field.name, field.dimensions.size(), field.leading);
}

Pairs renamed(Pairs pairs, std::span<const std::int32_t> new_site) {
  for (std::int32_t& site : pairs.reshaped())
    site = new_site[static_cast<std::size_t>(site)];
  return pairs;
}

} // namespace

void require_values(const std::string& path, const MeshSizes& mesh, const WriteOptions& options) {
  if (options.site_density.size() > 0)
    require_density(path, options.site_density, mesh.sites);
  if (options.depth_levels.size() > 0)
    require_depths(path, options, mesh.sites);
  else if (options.site_depth.size() > 0)
    require_site_depths(path, options.site_depth, mesh.sites);
  for (const std::int32_t site : options.open_sites)
    if (site < 0 || site >= mesh.sites)
      refuse_path(path, "{} is none of the {} sites; give open_sites of this mesh", site,
                  mesh.sites);
  for (const MeshField& field : options.fields) {
    require_dimensions(path, field);
    const bool at_edges = field.location == FieldLocation::edges;
    if (at_edges && !mesh.closed)
      refuse_path(path, "the field {} is at edges, which only closed meshes number; leave it out",
                  field.name);
    const std::int64_t count = field.location == FieldLocation::cells ? mesh.sites
                               : at_edges                             ? 3 * mesh.triangles / 2
                                                                      : mesh.triangles;
    require_size(path, "the field " + field.name, field.values.size(), field.count() * count);
  }
}

void renumber_values(const Mesh& mesh, std::span<const std::int32_t> new_site,
                     WriteOptions& options) {
  for (DoubleVector* values : {&options.site_density, &options.site_depth}) {
    const DoubleVector old = *values;
    for (Eigen::Index i = 0; i < old.size(); ++i)
      (*values)[new_site[static_cast<std::size_t>(i)]] = old[i];
  }
  for (std::int32_t& site : options.open_sites)
    site = new_site[static_cast<std::size_t>(site)];
  mesh_detail::CanonicalOrder places;
  EdgeOrder edges;
  for (MeshField& field : options.fields) {
    if (field.location == FieldLocation::vertices && places.index.size() == 0) {
      Triangles renumbered;
      places = mesh_detail::order_triangles(mesh.triangles, new_site, renumbered);
    }
    if (field.location == FieldLocation::edges && edges.index.empty())
      edges = sort_pairs(renamed(list_edges(mesh.triangles), new_site));
    if (field.location == FieldLocation::edges)
      move_edge_values(field, edges);
    else
      move_values(field,
                  field.location == FieldLocation::cells
                      ? new_site
                      : std::span<const std::int32_t>(places.index.begin(), places.index.end()));
  }
}

} // namespace calotte::io_detail
