// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "delaunay/delaunay.h"
#include "support/clouds.h"
#include "support/oracle.h"

#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/mesh.h>

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

/// Meshes for the tests of files.
namespace calotte::test {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// Meshes of sites in general position and on lattices, whose cells have edges of length 0; of four
/// sites; with vertices, edges and sites at the poles and on the meridian of 180 degrees.
inline std::vector<NamedMesh> closed_meshes() {
  const Points3 axes = octahedron();
  Points3 bridge(3, 7);                // an edge of cells runs over the north pole
  bridge << 0.3, -0.3, 0, 0, 1, -1, 0, //
      0, 0, 1, -1, 0, 0, 0,            //
      1, 1, 0.2, 0.2, -0.2, -0.2, -1;
  return {{"random", delaunay(random_sphere(150, 1))},
          {"of many norms", delaunay(with_norms(random_sphere(60, 2), 150, 3))},
          {"lat-lon with poles", delaunay(lat_lon_sphere(5, 8, true))},
          {"lat-lon", delaunay(lat_lon_sphere(4, 6))},
          {"cubed sphere", delaunay(cubed_sphere(3))},
          {"cube", delaunay(signs_of({1, 1, 1}))},
          {"octahedron with zeros of both signs", delaunay(-axes)},
          {"tetrahedron", delaunay(columns({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}))},
          {"four sites, one far",
           delaunay(columns({{0, 0, 1}, {1, 0, -0.1}, {-1, 1, 0}, {-1, -2, 0}}))},
          {"bridge over a pole", delaunay(bridge)}};
}

inline std::vector<NamedMesh> open_meshes() {
  return {{"half", delaunay(upper_half(120, 4))},
          {"octant", delaunay(columns({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}))}};
}

inline std::vector<NamedMesh> all_meshes() {
  std::vector<NamedMesh> all = closed_meshes();
  for (NamedMesh& mesh : open_meshes())
    all.push_back(std::move(mesh));
  return all;
}

/// all_meshes(), and one of the plane and one of a periodic box.
inline std::vector<NamedMesh> meshes_of_all_surfaces() {
  std::vector<NamedMesh> all = all_meshes();
  all.push_back(
      {"plane", delaunay(random_points(200, rectangle({0, 0}, {2, 1}), {}, 5), Surface::plane())});
  const Surface box = Surface::periodic({2, 1});
  all.push_back({"box", delaunay(random_points(300, box, {}, 6), box)});
  return all;
}

/// closed_meshes(), and those with spacings that differ and with a cell of more corners than a byte
/// counts.
inline std::vector<NamedMesh> uneven_meshes() {
  std::vector<NamedMesh> all = closed_meshes();
  all.push_back({"8:1", delaunay(eight_to_one(200, 5))});
  all.push_back({"many meridians", delaunay(lat_lon_sphere(4, 140, true))});
  return all;
}

template <class A, class B> bool equal_bits(const A& a, const B& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         (a.size() == 0 ||
          std::memcmp(a.data(), b.data(), sizeof(*a.data()) * std::size_t(a.size())) == 0);
}

inline void check_equal(const Mesh& a, const Mesh& b) {
  CHECK(equal_bits(a.points, b.points));
  CHECK(equal_bits(a.triangles, b.triangles));
  CHECK(equal_bits(a.neighbours, b.neighbours));
  CHECK(a.site_of_input == b.site_of_input);
}

} // namespace calotte::test
