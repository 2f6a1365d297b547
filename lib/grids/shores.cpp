// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/ocean.h>

#include <algorithm>
#include <array>
#include <vector>

namespace calotte {

std::vector<Points3> shores(const Coast& coast) {
  using Ends = std::array<double, 6>;
  std::vector<Ends> arcs;
  for (const Points3& ring : coast.rings)
    for (Eigen::Index i = 0; i < ring.cols(); ++i) {
      const auto from = ring.col(i), to = ring.col((i + 1) % ring.cols());
      arcs.push_back({from.x(), from.y(), from.z(), to.x(), to.y(), to.z()});
    }
  std::vector<Ends> sorted = arcs;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Points3> lines;
  for (const Ends& arc : arcs)
    if (!std::binary_search(sorted.begin(), sorted.end(),
                            Ends{arc[3], arc[4], arc[5], arc[0], arc[1], arc[2]}))
      lines.emplace_back(Eigen::Map<const Points3>(arc.data(), 3, 2));
  return lines;
}

} // namespace calotte
