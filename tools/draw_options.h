// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "draw/draw.h"
#include "help/cli_forward.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/mesh_source.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// The options of calotte draw.
struct DrawArguments {
  std::shared_ptr<MeshSource> source;
  std::shared_ptr<DensityWords> density;
  std::vector<const CLI::Option*> density_options; ///< all options that add_density adds
  const CLI::Option* what = nullptr;
  const CLI::Option* colour = nullptr;
  std::string output;
  DrawOptions options;
  std::string error_of;                ///< the operator whose errors are drawn as a field, or ""
  std::optional<double> sphere_radius; ///< metres
  std::optional<std::string> units;
  std::optional<bool> coastlines;   ///< as asked for
  std::string region;               ///< whose boundary is drawn, as asked for
  std::string inside;               ///< a point of it, LON,LAT, or ""
  std::vector<std::string> reports; ///< drawn instead of a mesh
  bool spacing_law = false;
  std::shared_ptr<DomainWords> domain; ///< of a mesh of the plane

  bool has_density() const { return !density->densities.empty() || density->widths.given(); }
};

/// Adds the options. Their values are set when the command line is read.
std::shared_ptr<DrawArguments> add_draw_options(CLI::App& command);

} // namespace calotte::tools
