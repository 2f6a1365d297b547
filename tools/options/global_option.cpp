// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/global_option.h"

#include "io/command.h"
#include "options/model_option.h"
#include "text/text.h"

#include <calotte/write.h>

#include <CLI/App.hpp>

#include <filesystem>
#include <system_error>

namespace calotte::tools {

void add_global(CLI::App& command, std::string& path) {
  command
      .add_option("GLOBAL,-i,--input", path,
                  "MPAS file of the sphere with connectivity, of any program, with any fields.")
      ->type_name("FILE")
      ->required();
}

void require_mpas_source(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) && !is_netcdf_file(path))
    refuse_path(path, "it is no MPAS file; make one of a mesh with calotte convert {} mesh.nc",
                path);
}

void require_mpas_name(const std::string& output) {
  if (format_of(output) != Format::mpas)
    refuse_path(output, "the grid is an MPAS file; give a name that ends in .nc");
}

void require_mpas_model(const std::optional<std::string>& model) {
  if (const ModelNeeds* const known = model_of(model);
      known != nullptr && known->format != Format::mpas)
    refuse(message("--for {}: the grid is an MPAS file; leave the option out, and convert the grid "
                   "with calotte convert GRID.nc nod2d.out",
                   known->word));
}

} // namespace calotte::tools
