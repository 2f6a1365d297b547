// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the Voronoi cells of a mesh, and reads one of them: its neighbours, corners and area.
#include <calotte/delaunay.h>
#include <calotte/generators.h>
#include <calotte/voronoi.h>

#include <cstdint>
#include <iostream>

int main() {
  const calotte::Mesh mesh = calotte::delaunay(calotte::fibonacci_sphere(1000));
  const calotte::Voronoi voronoi = calotte::voronoi(mesh); // cell i is that of site i

  // Of neighbours alone calotte::neighbours(mesh) has the same lists, in less time.
  const int site = 17;
  std::cout << "site " << site << " has the neighbours";
  for (const std::int32_t neighbour : voronoi.cells_on_cell[site])
    std::cout << ' ' << neighbour;

  std::cout << "\nits cell has the corners (longitude, latitude)";
  for (const std::int32_t vertex : voronoi.vertices_on_cell[site])
    std::cout << " (" << calotte::to_lonlat(voronoi.vertices.col(vertex)).transpose() << ')';

  const double radius = 6371; // areas are those of the unit sphere
  std::cout << "\nand " << voronoi.cell_area[site] << " steradians, on the Earth "
            << voronoi.cell_area[site] * radius * radius << " km^2\n";
}
