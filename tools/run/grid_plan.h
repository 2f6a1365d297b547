// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options/cvt_request.h"
#include "options/rule_shares.h"
#include "run/cvt_costs.h"
#include "run/cvt_input.h"
#include "run/extent.h"
#include "run/spacing_survey.h"

#include <calotte/grid.h>

#include <optional>
#include <string>
#include <vector>

/// What calotte plan says of a grid before it is made.
namespace calotte::tools {

/// The grid that a run would make.
struct GridPlan {
  std::string density;          ///< its name
  std::string doubt;            ///< about widths that may be in metres, or ""
  Surface surface;              ///< that is asked for, without the rings of a limited area
  std::string region;           ///< its word, or ""
  std::optional<Extent> extent; ///< of a part of the sphere and of a plane
  std::int64_t cells = 0;
  std::string beyond;             ///< cells of the run that are not written, in words, or ""
  double implied = 0;             ///< cells that widths imply; 0 for a density
  double factor = 1;              ///< of the widths of the file, in this grid
  std::int64_t fixed = 0;         ///< generators that stay, those on lines and on the boundary, too
  std::vector<CvtAction> actions; ///< of the run
  SpacingSurvey spacing;
  std::optional<double> radius_km; ///< of the sphere, if known
  double width_seconds = 0;        ///< that reading widths and planning with them took
  std::vector<RuleShare> rules;    ///< of the widths, if there are any
  int threads = 1;
  CvtCosts costs;
  double memory = 0;                ///< of this machine, bytes
  std::optional<ModelMemory> model; ///< MPAS-Atmosphere, unless the grid is for another one
  double least_spacing = 0;         ///< of cells over their width, that the run keeps
};

/// \param radius_km of the sphere where no widths give it, if it is known.
GridPlan make_grid_plan(const CvtRequest& request, const CvtInput& input, const Schedule& schedule,
                        std::optional<double> radius_km);

/// Rows for people. \param unit of lengths and areas of the sphere.
std::string table(const GridPlan& plan, const Unit& unit);
std::string to_json(const GridPlan& plan);

} // namespace calotte::tools
