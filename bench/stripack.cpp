// SPDX-License-Identifier: GPL-3.0-or-later
#include "stripack.h"

#ifdef CALOTTE_BENCH_STRIPACK
// SUBROUTINE CSTRMESH (N, X,Y,Z, LIST,LPTR,LEND,LNEW, NEAR,NEXT,DIST, IER): default integers,
// doubles. LIST and LPTR hold 6n - 12 entries, the others n.
// NOLINTNEXTLINE(readability-identifier-naming): Fortran names it.
extern "C" void cstrmesh_(const int* n, const double* x, const double* y, const double* z,
                          int* list, int* lptr, int* lend, int* lnew, int* near, int* next,
                          double* dist, int* ier);
#endif

namespace calotte::bench {

namespace {

std::size_t count(std::int64_t n) { return static_cast<std::size_t>(n); }

} // namespace

Stripack::Stripack(std::int64_t n)
    : x(count(n)), y(count(n)), z(count(n)), list(6 * count(n)), lptr(6 * count(n)), lend(count(n)),
      near(count(n)), next(count(n)), distance(count(n)) {}

#ifdef CALOTTE_BENCH_STRIPACK

int Stripack::triangulate() {
  const int nodes = static_cast<int>(x.size());
  int lnew = 0;
  int error = 0;
  cstrmesh_(&nodes, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew,
            near.data(), next.data(), distance.data(), &error);
  return error;
}

bool has_stripack() { return true; }

#else

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): it is no member's elsewhere
int Stripack::triangulate() { return -1; }

bool has_stripack() { return false; }

#endif

} // namespace calotte::bench
