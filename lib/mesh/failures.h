// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/monitor.h"
#include "base/parallel.h"
#include "mesh/faces.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

/// The names that check() gives to triangles and edges, and the parallel search for the first
/// failure.
namespace calotte::mesh_detail {

inline std::string triangle_name(const Faces& s, std::int64_t t) {
  return message("triangle {} ({}, {}, {})", t, s.vertex(t, 0), s.vertex(t, 1), s.vertex(t, 2));
}

/// The edge across from vertex i of triangle t.
inline std::string edge_name(const Faces& s, std::int64_t t, int i) {
  return message("edge ({}, {}) of {}", s.vertex(t, i + 1), s.vertex(t, i + 2),
                 triangle_name(s, t));
}

/// The first result of law(0), ..., law(n - 1) that is not empty.
/// \param monitor receives one step per block.
template <class Law> std::string first_failure(std::int64_t n, const Law& law, Monitor& monitor) {
  std::vector<std::string> failures(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    std::string& failure = failures[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end && failure.empty(); ++i)
      failure = law(i);
    monitor.step();
  });
  const auto found = std::find_if(failures.begin(), failures.end(),
                                  [](const std::string& failure) { return !failure.empty(); });
  return found != failures.end() ? *found : std::string();
}

/// The same of law(t, 0), law(t, 1) and law(t, 2) for each triangle.
template <class Law>
std::string first_edge_failure(std::int64_t triangles, const Law& law, Monitor& monitor) {
  return first_failure(
      triangles,
      [&](std::int64_t t) {
        std::string failure;
        for (int i = 0; i < 3 && failure.empty(); ++i)
          failure = law(t, i);
        return failure;
      },
      monitor);
}

} // namespace calotte::mesh_detail
