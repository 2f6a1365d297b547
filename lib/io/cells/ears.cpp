// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/cells/field_order.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using Flags = std::vector<std::uint8_t>;

int kept_neighbours(const Mesh& mesh, const Flags& kept, std::int32_t triangle) {
  int count = 0;
  for (const std::int32_t other : mesh.neighbours.col(triangle))
    count += other >= 0 && kept[static_cast<std::size_t>(other)] != 0 ? 1 : 0;
  return count;
}

/// By triangle: whether it stays. A triangle that goes may make ears of its neighbours.
Flags triangles_without_ears(const Mesh& mesh) {
  Flags kept(static_cast<std::size_t>(mesh.triangles.cols()), 1);
  std::vector<std::int32_t> suspects(kept.size());
  std::iota(suspects.begin(), suspects.end(), 0);
  while (!suspects.empty()) {
    const std::int32_t t = suspects.back();
    suspects.pop_back();
    if (kept[static_cast<std::size_t>(t)] == 0 || kept_neighbours(mesh, kept, t) >= 2)
      continue;
    kept[static_cast<std::size_t>(t)] = 0;
    for (const std::int32_t other : mesh.neighbours.col(t))
      if (other >= 0)
        suspects.push_back(other);
  }
  return kept;
}

/// By site: whether a triangle that stays has it.
Flags sites_of(const Mesh& mesh, const Flags& triangles) {
  Flags kept(static_cast<std::size_t>(mesh.points.cols()), 0);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (const std::int32_t site : mesh.triangles.col(t))
      kept[static_cast<std::size_t>(site)] |= triangles[static_cast<std::size_t>(t)];
  return kept;
}

/// What stays, in its order.
struct Selection {
  std::vector<std::int32_t> old; ///< by new id
  std::vector<std::int32_t> now; ///< by old id; -1 for what goes

  explicit Selection(const Flags& kept) : now(kept.size(), -1) {
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i] != 0) {
        now[i] = static_cast<std::int32_t>(old.size());
        old.push_back(static_cast<std::int32_t>(i));
      }
  }
  std::int64_t removed() const { return std::ssize(now) - std::ssize(old); }
};

/// The columns of ids that stay, with new ids; -1 stays.
Triangles selected(const Triangles& ids, const Selection& columns, const Selection& values) {
  Triangles out(3, std::ssize(columns.old));
  for (Eigen::Index t = 0; t < out.cols(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t id = ids(i, columns.old[static_cast<std::size_t>(t)]);
      out(i, t) = id < 0 ? -1 : values.now[static_cast<std::size_t>(id)];
    }
  return out;
}

Mesh selected(const Mesh& mesh, const Selection& sites, const Selection& triangles) {
  Mesh out{Points3(3, std::ssize(sites.old)), selected(mesh.triangles, triangles, sites),
           selected(mesh.neighbours, triangles, triangles),
           std::vector<std::int32_t>(sites.old.size())};
  for (Eigen::Index i = 0; i < out.points.cols(); ++i)
    out.points.col(i) = mesh.points.col(sites.old[static_cast<std::size_t>(i)]);
  std::iota(out.site_of_input.begin(), out.site_of_input.end(), 0);
  return out;
}

void select_fields(const Mesh& mesh, const Selection& sites, const Selection& triangles,
                   std::vector<MeshField>& fields) {
  std::erase_if(fields, [&](const MeshField& field) {
    return field.location == Location::edges ||
           !io_detail::has_values_for(field, field.location == Location::cells
                                                 ? mesh.points.cols()
                                                 : mesh.triangles.cols());
  });
  for (MeshField& field : fields)
    io_detail::select_values(field, field.location == Location::cells ? sites.old : triangles.old);
}

} // namespace

WithoutEars without_ears(MeshFile given) {
  WithoutEars result{std::move(given), {}};
  MeshFile& file = result.file;
  if (!file.mesh)
    throw Error(ErrorCode::invalid_argument,
                "there is no mesh of the sphere that could have ears; give another file");
  const Flags kept = triangles_without_ears(*file.mesh);
  const Selection triangles(kept), sites(sites_of(*file.mesh, kept));
  result.removed = {triangles.removed(), sites.removed()};
  if (triangles.old.empty())
    throw Error(ErrorCode::invalid_argument,
                "no triangle has two neighbours that have two neighbours in "
                "turn; give a mesh of finer cells");
  if (result.removed.triangles == 0 && result.removed.sites == 0)
    return result;
  const Mesh before = std::move(*file.mesh);
  file.mesh = selected(before, sites, triangles);
  file.polygons.reset();
  select_fields(before, sites, triangles, file.fields);
  if (file.density.size() == before.points.cols()) {
    const DoubleVector all = std::move(file.density);
    file.density.resize(std::ssize(sites.old));
    for (Eigen::Index i = 0; i < file.density.size(); ++i)
      file.density[i] = all[sites.old[static_cast<std::size_t>(i)]];
  }
  return result;
}

} // namespace calotte
