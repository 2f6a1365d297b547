// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/mesh.h>

#include "base/parallel.h"
#include "base/require.h"
#include "mesh/faces.h"
#include "mesh/ids.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace calotte {

IdLists neighbours(const Mesh& mesh) {
  using namespace mesh_detail;
  require_triangles(mesh);
  const Faces faces = faces_of(mesh);
  const auto is_first_of_fan = [&](std::int64_t t, int v) {
    return faces.neighbour(t, previous_vertex(v)) < 0;
  };
  const auto for_each_corner = [&](const auto& body) {
    for (std::int32_t t = 0; t < faces.triangles(); ++t)
      for (int v = 0; v < 3; ++v)
        body(t, v);
  };
  IdLists out;
  out.begin.setZero(faces.sites() + 1);
  for_each_corner([&](std::int32_t t, int v) {
    out.begin[faces.vertex(t, v)] += is_first_of_fan(t, v) ? 2 : 1;
  });
  const auto lists = static_cast<std::size_t>(out.begin.size());
  out.items.resize(exclusive_scan(std::span(out.begin.data(), lists)));
  std::vector<std::int64_t> ends(out.begin.begin(), out.begin.end());
  std::vector<std::uint8_t> met(static_cast<std::size_t>(3 * faces.triangles()), 0);
  const auto walk_from = [&](Corner first) {
    std::int64_t& end = ends[static_cast<std::size_t>(site_at(faces, first))];
    std::int32_t* const list = out.items.data() + end;
    const auto next = [&](Corner corner) { return fitting_next(faces, corner); };
    const Corner last = walk_around(first, next, [&](Corner corner) {
      met[static_cast<std::size_t>(3 * std::int64_t{corner.triangle} + corner.vertex)] = 1;
      out.items[end++] = following_site(faces, corner);
    });
    if (!exists(last)) {
      std::rotate(list, std::min_element(list, out.items.data() + end), out.items.data() + end);
      return;
    }
    if (faces.neighbour(last.triangle, next_vertex(last.vertex)) >= 0)
      refuse_at(last.triangle,
                "triangle {} has a neighbour that does not fit it: triangulate the points anew");
    out.items[end++] = preceding_site(faces, last);
  };
  for_each_corner([&](std::int32_t t, int v) {
    if (is_first_of_fan(t, v))
      walk_from({t, v});
  });
  for_each_corner([&](std::int32_t t, int v) {
    if (met[static_cast<std::size_t>(3 * std::int64_t{t} + v)] == 0)
      walk_from({t, v});
  });
  return out;
}

} // namespace calotte
