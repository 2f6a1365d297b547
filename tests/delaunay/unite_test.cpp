// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/unite.h"

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
  ReportMemory own;
  RegionTriangles out{LocalTriples(count, 4, own),
                      LocalTriples(count, count, own),
                      Array<std::int32_t>(4),
                      Array<std::int32_t>(count),
                      {}};
  std::iota(out.site.begin(), out.site.end(), 0);
  const std::array<Triple, 4> neighbours{{{3, 1, 2}, {3, 2, 0}, {3, 0, 1}, {1, 0, 2}}};
  for (std::int32_t t = 0; t < count; ++t) {
    const auto face = static_cast<std::size_t>(t);
    out.vertices.set(t, faces[face]);
    Triple here = neighbours[face];
    for (std::int32_t& across : here)
      across = across < count ? across : -1;
    out.neighbours.set(t, here);
    const std::int32_t home = owner_of(faces[face][0]);
    // By second site: 0 1 2, 0 2 3, 0 3 1, and 1 3 2 alone.
    out.rank[t] = home != region ? -1 : t == 3 ? 0 : t;
    int bits = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t lower = std::min(faces[face][(i + 1) % 3], faces[face][(i + 2) % 3]);
      bits |= static_cast<int>(owner_of(lower) == region) << i;
    }
    out.seams.push_back({faces[face], t, home, 2, static_cast<std::int8_t>(bits)});
  }
  return out;
}

/// \param points points of the mesh; only their number matters.
Mesh united(RegionTriangles first, RegionTriangles second, std::int64_t points = 4) {
  std::vector<RegionTriangles> reports;
  reports.push_back(std::move(first));
  reports.push_back(std::move(second));
  Array<std::int32_t> triangles_of(4);
  for (std::int32_t s = 0; s < 4; ++s)
    triangles_of[s] = s == 0 ? 3 : s == 1 ? 1 : 0;
  Mesh mesh;
  mesh.points.resize(3, points);
  unite(std::move(reports), std::move(triangles_of), mesh);
  return mesh;
}

bool is_internal_error(RegionTriangles first, RegionTriangles second) {
  try {
    united(std::move(first), std::move(second));
  } catch (const Error& e) {
    return e.code() == ErrorCode::internal;
  }
  return false;
}

} // namespace

TEST_CASE("arrays of the reports' memory do not overlap; those that do not fit have their own") {
  ReportMemory memory(1000); // 24 000 bytes
  std::vector<Array<std::int32_t>> arrays;
  for (std::int32_t k = 0; k < 12; ++k) {
    arrays.push_back(memory.array<std::int32_t>(700 - k));
    std::fill(arrays.back().begin(), arrays.back().end(), k);
  }
  for (std::int32_t k = 0; k < 12; ++k) {
    const Array<std::int32_t>& array = arrays[static_cast<std::size_t>(k)];
    CHECK(array.size() == 700 - k);
    CHECK(std::count(array.begin(), array.end(), k) == array.size());
  }
  const Triangles taken = std::move(memory).take();
  const auto inside = [&](const Array<std::int32_t>& array) {
    return array.begin() >= taken.data() && array.end() <= taken.data() + taken.size();
  };
  CHECK(std::count_if(arrays.begin(), arrays.end(), inside) == 8);
}

TEST_CASE("triples of local numbers come back, in 16 bits and in 32") {
  for (const std::int64_t numbers : {4, 65535, 65536, 1 << 30}) {
    CAPTURE(numbers);
    const auto most = static_cast<std::int32_t>(numbers - 1);
    ReportMemory own;
    LocalTriples triples(2, numbers, own);
    triples.set(0, {0, most, -1});
    triples.set(1, {-1, 1, most});
    CHECK(triples.size() == 2);
    CHECK(triples(0, 0) == 0);
    CHECK(triples(0, 1) == most);
    CHECK(triples(0, 2) == -1);
    CHECK(triples(1, 0) == -1);
    CHECK(triples(1, 1) == 1);
    CHECK(triples(1, 2) == most);
  }
}

TEST_CASE("two regions' reports of one tetrahedron unite to its mesh") {
  for (const std::int64_t points :
       {std::int64_t{4}, most_sites_kept + 1}) { // many: memory returns to the system
    Mesh mesh = united(report_of(0), report_of(1), points);
    mesh.points.resize(3, 4);
    mesh.points << 1, -1, -1, 1, 1, 1, -1, -1, 1, -1, 1, -1;
    mesh.site_of_input = {0, 1, 2, 3};
    CHECK(check(mesh).failure == "");
  }
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
