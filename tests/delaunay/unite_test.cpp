// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/unite.h"
#include "support/errors.h"

#include <calotte/check.h>
#include <calotte/error.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

using namespace calotte;
using namespace calotte::delaunay_detail;

namespace {

const std::array<Triple, 4> faces{{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};

/// Sites 0 and 2 belong to the first region, 1 and 3 to the second.
std::int32_t owner_of(std::int32_t site) { return site % 2; }

/// The first faces of a tetrahedron in the report of one of two regions. All are seam triangles of
/// both regions; three have their lowest site in the first region, one in the second.
RegionTriangles report_of(std::int32_t region, std::int32_t count = 4) {
  // Those whose lowest site the region owns first, by second site.
  std::vector<std::int32_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  const auto home = [](std::int32_t face) {
    return owner_of(faces[static_cast<std::size_t>(face)][0]);
  };
  const auto others = std::stable_partition(
      order.begin(), order.end(), [&](std::int32_t face) { return home(face) == region; });
  std::vector<std::int32_t> number(4, -1);
  for (std::int32_t t = 0; t < count; ++t)
    number[static_cast<std::size_t>(order[static_cast<std::size_t>(t)])] = t;
  RegionTriangles out{Array<Triple>(count), Array<Triple>(count), others - order.begin(), {}};
  const std::array<Triple, 4> neighbours{{{3, 1, 2}, {3, 2, 0}, {3, 0, 1}, {1, 0, 2}}};
  for (std::int32_t t = 0; t < count; ++t) {
    const auto face = static_cast<std::size_t>(order[static_cast<std::size_t>(t)]);
    out.sites[t] = faces[face];
    int bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      out.neighbours[t][i] = number[static_cast<std::size_t>(neighbours[face][i])];
      const std::int32_t lower = std::min(faces[face][(i + 1) % 3], faces[face][(i + 2) % 3]);
      bits |= static_cast<int>(owner_of(lower) == region) << i;
    }
    out.seams.push_back(
        {faces[face], t, home(static_cast<std::int32_t>(face)), 2, static_cast<std::int8_t>(bits)});
  }
  return out;
}

Mesh united(RegionTriangles first, RegionTriangles second) {
  std::vector<RegionTriangles> reports;
  reports.push_back(std::move(first));
  reports.push_back(std::move(second));
  Array<std::int32_t> triangles_of(4);
  for (std::int32_t s = 0; s < 4; ++s)
    triangles_of[s] = s == 0 ? 3 : s == 1 ? 1 : 0;
  Mesh mesh;
  unite(std::move(reports), std::move(triangles_of), mesh);
  return mesh;
}

bool is_internal_error(RegionTriangles first, RegionTriangles second) {
  return test::code_of([&] { united(std::move(first), std::move(second)); }) == ErrorCode::internal;
}

} // namespace

TEST_CASE("two regions' reports of one tetrahedron unite to its mesh") {
  Mesh mesh = united(report_of(0), report_of(1));
  mesh.points.resize(3, 4);
  mesh.points << 1, -1, -1, 1, 1, 1, -1, -1, 1, -1, 1, -1;
  mesh.site_of_input = {0, 1, 2, 3};
  CHECK(check(mesh).failure == "");
}

TEST_CASE("regions that disagree are an error, never a mesh") {
  CHECK(is_internal_error(report_of(0), report_of(1, 3))); // one report too few: that of its home
  CHECK(is_internal_error(report_of(0, 3), report_of(1))); // that of the other
  RegionTriangles other = report_of(1);
  other.seams[2].sites = {0, 3, 2}; // a triangle that no other region reports
  CHECK(is_internal_error(report_of(0), std::move(other)));
  RegionTriangles sure = report_of(0);
  sure.seams[1].reporters = 3; // claims three owners, of which two report
  CHECK(is_internal_error(std::move(sure), report_of(1)));
  sure = report_of(1);
  sure.seams[1].reporters = 3;
  CHECK(is_internal_error(report_of(0), std::move(sure)));
  std::array<RegionTriangles, 2> both{report_of(0), report_of(1)};
  for (RegionTriangles& report : both)
    report.seams[1].reporters = 3;
  CHECK(is_internal_error(std::move(both[0]), std::move(both[1])));
}
