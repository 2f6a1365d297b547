// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/triangulate.h"

#include "delaunay/sphere_chart.h"

#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

using namespace calotte;
using namespace calotte::delaunay_detail;

namespace {

using Cap = delaunay_detail::Triangulation<SphereChart>;
using Triple = std::array<std::int32_t, 3>;

std::vector<Member> all_members(const Sites& sites) {
  std::vector<Member> members(static_cast<std::size_t>(sites.size()));
  for (std::size_t r = 0; r < members.size(); ++r)
    members[r] = {static_cast<std::int32_t>(r), 0};
  return members;
}

/// Finite faces by sites, starting at the lowest; each neighbour is checked to point back.
std::set<Triple> finite_faces(Cap& cap) {
  std::set<Triple> faces;
  cap.for_each_face([&](Cap::Face face) {
    for (int i = 0; i < 3; ++i) {
      const Cap::Face beyond = face->neighbor(i);
      const int back = beyond->index(face);
      CHECK(beyond->vertex((back + 1) % 3) == face->vertex((i + 2) % 3));
      CHECK(beyond->vertex((back + 2) % 3) == face->vertex((i + 1) % 3));
    }
    if (Cap::is_infinite(face))
      return;
    Triple t{face->vertex(0)->point.site, face->vertex(1)->point.site, face->vertex(2)->point.site};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    CHECK(faces.insert(t).second);
  });
  return faces;
}

std::set<Triple> faces_in_order(const SphereChart& view, const std::vector<Member>& members) {
  Cap cap{view};
  REQUIRE(cap.build(members));
  CHECK(cap.members().size() == members.size());
  return finite_faces(cap);
}

} // namespace

TEST_CASE("any order of insertion gives the same faces, from the centre and from a focus") {
  const std::array<Points3, 5> sets{random_sphere(500, 3), lat_lon_sphere(9, 18, true),
                                    cubed_sphere(8), bisected_icosahedron(2), spiral_sphere(60)};
  std::mt19937_64 random(1);
  for (const Points3& points : sets) {
    const Sites sites = make_sites(points, Duplicates::merge, 0);
    const Vec3 centre = normalised({0.3, -0.2, 0.9});
    for (const SphereChart& view : {SphereChart(sites), SphereChart(sites, centre, 2)}) {
      std::vector<Member> members = all_members(sites);
      const std::set<Triple> expected = faces_in_order(view, members);
      if (view.view().from_centre)
        CHECK(std::ssize(expected) == 2 * sites.size() - 4);
      std::reverse(members.begin(), members.end());
      CHECK(faces_in_order(view, members) == expected);
      for (int shuffle = 0; shuffle < 5; ++shuffle) {
        std::shuffle(members.begin(), members.end(), random);
        CHECK(faces_in_order(view, members) == expected);
      }
    }
  }
}

TEST_CASE("a site inserted later is in the triangulation as if it had been there from the start") {
  const Sites sites = make_sites(cubed_sphere(6), Duplicates::merge, 0);
  const std::vector<Member> members = all_members(sites);
  const SphereChart view(sites);
  Cap cap{view};
  REQUIRE(cap.build(std::span(members).first(members.size() / 2)));
  for (std::size_t m = members.size() / 2; m < members.size(); ++m)
    cap.insert(members[m]);
  CHECK(finite_faces(cap) == faces_in_order(view, members));
}

TEST_CASE("sites on one line of the view cannot be triangulated") {
  Points3 circle(3, 40);
  for (int i = 0; i < 20; ++i) { // Pythagorean: exactly on the equator, with all antipodes
    const double m = i + 1;
    circle.col(2 * i) << m * m - 4, 4 * m, 0;
    circle.col(2 * i + 1) = -circle.col(2 * i);
  }
  const Sites sites = make_sites(circle, Duplicates::merge, 0);
  Cap cap{SphereChart(sites)};
  CHECK(!cap.build(all_members(sites)));
  Cap from_focus{SphereChart(sites, {1, 0, 0}, 2)}; // on the equator: a line of that view too
  std::vector<Member> members = all_members(sites);
  std::erase_if(members, [&](const Member& m) { return !from_focus.chart().has_point(m.rank); });
  CHECK(!from_focus.build(members));
}
