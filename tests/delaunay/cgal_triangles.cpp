// SPDX-License-Identifier: GPL-3.0-or-later
#include "delaunay/cgal_triangles.h"

#include "exact/predicates.h"
#include "support/oracle.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_2.h>
#include <CGAL/Periodic_2_Delaunay_triangulation_traits_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <map>

namespace calotte::test {
namespace {

using Triangle = std::array<std::int32_t, 3>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// `id_of(vertex)` of each face's vertices.
template <class Faces, class IdOf>
std::vector<Triangle> triangles_of(const Faces& faces, const IdOf& id_of) {
  std::vector<Triangle> triangles;
  for (const auto face : faces) {
    Triangle t{id_of(face->vertex(0)), id_of(face->vertex(1)), id_of(face->vertex(2))};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

} // namespace

std::vector<Triangle> cgal_triangles(const Points3& points) {
  using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
  CGAL::Delaunay_triangulation_on_sphere_2<Traits> triangulation(
      Traits(Kernel::Point_3(0, 0, 0), 1));
  std::map<Kernel::Point_3, std::int32_t> ids;
  for (std::int32_t i = 0; i < points.cols(); ++i) {
    const base_detail::Vec3 p = exact_detail::normalised(oracle::site(points, i));
    const Kernel::Point_3 point(p.x, p.y, p.z);
    ids[point] = i;
    triangulation.insert(point);
  }
  std::vector<decltype(triangulation)::Face_handle> faces;
  for (auto face = triangulation.all_faces_begin(); face != triangulation.all_faces_end(); ++face)
    if (!face->is_ghost())
      faces.push_back(face);
  return triangles_of(faces, [&](auto vertex) { return ids.at(vertex->point()); });
}

std::vector<Triangle> cgal_triangles(const Points2& points) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Store = CGAL::Triangulation_data_structure_2<Vertex>;
  CGAL::Delaunay_triangulation_2<Kernel, Store> triangulation;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    triangulation.insert(Kernel::Point_2(points(0, i), points(1, i)))->info() =
        static_cast<std::int32_t>(i);
  return triangles_of(triangulation.finite_face_handles(),
                      [](auto vertex) { return vertex->info(); });
}

std::vector<Triangle> cgal_periodic_triangles(const Points2& points) {
  using Periodic = CGAL::Periodic_2_Delaunay_triangulation_2<
      CGAL::Periodic_2_Delaunay_triangulation_traits_2<Kernel>>;
  std::map<Kernel::Point_2, std::int32_t> ids;
  std::vector<Kernel::Point_2> places;
  for (std::int32_t i = 0; i < points.cols(); ++i) {
    places.emplace_back(points(0, i), points(1, i));
    ids[places.back()] = i;
  }
  const Periodic periodic(places.begin(), places.end(), {0, 0, 1, 1});
  REQUIRE(periodic.is_1_cover());
  std::vector<Periodic::Face_handle> faces;
  for (auto face = periodic.faces_begin(); face != periodic.faces_end(); ++face)
    faces.push_back(face);
  return triangles_of(faces, [&](auto vertex) { return ids.at(vertex->point()); });
}

} // namespace calotte::test
