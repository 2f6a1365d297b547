// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers.h"

#include <array>
#include <cstdio>
#include <stdexcept>
#include <utility>

#ifdef CALOTTE_BENCH_QHULL
extern "C" {
#include <libqhull_r/qhull_ra.h>
}
#endif

namespace calotte::bench {

#ifdef CALOTTE_BENCH_QHULL

namespace {

/// Qhull's memory, freed at the end.
struct Hull {
  Hull() { qh_zero(&qh, stderr); }
  ~Hull() {
    int bytes = 0, blocks = 0;
    qh_freeqhull(&qh, !qh_ALL);
    qh_memfreeshort(&qh, &bytes, &blocks);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  qhT qh{};
};

} // namespace

Outcome run_qhull(const Points3& points) {
  Points3 input = points;
  char options[] = "qhull Qt";
  Hull hull;
  const Stopwatch watch;
  const int error = qh_new_qhull(&hull.qh, 3, static_cast<int>(input.cols()), input.data(), False,
                                 options, nullptr, stderr);
  Outcome outcome{watch.stop(), {}};
  if (error != 0)
    throw std::runtime_error("Qhull gave up with error " + std::to_string(error));
  for (const facetT* facet = hull.qh.facet_list; facet && facet->next; facet = facet->next) {
    std::array<std::int32_t, 3> corner{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[i].p);
      corner[i] = static_cast<std::int32_t>(qh_pointid(&hull.qh, vertex->point));
    }
    if (facet->toporient != qh_ORIENTclock)
      std::swap(corner[1], corner[2]);
    outcome.triangles.add(corner[0], corner[1], corner[2]);
  }
  return outcome;
}

std::string qhull_version() {
  const std::string full = qh_version; // version, date
  return full.substr(0, full.find(' '));
}

#else

Outcome run_qhull(const Points3&) { throw std::logic_error("built without Qhull"); }

std::string qhull_version() { return {}; }

#endif

} // namespace calotte::bench
