// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/jigsaw_options.h"

#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

namespace calotte::tools {
namespace {

constexpr std::string_view shapes = "shapes are brought within the limits of models";
constexpr std::string_view descent = "the grid is a centroidal Voronoi tessellation";
constexpr std::string_view boundary =
    "generators keep the corners where a line turns by 20 degrees or more";

constexpr std::array<JigsawOption, 52> table{{
    {"GEOM_FILE", JigsawUse::honoured,
     "ellipsoid-mesh with equal radii, or euclidean-mesh of NDIMS=2"},
    {"MESH_FILE", JigsawUse::honoured, "the result"},
    {"HFUN_FILE", JigsawUse::honoured, "a grid or a mesh of widths; without one HFUN_HMAX"},
    {"HFUN_SCAL", JigsawUse::honoured, "RELATIVE (default) or ABSOLUTE"},
    {"HFUN_HMAX", JigsawUse::honoured, "default 0.02"},
    {"HFUN_HMIN", JigsawUse::honoured, "default 0"},
    {"INIT_FILE", JigsawUse::honoured,
     "points of negative tags stay; with MESH_ITER=0 a start of all"},
    {"MESH_DIMS", JigsawUse::honoured, "2, the default here"},
    {"MESH_ITER", JigsawUse::honoured, "0: the points of INIT_FILE and no others; else ignored"},
    {"NUMTHREAD", JigsawUse::honoured, "0 or less: all"},
    {"VERBOSITY", JigsawUse::honoured, "0: one line; 1 or more: what is ignored, too"},
    {"TRIA_FILE", JigsawUse::refused, "there is no complex of triangles of a refinement"},
    {"BNDS_FILE", JigsawUse::refused, "there is no complex of a boundary's refinement"},
    {"GEOM_SEED", JigsawUse::ignored, descent},
    {"GEOM_FEAT", JigsawUse::ignored, boundary},
    {"GEOM_PHI1", JigsawUse::ignored, boundary},
    {"GEOM_PHI2", JigsawUse::ignored, boundary},
    {"GEOM_ETA1", JigsawUse::ignored, boundary},
    {"GEOM_ETA2", JigsawUse::ignored, boundary},
    {"INIT_NEAR", JigsawUse::ignored, "points stay where they are"},
    {"MESH_KERN", JigsawUse::ignored, descent},
    {"BNDS_KERN", JigsawUse::ignored, descent},
    {"MESH_RULE", JigsawUse::ignored, descent},
    {"MESH_ORPH", JigsawUse::ignored, "there are no orphaned edges"},
    {"MESH_LOCK", JigsawUse::ignored, descent},
    {"MESH_TOP1", JigsawUse::ignored, "the boundary is one line of generators"},
    {"MESH_TOP2", JigsawUse::ignored, "the mesh is a surface"},
    {"MESH_SIZ1", JigsawUse::ignored, descent},
    {"MESH_SIZ2", JigsawUse::ignored, descent},
    {"MESH_SIZ3", JigsawUse::ignored, descent},
    {"MESH_EPS1", JigsawUse::ignored, boundary},
    {"MESH_EPS2", JigsawUse::ignored, "generators lie on the sphere"},
    {"MESH_RAD2", JigsawUse::ignored, shapes},
    {"MESH_RAD3", JigsawUse::ignored, shapes},
    {"MESH_OFF2", JigsawUse::ignored, descent},
    {"MESH_OFF3", JigsawUse::ignored, descent},
    {"MESH_SNK2", JigsawUse::ignored, descent},
    {"MESH_SNK3", JigsawUse::ignored, descent},
    {"MESH_VOL3", JigsawUse::ignored, shapes},
    {"OPTM_KERN", JigsawUse::ignored, descent},
    {"OPTM_COST", JigsawUse::ignored, shapes},
    {"OPTM_BETA", JigsawUse::ignored, descent},
    {"OPTM_ZETA", JigsawUse::ignored, descent},
    {"OPTM_ITER", JigsawUse::ignored, "the run ends when the grid is within its tolerance"},
    {"OPTM_QTOL", JigsawUse::ignored, "the run ends when the grid is within its tolerance"},
    {"OPTM_QLIM", JigsawUse::ignored, shapes},
    {"OPTM_WMIN", JigsawUse::ignored, "the dual is a Voronoi diagram: all weights are 0"},
    {"OPTM_WMAX", JigsawUse::ignored, "the dual is a Voronoi diagram: all weights are 0"},
    {"OPTM_ZIP_", JigsawUse::ignored, "generators are inserted and removed as the widths require"},
    {"OPTM_DIV_", JigsawUse::ignored, "generators are inserted and removed as the widths require"},
    {"OPTM_TRIA", JigsawUse::ignored, descent},
    {"OPTM_DUAL", JigsawUse::ignored, "the dual is a Voronoi diagram: all weights are 0"},
}};

} // namespace

const JigsawOption* jigsaw_option(std::string_view name) {
  const auto* const found = std::ranges::find(table, name, &JigsawOption::name);
  return found == table.end() ? nullptr : found;
}

std::string jigsaw_options() {
  std::ostringstream out;
  for (const JigsawOption& option : table)
    out << std::left << std::setw(12) << option.name << std::setw(10)
        << (option.use == JigsawUse::honoured  ? "honoured"
            : option.use == JigsawUse::ignored ? "ignored"
                                               : "refused")
        << option.what << "\n";
  return out.str();
}

} // namespace calotte::tools
