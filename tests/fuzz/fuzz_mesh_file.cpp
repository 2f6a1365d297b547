// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_laws.h"
#include "mutation.h"
#include "scratch_file.h"

#include <calotte/error.h>
#include <calotte/mesh_file.h>

using namespace calotte;

/// Mesh files of one file. CALOTTE_FUZZ_SUFFIX selects the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::scratch_file("mesh" CALOTTE_FUZZ_SUFFIX, data, size);
  try {
    fuzz::require_sound(read_mesh_file(path));
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
