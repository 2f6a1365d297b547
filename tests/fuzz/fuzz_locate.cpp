// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "mutation.h"

#include <calotte/area_weights.h>
#include <calotte/delaunay.h>
#include <calotte/error.h>
#include <calotte/locate.h>
#include <calotte/multimesh.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

using namespace calotte;
using calotte::fuzz::require;

namespace {

template <class Body> void holds(const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
}

/// The nearest sites of positions: of all sites the first ones, whatever the order of the
/// positions.
void search(const Mesh& mesh, const Eigen::MatrixXd& positions) {
  const Locator locator(mesh);
  const std::int64_t n = mesh.points.cols();
  const IdLists all = locator.nearest_few(positions, n);
  const Ids nearest = locator.nearest(positions);
  const Locations found = locator.find(positions);
  require(found.nearest == nearest);
  std::vector<std::int32_t> ids(static_cast<std::size_t>(n));
  std::iota(ids.begin(), ids.end(), 0);
  for (std::int64_t i = 0; i < all.size(); ++i) {
    std::vector<std::int32_t> sorted(all[i].begin(), all[i].end());
    require(sorted.front() == nearest[i]);
    std::ranges::sort(sorted);
    require(sorted == ids);
  }
  const Eigen::MatrixXd turned = positions.rowwise().reverse();
  for (const std::int64_t k : {1, 2, 3, 7}) {
    const IdLists few = locator.nearest_few(turned, k);
    for (std::int64_t i = 0; i < few.size(); ++i)
      require(std::equal(few[i].begin(), few[i].end(), all[all.size() - 1 - i].begin()));
  }
}

void weigh(const Eigen::MatrixXd& points, const Surface& surface,
           const AreaWeightOptions& options) {
  const DoubleVector weights = area_weights(points, surface, options);
  require(weights.size() == points.cols() && weights.allFinite() && weights.minCoeff() >= 0);
  if (surface.is_sphere())
    require(weights.sum() < 4 * std::numbers::pi + 1e-9);
}

void refine(const Eigen::MatrixXd& points) {
  const Multimesh made = multimesh(1, points);
  require(made.points().cols() == 4 * points.cols() - 6);
  require(made.parents.rightCols(made.points().cols() - points.cols()).maxCoeff() < points.cols());
}

} // namespace

/// Searches in meshes, and weights and levels of points.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int kind = bytes.integer(0, 3);
  const int rows = kind < 2 ? 3 : 2;
  const Eigen::MatrixXd points = bytes.columns(rows, 40);
  const Eigen::MatrixXd positions = bytes.columns(rows, 10);
  Eigen::MatrixXd at = Eigen::MatrixXd::Zero(rows, positions.cols() + points.cols());
  at << positions, points;
  if (points.cols() > 3) // positions between points, where sites tie
    at.leftCols(1) = points.leftCols(4).rowwise().sum() / 4;
  holds([&] {
    const Surface surface = kind < 2    ? Surface::sphere()
                            : kind == 2 ? Surface::plane()
                                        : Surface::periodic({1, 1});
    holds([&] { search(delaunay(points, surface), at); });
    for (const AreaWeightOptions& options :
         {AreaWeightOptions{}, AreaWeightOptions{.edge = EdgeCells::hull},
          AreaWeightOptions{.edge = EdgeCells::reach, .reach = 0.3}})
      holds([&] { weigh(points, surface, options); });
    if (kind < 2)
      holds([&] { refine(points); });
  });
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return calotte::fuzz::mutate_points(data, size, most, seed);
}
