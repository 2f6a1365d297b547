// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a request of recipes_test.py with the library. Usage: recipe_caller_cpp REQUEST OUTPUT. The
// output holds the cells' generators, 3 doubles each, in a plane with z = 0.
#include "grids/requests.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/grid.h>

#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

namespace {

using namespace calotte;

Density density() {
  Density density;
  density.kind = Density::Kind::callable;
  density.callable = [](const Eigen::Ref<const Points3>& x, Eigen::Ref<Eigen::VectorXd> rho) {
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      rho[i] = request_density(x(2, i));
  };
  return density;
}

Surface inside(const double (&ring)[3 * ring_corners]) {
  return Surface::sphere().within({Eigen::Map<const Points3>(ring, 3, ring_corners)});
}

template <int Columns, int Rows>
Raster widths(const double (&longitudes)[Columns], const double (&latitudes)[Rows],
              const double (&km)[Columns * Rows]) {
  return {Eigen::Map<const Eigen::VectorXd>(longitudes, Columns),
          Eigen::Map<const Eigen::VectorXd>(latitudes, Rows),
          Eigen::Map<const Eigen::MatrixXd>(km, Columns, Rows)};
}

Points3 start_points() {
  Points3 points(3, start_count);
  for (int i = 0; i < start_count; ++i)
    for (int k = 0; k < 3; ++k)
      points(k, i) = start_coordinate(i, k);
  return points;
}

std::map<std::string, Recipe> requests() {
  const Surface rectangle =
      Surface::plane().within({Eigen::Map<const Points2>(rectangle_ring, 2, 4)});
  const Surface box = Surface::periodic({2, 1});
  return {
      {"uniform", {.cells = 642}},
      {"x8", {.cells = 2562, .resolution = density()}},
      {"widths",
       {.resolution =
            widths<width_columns, width_rows>(width_longitudes, width_latitudes, widths_km)}},
      {"rules",
       {.resolution =
            Widths::minimum({Widths::by_latitude({{{-90, 900}, {0, 700}, {90, 900}}}),
                             Widths::by_distance({from_lonlat(DoubleMatrix{{10, 40}, {-20, 30}})},
                                                 {{{0, 300}, {4000, 900}}})})
                .limit_gradient(0.1)}},
      {"region", {.cells = 500, .surface = inside(region_ring)}},
      {"limited-area",
       {.resolution = widths<2, 2>(uniform_longitudes, uniform_latitudes, uniform_km),
        .surface = inside(small_ring),
        .limited_area = true}},
      {"plane", {.cells = 300, .surface = rectangle}},
      {"box", {.cells = 400, .surface = box}},
      {"walls", {.cells = 300, .surface = box, .walls = {.y = true}}},
      {"fixed",
       {.cells = 500, .fixed = Eigen::Map<const Points3>(fixed_directions, 3, fixed_count)}},
      {"points", {.start = {.points = start_points()}}},
      {"pure",
       {.cells = 642, .resolution = density(), .stop = {.tolerance = 1e-3, .well_centred = false}}},
      {"well-centred", {.cells = 642, .stop = {.well_centred = true}}},
      {"lloyd",
       {.cells = 642,
        .resolution = density(),
        .stop = {.iterations = 20},
        .method = Method::lloyd}},
  };
}

void write_points(const std::string& path, const Points3& points) {
  std::ofstream file(path, std::ios::binary);
  file.write(
      reinterpret_cast<const char*>(points.data()),
      static_cast<std::streamsize>(sizeof(double) * static_cast<std::size_t>(points.size())));
  if (!file.flush())
    throw std::runtime_error(path + ": cannot be written");
}

} // namespace

int main(int argc, char** argv) {
  const auto known = requests();
  if (argc != 3 || !known.contains(argv[1])) {
    std::cerr << "usage: recipe_caller_cpp REQUEST OUTPUT\n";
    return 2;
  }
  try {
    write_points(argv[2], make_grid(known.at(argv[1])).mesh.points);
    return 0;
  } catch (const std::exception& failure) {
    std::cerr << "recipe_caller_cpp: " << failure.what() << '\n';
    return 1;
  }
}
