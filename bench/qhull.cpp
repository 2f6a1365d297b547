// SPDX-License-Identifier: GPL-3.0-or-later
#include "peers.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include <vector>

#ifdef CALOTTE_BENCH_QHULL
extern "C" {
#include <libqhull_r/qhull_ra.h>
}
#endif

namespace calotte::bench {

#ifdef CALOTTE_BENCH_QHULL

namespace {

/// A hull, freed at the end.
class Hull {
public:
  explicit Hull(Points3& points) {
    qh_zero(&qh, stderr);
    char options[] = "qhull Qt";
    error = qh_new_qhull(&qh, 3, static_cast<int>(points.cols()), points.data(), False, options,
                         nullptr, stderr);
  }
  ~Hull() {
    int bytes = 0, blocks = 0;
    qh_freeqhull(&qh, !qh_ALL);
    qh_memfreeshort(&qh, &bytes, &blocks);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  /// Calls body(a, b, c) for each triangle, counter-clockwise seen from outside.
  template <class Body> void for_each_triangle(const Body& body) {
    for (const facetT* facet = qh.facet_list; facet && facet->next; facet = facet->next) {
      std::array<std::int32_t, 3> corner{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[i].p);
        corner[i] = static_cast<std::int32_t>(qh_pointid(&qh, vertex->point));
      }
      if (facet->toporient != qh_ORIENTclock)
        std::swap(corner[1], corner[2]);
      body(corner[0], corner[1], corner[2]);
    }
  }

  qhT qh{};
  int error = 0;
};

} // namespace

Outcome run_qhull(const Points3& points) {
  Points3 input = points;
  Outcome outcome;
  const Stopwatch watch;
  Hull hull(input);
  watch.stop(outcome);
  if (hull.error != 0) {
    outcome.failure = "Qhull gave up with error " + std::to_string(hull.error);
    return outcome;
  }
  outcome.sites = hull.qh.num_vertices;
  Digest digest;
  hull.for_each_triangle([&](std::int32_t a, std::int32_t b, std::int32_t c) {
    ++outcome.triangles;
    digest.add(a, b, c);
  });
  outcome.digest = digest.value();
  return outcome;
}

bool has_qhull() { return true; }

std::string qhull_version() {
  const std::string full = qh_version; // version, date
  return full.substr(0, full.find(' '));
}

#else

Outcome run_qhull(const Points3&) { return {}; }

bool has_qhull() { return false; }

std::string qhull_version() { return {}; }

#endif

} // namespace calotte::bench
