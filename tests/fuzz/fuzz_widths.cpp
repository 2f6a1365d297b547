// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "mutation.h"
#include "scratch_file.h"

#include <calotte/error.h>
#include <calotte/generators.h>
#include <calotte/read.h>
#include <calotte/widths.h>

using namespace calotte;

/// Cell widths: what is read has a density everywhere. CALOTTE_FUZZ_SUFFIX selects the format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::scratch_file("widths" CALOTTE_FUZZ_SUFFIX, data, size);
  try {
    const Raster widths = read_cell_width(path, {.inside = 50, .outside = 100, .transition = 3000});
    fuzz::require(widths.values.minCoeff() > 0);
    fuzz::require(evaluate(widths, fibonacci_sphere(20)).allFinite());
    implied_cells(widths);
    largest_gradient(widths);
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
