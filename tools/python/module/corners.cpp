// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "calls.h"
#include "module.h"

#include <calotte/error.h>
#include <calotte/mesh.h>

#include <Eigen/Geometry>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace calotte::python {
namespace {

/// The corners of Voronoi cells and nothing else, for callers that need no edges and areas.
struct Corners {
  Points3 points;  ///< by triangle its circumcentre on the unit sphere
  IdLists ids;     ///< of each cell, counter-clockwise
  double shortest; ///< least length of a Delaunay edge, a chord of the unit sphere
  bool coincide;   ///< corners of cocircular sites: centres within 1e-14
};

/// Triangle by triangle around each site, in the order of the triangles' neighbours.
void walk_rings(const Mesh& mesh, Corners& corners) {
  const std::int64_t n = mesh.points.cols(), m = mesh.triangles.cols();
  corners.ids.begin = Offsets::Zero(n + 1);
  std::vector<std::int32_t> first(static_cast<std::size_t>(n));
  for (std::int64_t t = m; t-- > 0;)
    for (int v = 0; v < 3; ++v) {
      ++corners.ids.begin[mesh.triangles(v, t) + 1];
      first[static_cast<std::size_t>(mesh.triangles(v, t))] = static_cast<std::int32_t>(t);
    }
  for (std::int64_t i = 0; i < n; ++i)
    corners.ids.begin[i + 1] += corners.ids.begin[i];
  corners.ids.items.resize(3 * m);
  for (std::int64_t i = 0; i < n; ++i) {
    std::int32_t t = first[static_cast<std::size_t>(i)];
    for (std::int32_t& id : corners.ids[i]) {
      id = t;
      const auto v = mesh.triangles(0, t) == i ? 0 : mesh.triangles(1, t) == i ? 1 : 2;
      t = mesh.neighbours((v + 1) % 3, t);
    }
  }
}

void set_centres(const Mesh& mesh, Corners& corners) {
  const Points3 sites = mesh.points.colwise().normalized();
  corners.points.resize(3, mesh.triangles.cols());
  double square = 4;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Eigen::Vector3d a = sites.col(mesh.triangles(0, t)),
                          ab = sites.col(mesh.triangles(1, t)) - a,
                          ac = sites.col(mesh.triangles(2, t)) - a;
    corners.points.col(t) = ab.cross(ac).normalized();
    square = std::min({square, ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
  }
  corners.shortest = std::sqrt(square);
  corners.coincide = false;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t)
    for (const std::int32_t u : mesh.neighbours.col(t))
      corners.coincide =
          corners.coincide || (corners.points.col(t) - corners.points.col(u)).squaredNorm() < 1e-28;
}

std::tuple<py::array, py::array, py::array, double, bool> corners_of(const Mesh& mesh) {
  if (!mesh.closed())
    throw Error(ErrorCode::invalid_argument,
                "the points lie within a hemisphere, so that some cells are "
                "unbounded; spread them over the sphere");
  Corners corners = call([&] {
    Corners made;
    tbb::parallel_invoke([&] { walk_rings(mesh, made); }, [&] { set_centres(mesh, made); });
    return made;
  });
  return {handed_over(std::move(corners.points)), handed_over(std::move(corners.ids.begin)),
          handed_over(std::move(corners.ids.items)), corners.shortest, corners.coincide};
}

/// A list of lists: one for each cell. An id that several cells share is one object.
py::list lists_of(const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>& begin,
                  const py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>& ids) {
  const std::int64_t cells = begin.shape(0) - 1;
  std::int64_t most = 0;
  for (py::ssize_t k = 0; k < ids.shape(0); ++k)
    most = std::max(most, ids.data()[k]);
  std::vector<py::int_> numbers;
  numbers.reserve(static_cast<std::size_t>(most + 1));
  for (std::int64_t k = 0; k <= most; ++k)
    numbers.emplace_back(k);
  const bool collects = PyGC_Disable() != 0; // it would look through the new lists again and again
  py::list lists(static_cast<std::size_t>(cells));
  for (std::int64_t i = 0; i < cells; ++i) {
    const std::int64_t first = begin.data()[i], last = begin.data()[i + 1];
    py::list cell(static_cast<std::size_t>(last - first));
    for (std::int64_t k = first; k < last; ++k)
      PyList_SET_ITEM(cell.ptr(), k - first,
                      numbers[static_cast<std::size_t>(ids.data()[k])].inc_ref().ptr());
    PyList_SET_ITEM(lists.ptr(), i, cell.release().ptr());
  }
  if (collects)
    PyGC_Enable();
  return lists;
}

} // namespace

void add_corners(py::module_& module) {
  module.def("corners", &corners_of);
  module.def("lists_of", &lists_of);
}

} // namespace calotte::python
