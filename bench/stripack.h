// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace calotte::bench {

/// STRIPACK's TRMESH in double precision (Renka, ACM TOMS 23(3), 1997, Algorithm 772) as NCAR ships
/// it, with its arrays. These are allocated and touched by the constructor, and used anew by every
/// triangulation.
///
/// Node k's neighbours, counter-clockwise, are the cycle of `lptr` that ends at lend[k]; ids and
/// pointers count from 1.
struct Stripack {
  explicit Stripack(std::int64_t n);

  std::vector<double> x, y, z; ///< unit nodes: to be filled by the caller
  std::vector<int> list, lptr, lend;
  std::vector<int> near, next; ///< the algorithm's own, as `distance` is
  std::vector<double> distance;

  /// Triangulates the nodes; TRMESH's IER, 0 when all went well. \pre has_stripack().
  int triangulate();

  /// Calls body(a, b, c) for each triangle, in ids from 0: counter-clockwise, from its lowest node
  /// on, in ascending order of that one.
  template <class Body> void for_each_triangle(const Body& body) const {
    for (int a = 1; a <= static_cast<int>(lend.size()); ++a) {
      const int last = at(lend, a);
      int pointer = last;
      do {
        const int following = at(lptr, pointer);
        const int b = std::abs(at(list, pointer)), c = std::abs(at(list, following));
        // A negative last neighbour means that no triangle lies between it and the first.
        if (a < b && a < c && at(list, pointer) > 0)
          body(a - 1, b - 1, c - 1);
        pointer = following;
      } while (pointer != last);
    }
  }

private:
  static int at(const std::vector<int>& values, int i) {
    return values[static_cast<std::size_t>(i - 1)];
  }
};

/// True if this program was built with STRIPACK.
bool has_stripack();

} // namespace calotte::bench
