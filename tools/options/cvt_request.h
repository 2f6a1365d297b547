// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/budget.h"
#include "options/coast_option.h"
#include "options/delaunay_options.h"
#include "options/density_option.h"
#include "options/domain_option.h"
#include "options/format_options.h"
#include "options/region_option.h"

#include <calotte/grid.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace calotte::tools {

/// The values of the options of `calotte cvt`.
struct CvtRequest {
  std::string points; ///< the file of the start, or none
  std::string fixed;  ///< the file of generators that stay, or none
  bool lonlat = false;
  std::shared_ptr<DomainWords> domain; ///< of a plane, where one is given
  RegionWords part;                    ///< of the sphere
  std::optional<int> cells;            ///< of the result
  bool cells_of_widths = false;        ///< --cells auto: the number that the cell widths imply
  std::string budget;                  ///< --budget, instead of cells; or ""
  ModelMemory memory;                  ///< of the model, for it
  std::optional<std::string> start;    ///< default: see Start
  std::optional<std::uint64_t> seed;
  std::optional<int> bisections;
  std::optional<int> insertion_rounds; ///< of a multilevel start

  std::shared_ptr<DensityWords> density;
  std::string method = "auto";
  std::string norm = "l2-scaled";
  std::optional<std::string> stop;         ///< default: see Stop
  std::optional<double> least_spacing;     ///< of a run that ends well-centred
  std::optional<double> most_off_midpoint; ///< the same
  std::optional<double> given_tolerance;
  int max_iterations = CvtStop{}.max_iterations;
  std::optional<int> iterations;
  std::shared_ptr<DelaunayWords> delaunay;

  std::optional<std::string> units; ///< --units, of widths in messages
  std::shared_ptr<FormatWords> format;
  CoastWords coast; ///< for models of the coastal ocean
  std::string mesh, report;
  std::string checkpoint, resume;
  std::string options;           ///< all that are given, for a checkpoint
  std::optional<int> keep_every; ///< --keep-every
  int checkpoint_every = 100;
  double checkpoint_minutes = 10;
  std::shared_ptr<std::string> config;
};

/// True for a run in the plane.
inline bool planar(const CvtRequest& request) { return request.domain->given(); }

/// The rectangle of a picture is the domain, where neither a domain nor a region is given.
/// \throws Error as rectangle_of_picture().
void set_domain_of_picture(CvtRequest& request);

/// The options of the mesh file, without density and history.
/// \throws Error as options_of(FormatWords) does.
WriteOptions write_options(const CvtRequest& request);

} // namespace calotte::tools
