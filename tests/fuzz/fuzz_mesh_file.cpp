// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "mutation.h"
#include "scratch_file.h"

#include <calotte/check.h>
#include <calotte/error.h>
#include <calotte/mesh_file.h>

using namespace calotte;

/// Mesh files: what is read is a surface, or polygons whose corners exist.
/// CALOTTE_FUZZ_SUFFIX selects the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::scratch_file("mesh" CALOTTE_FUZZ_SUFFIX, data, size);
  try {
    const MeshFile file = read_mesh_file(path);
    if (file.mesh)
      fuzz::require(file.mesh->triangles.size() == 0 ||
                    (file.mesh->triangles.minCoeff() >= 0 &&
                     file.mesh->triangles.maxCoeff() < file.mesh->points.cols()));
    if (file.polygons && file.polygons->ids.size() > 0)
      fuzz::require(file.polygons->ids.minCoeff() >= 0 &&
                    file.polygons->ids.maxCoeff() < file.polygons->corners.cols());
    if (file.mesh)
      check_surface(*file.mesh);
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
  return 0;
}

#ifdef CALOTTE_FUZZ_NETCDF
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return calotte::fuzz::mutate_netcdf(data, size, most, seed);
}
#endif
