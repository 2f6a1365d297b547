// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/global_option.h"

#include <calotte/error.h>
#include <calotte/write.h>

namespace calotte::tools {

void add_global(CLI::App& command, std::string& path) {
  command
      .add_option("GLOBAL,-i,--input", path,
                  "MPAS file of the sphere with connectivity, of any program, with any fields.")
      ->type_name("FILE")
      ->required();
}

void require_mpas_name(const std::string& output) {
  if (format_of(output) != Format::mpas)
    throw Error(ErrorCode::bad_option,
                output + ": the grid is an MPAS file; give a name that ends in .nc");
}

} // namespace calotte::tools
