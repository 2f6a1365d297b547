// SPDX-License-Identifier: GPL-3.0-or-later
#include "density/width_table.h"

#include <calotte/cell_width.h>
#include <calotte/generators.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

using namespace calotte;

namespace {

/// Random widths on a regular grid from a first longitude and latitude on.
CellWidth regular(double west, double south, double step) {
  CellWidth width;
  const auto columns = static_cast<Eigen::Index>(std::lround(360 / step)),
             rows = static_cast<Eigen::Index>(std::floor(-2 * south / step + 1e-9)) + 1;
  width.longitudes.resize(columns);
  for (Eigen::Index i = 0; i < columns; ++i)
    width.longitudes[i] = west + static_cast<double>(i) * step;
  width.latitudes.resize(rows);
  for (Eigen::Index j = 0; j < rows; ++j)
    width.latitudes[j] = south + static_cast<double>(j) * step;
  width.widths = (Eigen::MatrixXd::Random(columns, rows).array() + 1.3) * 50;
  return width;
}

/// The same field with one more longitude and latitude, which make the grid irregular.
CellWidth irregular(const CellWidth& width) {
  const Eigen::Index columns = width.longitudes.size(), rows = width.latitudes.size();
  CellWidth out;
  out.longitudes.resize(columns + 1);
  out.longitudes << width.longitudes[0], 0.7 * width.longitudes[0] + 0.3 * width.longitudes[1],
      width.longitudes.tail(columns - 1);
  out.latitudes.resize(rows + 1);
  out.latitudes << width.latitudes[0], 0.6 * width.latitudes[0] + 0.4 * width.latitudes[1],
      width.latitudes.tail(rows - 1);
  Eigen::MatrixXd wider(columns + 1, rows);
  wider << width.widths.row(0), 0.7 * width.widths.row(0) + 0.3 * width.widths.row(1),
      width.widths.bottomRows(columns - 1);
  out.widths.resize(columns + 1, rows + 1);
  out.widths << wider.col(0), 0.6 * wider.col(0) + 0.4 * wider.col(1), wider.rightCols(rows - 1);
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
      const CellWidth grid = regular(west, south, south == -89.5 ? 1.0 : 2.0);
      CellWidth other = irregular(grid);
      // A pole's width is the mean of a row, to which a further node would add.
      if (south > -90) {
        const Eigen::VectorXd longitudes = other.longitudes;
        other.longitudes = grid.longitudes;
        Eigen::MatrixXd without(grid.longitudes.size(), other.widths.cols());
        without << other.widths.row(0), other.widths.bottomRows(grid.longitudes.size() - 1);
        other.widths = without;
      } else {
        other.widths.col(0).setConstant(grid.widths.col(0).mean());
        other.widths.col(other.widths.cols() - 1)
            .setConstant(grid.widths.col(grid.widths.cols() - 1).mean());
        other.widths.col(1) = 0.6 * other.widths.col(0) + 0.4 * other.widths.col(2);
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
  const CellWidth grid = regular(-180, -90, 1);
  const Points3 points = random_sphere(1000, 3);
  const Eigen::VectorXd all = evaluate(grid, points);
  for (const Eigen::Index i : {0, 1, 7, 127, 128, 500, 999})
    CHECK(evaluate(grid, Points3(points.col(i)))[0] == all[i]);
}
