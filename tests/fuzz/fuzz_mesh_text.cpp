// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_laws.h"
#include "scratch_file.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>
#include <calotte/read.h>

#include <algorithm>
#include <initializer_list>
#include <string>

using namespace calotte;

namespace {

/// Writes the input's parts, which % separates, to files beside each other; the others are empty.
/// \returns the path of the first.
std::string write_parts(std::initializer_list<const char*> names, const std::uint8_t* data,
                        std::size_t size) {
  std::string first;
  const std::uint8_t* const end = data + size;
  for (const char* name : names) {
    const std::uint8_t* const stop = std::find(data, end, '%');
    const std::string path = fuzz::scratch_file(name, data, static_cast<std::size_t>(stop - data));
    first = first.empty() ? path : first;
    data = stop == end ? end : stop + 1;
  }
  return first;
}

} // namespace

/// Meshes in files of text that have no fuzzer of their own. The first byte selects FESOM,
/// MPI-SCVT, points with .tri, SCHISM and ADCIRC, or SMS.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0)
    return 0;
  try {
    if (data[0] % 5 > 2) {
      const std::string path =
          write_parts({data[0] % 5 == 3 ? "fort.14" : "a.2dm"}, data + 1, size - 1);
      const MeshFile file = read_mesh_file(path);
      fuzz::require_sound(file);
      check_file(path, file);
    } else if (data[0] % 5 == 0) {
      fuzz::require_sound(
          read_mesh_file(write_parts({"nod2d.out", "elem2d.out"}, data + 1, size - 1)));
    } else if (data[0] % 5 == 1) {
      fuzz::require_sound(read_mesh_file(
          write_parts({"SaveVertices", "SaveTriangles", "SaveDensity"}, data + 1, size - 1)));
    } else {
      const std::string points = write_parts({"a.txt", "a.tri"}, data + 1, size - 1);
      const Points3 sites = read_points(points);
      fuzz::require_sound(read_mesh_file(points.substr(0, points.size() - 3) + "tri", &sites));
    }
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
  return 0;
}
