// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "mutation.h"

#include <calotte/check.h>
#include <calotte/error.h>
#include <calotte/grid.h>

using namespace calotte;
using calotte::fuzz::require;

/// Three iterations of a CVT of the sphere: the energy falls, the mesh is exact, and the bits are
/// those of any other number of regions.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  Recipe recipe;
  recipe.stop.max_iterations = 3;
  recipe.method = static_cast<Method>(bytes.integer(0, 3));
  if (bytes.integer(0, 1) == 1)
    recipe.resolution = tanh_bump({bytes.number(), bytes.number(), bytes.number()}, bytes.number(),
                                  bytes.number(), bytes.number());
  recipe.start.points = bytes.columns(3, 200);
  try {
    const Cvt result = make_grid(recipe);
    require(check(result.mesh).passed());
    const Cvt again = make_grid(recipe, {.decomposition = {.regions = 5}});
    require(again.mesh.points == result.mesh.points &&
            again.mesh.triangles == result.mesh.triangles);
    const CvtIteration* before = nullptr;
    for (const CvtIteration& iteration : result.report.iterations)
      if (iteration.accepted) {
        if (before != nullptr && before->rule == iteration.rule &&
            before->linear_density == iteration.linear_density)
          require(iteration.energy <= before->energy * (1 + 1e-9));
        before = &iteration;
      }
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return calotte::fuzz::mutate_points(data, size, most, seed);
}
