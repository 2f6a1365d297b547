// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a grid whose cells have a width, and writes it with a field. The width is the distance
// between the centres of neighbouring cells. Usage: grid KM FILE, such as grid 1000 grid.nc.
#include <calotte/error.h>
#include <calotte/grid.h>
#include <calotte/write_grid.h>

#include <iostream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: grid KM FILE\n";
    return 2;
  }
  try {
    calotte::Recipe recipe;
    recipe.resolution = std::stod(argv[1]); // or a raster, rules, or a density
    const calotte::Schedule schedule = calotte::plan(recipe);
    std::cout << "the width implies " << schedule.recipe.cells << " cells\n";

    const calotte::Cvt grid = calotte::make_grid(schedule);
    std::cout << (grid.report.converged ? "converged" : "not converged") << " after "
              << grid.report.iterations.size() << " evaluations\n";

    calotte::WriteOptions options; // the suffix .nc selects a mesh file of MPAS
    options.sphere_radius = calotte::earth_radius_km * 1000;
    calotte::MeshField field{.name = "sine_of_latitude", .units = "1"};
    field.values = grid.mesh.points.row(2); // one number for each cell
    options.fields = {field};
    calotte::write_grid(argv[2], grid.mesh, recipe, schedule, options);
  } catch (const calotte::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
