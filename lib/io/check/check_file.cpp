// SPDX-License-Identifier: GPL-3.0-or-later
#include <calotte/mesh_file.h>

#include "io/cells/deviations.h"
#include "io/check/coast_check.h"
#include "io/check/grid_check.h"
#include "io/check/mpas_check.h"
#include "io/command.h"
#include "io/formats/format_table.h"
#include "io/netcdf/netcdf_reader.h"

#include <utility>

namespace calotte {

using namespace io_detail;

namespace {

/// \param file a MeshFile&&, whose memory is freed early, or a const MeshFile&.
template <class File> std::vector<Deviation> find_deviations(const std::string& path, File&& file) {
  if (!is_netcdf(file))
    return check_coast(path, file);
  const NetcdfReader stored(path);
  const FormatRow* const row = find_row(stored);
  if (row == nullptr)
    return {};
  Deviations deviations(stored);
  switch (row->info.format) {
  case Format::mpas:
    check_mpas(std::forward<File>(file), deviations);
    break;
  case Format::ugrid:
    check_ugrid(file, deviations);
    break;
  case Format::scrip:
    check_scrip(file, deviations);
    break;
  case Format::esmf:
    check_esmf(file, deviations);
    break;
  default:
    break;
  }
  return std::move(deviations).result();
}

} // namespace

std::vector<Deviation> check_file(const std::string& path, const MeshFile& file) {
  return find_deviations(path, file);
}

std::vector<Deviation> check_file(const std::string& path, MeshFile&& file) {
  return find_deviations(path, std::move(file));
}

} // namespace calotte
