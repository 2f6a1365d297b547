// SPDX-License-Identifier: GPL-3.0-or-later
#include "bytes.h"
#include "mutation.h"
#include "scratch_file.h"

#include <calotte/error.h>
#include <calotte/field_grid.h>

using namespace calotte;

/// Grids with fields in NetCDF: cells and values that match, read as a whole and in parts.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string path = fuzz::scratch_file("fields.nc", data, size);
  try {
    const FieldGrid whole = read_field_grid(path);
    if (whole.boxes || !whole.mesh.polygons)
      return 0;
    for (const MeshField& field : whole.fields)
      fuzz::require(field.values.size() == whole.size() * field.count());
    const FieldParts parts(path, {}, 7);
    std::int64_t cells = 0;
    for (std::int64_t k = 0; k < parts.count(); ++k) {
      const FieldGrid part = parts.read(k);
      fuzz::require(part.fields.size() == whole.fields.size());
      cells += part.size();
    }
    fuzz::require(cells == whole.size());
    interpolate_parts(parts, whole.fields, *raster_of("36x18"));
  } catch (const Error& error) {
    fuzz::require(error.code() != ErrorCode::internal);
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return calotte::fuzz::mutate_netcdf(data, size, most, seed);
}
