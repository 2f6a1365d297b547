// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/check_file.h>

#include "io/cells/deviations.h"
#include "io/check/grid_check.h"
#include "io/check/mpas_check.h"
#include "io/formats/formats.h"
#include "io/netcdf/netcdf_reader.h"

#include <utility>

namespace calotte {

using namespace io_detail;

namespace {

/// \param file a MeshFile&&, which is freed on the way, or a const MeshFile&.
template <class File> std::vector<Deviation> deviations_of(const std::string& path, File&& file) {
  if (file.format != "MPAS" && file.format != "UGRID" && file.format != "SCRIP" &&
      file.format != "ESMF")
    return {};
  const NetcdfReader stored(path);
  Deviations deviations(stored);
  if (is_mpas(stored))
    check_mpas(std::forward<File>(file), deviations);
  else if (is_ugrid(stored))
    check_ugrid(file, deviations);
  else if (is_scrip(stored))
    check_scrip(file, deviations);
  else if (is_esmf(stored))
    check_esmf(file, deviations);
  return std::move(deviations).result();
}

} // namespace

std::vector<Deviation> check_file(const std::string& path, const MeshFile& file) {
  return deviations_of(path, file);
}

std::vector<Deviation> check_file(const std::string& path, MeshFile&& file) {
  return deviations_of(path, std::move(file));
}

} // namespace calotte
