// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/require.h"
#include "io/cells/field_order.h"
#include "mesh/submesh.h"

#include <calotte/mesh_file.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace calotte {
namespace {

using mesh_detail::Submesh;
using Flags = std::vector<std::uint8_t>;

int kept_neighbours(const Mesh& mesh, const Flags& kept, std::int32_t triangle) {
  int count = 0;
  for (const std::int32_t other : mesh.neighbours.col(triangle))
    count += other >= 0 && kept[static_cast<std::size_t>(other)] != 0 ? 1 : 0;
  return count;
}

/// The triangles that remain. Removing one may turn its neighbours into ears.
std::vector<std::int32_t> triangles_without_ears(const Mesh& mesh) {
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
  std::vector<std::int32_t> stay;
  for (std::int32_t t = 0; t < mesh.triangles.cols(); ++t)
    if (kept[static_cast<std::size_t>(t)] != 0)
      stay.push_back(t);
  return stay;
}

void select_fields(const Mesh& mesh, const Submesh& part, std::vector<MeshField>& fields) {
  std::erase_if(fields, [&](const MeshField& field) {
    return field.location == FieldLocation::edges ||
           !io_detail::has_values_for(field, field.location == FieldLocation::cells
                                                 ? mesh.points.cols()
                                                 : mesh.triangles.cols());
  });
  for (MeshField& field : fields)
    io_detail::select_values(field,
                             field.location == FieldLocation::cells ? part.sites : part.triangles);
}

} // namespace

WithoutEars without_ears(MeshFile given) {
  WithoutEars result{std::move(given), {}};
  MeshFile& file = result.file;
  base_detail::require(file.mesh.has_value(),
                       "there is no mesh of the sphere that could have ears; give another file");
  const Submesh part = mesh_detail::extract(file.mesh->triangles, file.mesh->neighbours,
                                            triangles_without_ears(*file.mesh));
  result.removed = {file.mesh->triangles.cols() - std::ssize(part.triangles),
                    file.mesh->points.cols() - std::ssize(part.sites)};
  base_detail::require(
      !part.triangles.empty(),
      "no triangle has two neighbours that have two neighbours in turn; give a mesh "
      "of finer cells");
  if (result.removed.triangles == 0 && result.removed.sites == 0)
    return result;
  const Mesh before = std::move(*file.mesh);
  file.mesh = as_mesh(part, before);
  file.polygons.reset();
  select_fields(before, part, file.fields);
  if (file.density.size() == before.points.cols())
    file.density = DoubleVector(file.density(part.sites));
  return result;
}

} // namespace calotte
