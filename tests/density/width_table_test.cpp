// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_table.h"

#include <calotte/generators.h>
#include <calotte/widths.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

using namespace calotte;

namespace {

/// Random widths on a regular grid from a first longitude and latitude on.
Raster regular(double west, double south, double step) {
  Raster width;
  const auto columns = static_cast<Eigen::Index>(std::lround(360 / step)),
             rows = static_cast<Eigen::Index>(std::floor(-2 * south / step + 1e-9)) + 1;
  width.x.resize(columns);
  for (Eigen::Index i = 0; i < columns; ++i)
    width.x[i] = west + static_cast<double>(i) * step;
  width.y.resize(rows);
  for (Eigen::Index j = 0; j < rows; ++j)
    width.y[j] = south + static_cast<double>(j) * step;
  width.values = (Eigen::MatrixXd::Random(columns, rows).array() + 1.3) * 50;
  return width;
}

/// The same field with one more longitude and latitude, which make the grid irregular.
Raster irregular(const Raster& width) {
  const Eigen::Index columns = width.x.size(), rows = width.y.size();
  Raster out;
  out.x.resize(columns + 1);
  out.x << width.x[0], 0.7 * width.x[0] + 0.3 * width.x[1], width.x.tail(columns - 1);
  out.y.resize(rows + 1);
  out.y << width.y[0], 0.6 * width.y[0] + 0.4 * width.y[1], width.y.tail(rows - 1);
  Eigen::MatrixXd wider(columns + 1, rows);
  wider << width.values.row(0), 0.7 * width.values.row(0) + 0.3 * width.values.row(1),
      width.values.bottomRows(columns - 1);
  out.values.resize(columns + 1, rows + 1);
  out.values << wider.col(0), 0.6 * wider.col(0) + 0.4 * wider.col(1), wider.rightCols(rows - 1);
  return out;
}

/// Poles, axes, the date line, and random places.
Points3 places() {
  Points3 points(3, 6014);
  points.leftCols(14) << 1, -1, 0, 0, 0, 0, -1, -1, 1, 1, 0, 0, 1e-9, -1e-300, //
      0, 0, 1, -1, 0, 0, 1e-12, -1e-12, 1, -1, 1, -1, 0, 0,                    //
      0, 0, 0, 0, 1, -1, 0, 0, 1e-5, -1e-5, 1, -1, -1, 1;
  points.leftCols(14).colwise().normalize();
  points.rightCols(6000) = random_sphere(6000, 5);
  return points;
}

} // namespace

TEST_CASE("width table: a regular grid has the field of the same grid with further nodes") {
  for (const double south : {-90.0, -89.5, -89.0, -78.0})
    for (const double west : {-180.0, 0.0, -179.5, 37.0}) {
      CAPTURE(south);
      CAPTURE(west);
      const Raster grid = regular(west, south, south == -89.5 ? 1.0 : 2.0);
      Raster other = irregular(grid);
      // A pole's width is the mean of a row, to which a further node would add.
      if (south > -90) {
        const Eigen::VectorXd longitudes = other.x;
        other.x = grid.x;
        Eigen::MatrixXd without(grid.x.size(), other.values.cols());
        without << other.values.row(0), other.values.bottomRows(grid.x.size() - 1);
        other.values = without;
      } else {
        other.values.col(0).setConstant(grid.values.col(0).mean());
        other.values.col(other.values.cols() - 1)
            .setConstant(grid.values.col(grid.values.cols() - 1).mean());
        other.values.col(1) = 0.6 * other.values.col(0) + 0.4 * other.values.col(2);
      }
      const Eigen::VectorXd here = evaluate(grid, places()), there = evaluate(other, places());
      CHECK(((here - there).array().abs() < 1e-8).all());
      CHECK(here.minCoeff() > 0);
    }
}

TEST_CASE("width table: grids with other steps have none") {
  std::vector<double> longitudes, latitudes;
  for (int i = 0; i <= 8; ++i)
    longitudes.push_back(-3 + 0.75 * i);
  for (int j = 0; j <= 4; ++j)
    latitudes.push_back(-1.5 + 0.75 * j);
  const std::vector<double> widths(45, 1);
  CHECK(density_detail::WidthTable::make(longitudes, latitudes, widths).has_value());
  longitudes[3] += 0.01;
  CHECK(!density_detail::WidthTable::make(longitudes, latitudes, widths).has_value());
  longitudes[3] -= 0.01;
  latitudes[2] += 0.01;
  CHECK(!density_detail::WidthTable::make(longitudes, latitudes, widths).has_value());
}

TEST_CASE("width table: each value depends on its place alone") {
  const Raster grid = regular(-180, -90, 1);
  const Points3 points = random_sphere(1000, 3);
  const Eigen::VectorXd all = evaluate(grid, points);
  for (const Eigen::Index i : {0, 1, 7, 127, 128, 500, 999})
    CHECK(evaluate(grid, Points3(points.col(i)))[0] == all[i]);
}
