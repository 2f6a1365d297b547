// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace calotte::test {

/// The triangles that keep(t) keeps.
template <class Keep> Mesh part_of(Mesh mesh, const Keep& keep) {
  std::vector<Eigen::Index> kept;
  std::vector<std::int32_t> name(static_cast<std::size_t>(mesh.triangles.cols()), -1);
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    if (keep(t)) {
      name[static_cast<std::size_t>(t)] = static_cast<std::int32_t>(kept.size());
      kept.push_back(t);
    }
  mesh.triangles = Triangles(mesh.triangles(Eigen::all, kept));
  mesh.neighbours = Triangles(mesh.neighbours(Eigen::all, kept)).unaryExpr([&](std::int32_t t) {
    return t < 0 ? t : name[static_cast<std::size_t>(t)];
  });
  return mesh;
}

} // namespace calotte::test
