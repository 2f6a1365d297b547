// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/mesh.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef CALOTTE_BENCH_STRIPACK
// SUBROUTINE CSTRMESH (N, X,Y,Z, LIST,LPTR,LEND,LNEW, NEAR,NEXT,DIST, IER): default integers,
// doubles. LIST and LPTR hold 6n - 12 entries, the others n.
// NOLINTNEXTLINE(readability-identifier-naming): Fortran names it.
extern "C" void cstrmesh_(const int* n, const double* x, const double* y, const double* z,
                          int* list, int* lptr, int* lend, int* lnew, int* near, int* next,
                          double* dist, int* ier);
#endif

namespace calotte::bench {

/// True if this program was built with STRIPACK.
#ifdef CALOTTE_BENCH_STRIPACK
constexpr bool has_stripack = true;
#else
constexpr bool has_stripack = false;
#endif

/// STRIPACK's TRMESH in double precision (Renka, ACM TOMS 23(3), 1997, Algorithm 772) as NCAR ships
/// it, with its arrays, which the constructor allocates and touches.
///
/// Node k's neighbours, counter-clockwise, are the cycle of `lptr` that ends at lend[k]; ids and
/// pointers count from 1.
class Stripack {
public:
  explicit Stripack(std::int64_t n)
      : x_(count(n)), y_(x_), z_(x_), distance_(x_), list_(6 * count(n)), lptr_(list_),
        lend_(count(n)), near_(lend_), next_(lend_) {}

  /// Takes n unit columns.
  void set_nodes(const Points3& points) {
    x_.assign(points.row(0).begin(), points.row(0).end());
    y_.assign(points.row(1).begin(), points.row(1).end());
    z_.assign(points.row(2).begin(), points.row(2).end());
  }

  /// \throws std::runtime_error if TRMESH fails. \pre has_stripack.
  void triangulate() {
    int error = -1;
#ifdef CALOTTE_BENCH_STRIPACK
    const int nodes = static_cast<int>(x_.size());
    int lnew = 0;
    cstrmesh_(&nodes, x_.data(), y_.data(), z_.data(), list_.data(), lptr_.data(), lend_.data(),
              &lnew, near_.data(), next_.data(), distance_.data(), &error);
#endif
    if (error != 0)
      throw std::runtime_error("TRMESH gave up with IER = " + std::to_string(error));
  }

  /// Calls body(a, b, c) for each triangle, in ids from 0: counter-clockwise, from its lowest node
  /// on, in ascending order of that one.
  template <class Body> void for_each_triangle(const Body& body) const {
    for (int a = 1; a <= static_cast<int>(lend_.size()); ++a) {
      const int last = at(lend_, a);
      int pointer = last;
      do {
        const int following = at(lptr_, pointer);
        const int b = std::abs(at(list_, pointer)), c = std::abs(at(list_, following));
        // A negative last neighbour means that no triangle lies between it and the first.
        if (a < b && a < c && at(list_, pointer) > 0)
          body(a - 1, b - 1, c - 1);
        pointer = following;
      } while (pointer != last);
    }
  }

private:
  static std::size_t count(std::int64_t n) { return static_cast<std::size_t>(n); }

  static int at(const std::vector<int>& values, int i) {
    return values[static_cast<std::size_t>(i - 1)];
  }

  std::vector<double> x_, y_, z_, distance_;
  std::vector<int> list_, lptr_, lend_, near_, next_;
};

} // namespace calotte::bench
