// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"

#include <calotte/check.h>
#include <calotte/error.h>
#include <calotte/mesh.h>
#include <calotte/quality.h>
#include <calotte/voronoi.h>

using namespace calotte;
using calotte::fuzz::require;

namespace {

/// Calls a function that may refuse its input.
template <class Function> void attempt(const Function& function) {
  try {
    function();
  } catch (const Error& error) {
    require(error.code() != ErrorCode::internal);
  }
}

Triangles ids(fuzz::Bytes& bytes, int triangles, int low, int high) {
  Triangles list(3, triangles);
  for (std::int32_t& id : list.reshaped())
    id = bytes.integer(low, high);
  return list;
}

} // namespace

/// Meshes of any ids: each function that takes a mesh uses it or refuses it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const int triangles = bytes.integer(0, 30), points = bytes.integer(1, 20);
  Mesh mesh;
  mesh.triangles = ids(bytes, triangles, -1, points);
  mesh.neighbours = ids(bytes, triangles, -1, triangles);
  mesh.points = bytes.columns(3, points);
  attempt([&] { check(mesh); });
  attempt([&] { check_surface(mesh); });
  attempt([&] { quality(mesh); });
  attempt([&] { cell_measures(mesh); });
  attempt([&] { voronoi(mesh); });
  attempt([&] { operator_errors(mesh); });
  attempt([&] { renumbered(mesh, Numbering::curve); });
  return 0;
}
