// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/shapes.h"
#include "options/numbers.h"
#include "text/text.h"
#include "view/view_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

namespace calotte::tools {
namespace {

constexpr std::int64_t worst_kept = 10; ///< of each quantity, as the page lists
constexpr std::int64_t parts = 10;      ///< the cells around a place are one of so many

/// By cell, whether it is one of them.
using Cells = std::vector<bool>;

std::int64_t count(const Cells& cells) { return std::count(cells.begin(), cells.end(), true); }

/// How bad a value is: the larger, the worse.
double badness(const Quantity& quantity, double value) {
  if (!std::isfinite(value))
    return -HUGE_VAL;
  switch (quantity.worst) {
  case Worst::low:
    return -value;
  case Worst::high:
    return value;
  case Worst::far_from_reference:
    return std::abs(value - quantity.reference);
  case Worst::none:
    break; // the page lists the greatest
  }
  return value;
}

/// Adds the cells that are first in an order. \param before a total order of cells.
template <class Before> void add_first(Cells& cells, std::int64_t wanted, const Before& before) {
  std::vector<std::int32_t> all(cells.size());
  std::iota(all.begin(), all.end(), 0);
  const auto end = all.begin() + std::min(wanted, std::ssize(all));
  std::nth_element(all.begin(), end, all.end(), before);
  for (auto cell = all.begin(); cell != end; ++cell)
    cells[static_cast<std::size_t>(*cell)] = true;
}

Cells worst_cells(const ViewMesh& mesh) {
  Cells cells(static_cast<std::size_t>(mesh.cells));
  for (const Quantity& quantity : mesh.quantities)
    if (!quantity.on_triangles && !(quantity.classes && quantity.worst == Worst::none))
      add_first(cells, worst_kept, [&](std::int32_t a, std::int32_t b) {
        const double of_a = badness(quantity, quantity.values[a]),
                     of_b = badness(quantity, quantity.values[b]);
        return of_a > of_b || (of_a == of_b && a < b);
      });
  return cells;
}

/// The cells nearest to a place.
Cells cells_around(const ViewMesh& mesh, const Eigen::Vector3d& place, std::int64_t wanted) {
  const DoubleVector square =
      (mesh.points.leftCols(mesh.cells).colwise() - place).colwise().squaredNorm();
  Cells cells(static_cast<std::size_t>(mesh.cells));
  add_first(cells, wanted, [&](std::int32_t a, std::int32_t b) {
    return std::pair(square[a], a) < std::pair(square[b], b);
  });
  return cells;
}

/// The cell that a point is the site of, or a copy of it.
std::int32_t cell_of(const ViewMesh& mesh, std::int32_t point) {
  return point < mesh.cells ? point : mesh.copied[static_cast<std::size_t>(point - mesh.cells)];
}

bool contains(const Cells& cells, std::int32_t cell) {
  return cells[static_cast<std::size_t>(cell)];
}

/// Cells and all that share a triangle with one of them.
Cells grown(const ViewMesh& mesh, const Cells& cells) {
  Cells result = cells;
  for (const auto& triangle : mesh.triangles.colwise()) {
    const Eigen::Vector3i at =
        triangle.unaryExpr([&](std::int32_t point) { return cell_of(mesh, point); });
    if (std::any_of(at.begin(), at.end(), [&](std::int32_t i) { return contains(cells, i); }))
      for (const std::int32_t cell : at)
        result[static_cast<std::size_t>(cell)] = true;
  }
  return result;
}

/// Rows of cells around some, as long as there are not more than so many.
Cells with_rows(const ViewMesh& mesh, Cells cells, std::int64_t most) {
  for (;;) {
    Cells next = grown(mesh, cells);
    if (const std::int64_t wider = count(next); wider > most || wider == count(cells))
      return cells;
    cells = std::move(next);
  }
}

/// Cells along a space-filling curve.
std::vector<std::int32_t> along_curve(const ViewMesh& mesh,
                                      const std::vector<std::int32_t>& cells) {
  Mesh sites;
  sites.points = mesh.points(Eigen::all, cells);
  sites.surface = mesh.on_sphere ? Surface::sphere() : Surface::plane();
  sites.site_of_input.resize(cells.size());
  std::iota(sites.site_of_input.begin(), sites.site_of_input.end(), 0);
  const Mesh in_order = renumbered(sites, Numbering::curve);
  std::vector<std::int32_t> order(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    order[static_cast<std::size_t>(in_order.site_of_input[i])] = cells[i];
  return order;
}

/// The cells of `whole`, and so many of the others, evenly spread, in rising order.
std::vector<std::int32_t> kept_cells(const ViewMesh& mesh, const Cells& whole,
                                     std::int64_t spread) {
  std::vector<std::int32_t> kept, others;
  for (std::int32_t cell = 0; cell < mesh.cells; ++cell)
    (contains(whole, cell) ? kept : others).push_back(cell);
  others = along_curve(mesh, others);
  spread = std::min(spread, std::ssize(others));
  for (std::int64_t k = 0; k < spread; ++k)
    kept.push_back(others[static_cast<std::size_t>(k * std::ssize(others) / spread)]);
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// Leaves out triangles with another corner than these cells, and then points that are not kept.
void keep_points(ViewMesh& mesh, const Cells& whole) {
  const Eigen::Index triangles = mesh.triangles.cols();
  Eigen::Index kept = 0;
  for (Eigen::Index t = 0; t < triangles; ++t) {
    const Eigen::Vector3i at = mesh.triangles.col(t);
    if (std::all_of(at.begin(), at.end(),
                    [&](std::int32_t point) { return contains(whole, cell_of(mesh, point)); }))
      mesh.triangles.col(kept++) = at;
  }
  mesh.triangles.conservativeResize(3, kept);
  std::vector<std::int32_t> place(static_cast<std::size_t>(mesh.points.cols()), -1), from, copied;
  for (const std::int32_t cell : mesh.number) {
    place[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(from.size());
    from.push_back(cell);
  }
  for (std::int32_t& point : mesh.triangles.reshaped()) {
    std::int32_t& at = place[static_cast<std::size_t>(point)];
    if (at < 0) { // a copy
      at = static_cast<std::int32_t>(from.size());
      from.push_back(point);
      copied.push_back(place[static_cast<std::size_t>(cell_of(mesh, point))]);
    }
    point = at;
  }
  mesh.points = Points3(mesh.points(Eigen::all, from));
  mesh.copied = std::move(copied);
}

/// The shapes of kept cells; without corners for those that are not whole.
void keep_shapes(ViewMesh& mesh, const Cells& whole) {
  const Polygons& all = *mesh.shapes;
  std::vector<std::int32_t> place(static_cast<std::size_t>(all.corners.cols()), -1), from, ids;
  Polygons shapes;
  shapes.surface = all.surface;
  shapes.ids.begin.setZero(std::ssize(mesh.number) + 1);
  for (Eigen::Index k = 0; k < std::ssize(mesh.number); ++k) {
    const std::int32_t cell = mesh.number[static_cast<std::size_t>(k)];
    if (contains(whole, cell))
      for (const std::int32_t corner : all.ids[cell]) {
        std::int32_t& at = place[static_cast<std::size_t>(corner)];
        if (at < 0) {
          at = static_cast<std::int32_t>(from.size());
          from.push_back(corner);
        }
        ids.push_back(at);
      }
    shapes.ids.begin[k + 1] = std::ssize(ids);
  }
  shapes.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
  shapes.corners = Points3(all.corners(Eigen::all, from));
  mesh.shapes = std::move(shapes);
}

std::string words_of(const ViewMesh& mesh, const Eigen::Vector3d& place) {
  if (!mesh.on_sphere)
    return message("{}, {}", formatted("%.4g", place.x()), formatted("%.4g", place.y()));
  const LonLat at = lonlat_of(place);
  return lonlat_words(at.longitude, at.latitude);
}

} // namespace

Eigen::Vector3d finest_place(const ViewMesh& mesh) {
  Eigen::Index finest = 0;
  for (const Quantity& quantity : mesh.quantities)
    if (quantity.name == "area")
      for (Eigen::Index i = 0; i < quantity.values.size(); ++i)
        if (!(quantity.values[i] >= quantity.values[finest]) && std::isfinite(quantity.values[i]))
          finest = i;
  return mesh.points.col(finest);
}

void thin(ViewMesh& mesh, std::int64_t most) {
  const Eigen::Vector3d place = mesh.home.value_or(finest_place(mesh));
  mesh.home = place;
  Cells whole = cells_around(mesh, place, most / parts);
  const Cells worst = with_rows(mesh, worst_cells(mesh), most / parts);
  std::transform(whole.begin(), whole.end(), worst.begin(), whole.begin(), std::logical_or<>());
  mesh.number = kept_cells(mesh, whole, std::max<std::int64_t>(1, most - count(whole)));
  if (mesh.shapes)
    keep_shapes(mesh, whole);
  keep_points(mesh, whole);
  std::erase_if(mesh.quantities, [](const Quantity& quantity) { return quantity.on_triangles; });
  for (Quantity& quantity : mesh.quantities)
    quantity.values = DoubleVector(quantity.values(mesh.number));
  mesh.cells = std::ssize(mesh.number);
  const std::string notice = message(
      "The page holds {} of {} cells; dots are cells without their shapes. Whole are the cells "
      "around {}, and the worst with those around them; the dots are spread evenly over the "
      "others. "
      "{}calotte info --cell N prints any cell. Bars and marks count the cells of the page, the "
      "table all. ",
      spaced(mesh.cells), spaced(mesh.total), words_of(mesh, place),
      mesh.on_sphere ? "calotte view --view LON,LAT holds those around another place. " : "");
  mesh.notice = notice + mesh.notice; // the page shows the first sentence
}

} // namespace calotte::tools
