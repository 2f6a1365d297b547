// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a mesh file of any format, and lists what it holds. Usage: file FILE
#include <calotte/error.h>
#include <calotte/mesh_file.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: file FILE\n";
    return 2;
  }
  try {
    const calotte::MeshFile file = calotte::read_mesh_file(argv[1]);
    std::cout << file.format << ", of a " << (file.surface().is_sphere() ? "sphere" : "plane")
              << '\n';
    if (file.mesh) // the triangles between the sites
      std::cout << file.mesh->points.cols() << " sites, " << file.mesh->triangles.cols()
                << " triangles\n";
    if (file.polygons) // cells that do not follow from these
      std::cout << file.polygons->size() << " cells of their own shape\n";
    const char* const locations[] = {"cells", "edges", "vertices"};
    for (const calotte::MeshField& field : file.fields) {
      std::cout << "field " << field.name << " at " << locations[int(field.location)] << ", "
                << field.values.size() << " numbers";
      if (field.values.size() > 0) // NaN, where the file has none, does not count
        std::cout << " from " << field.values.minCoeff<Eigen::PropagateNumbers>() << " to "
                  << field.values.maxCoeff<Eigen::PropagateNumbers>();
      std::cout << ' ' << field.units << '\n';
    }
    for (const std::string& change : file.changes)
      std::cout << "reading " << change << '\n';
  } catch (const calotte::Error& error) { // it names the file, and what is wrong in it
    std::cerr << error.what() << '\n';
    return 1;
  }
}
