// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// All of the library.
#include <calotte/check.h>
#include <calotte/checkpoint.h>
#include <calotte/cut.h>
#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/field_grid.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/limited_area.h>
#include <calotte/locate.h>
#include <calotte/matrices.h>
#include <calotte/mesh.h>
#include <calotte/mesh_file.h>
#include <calotte/ocean.h>
#include <calotte/partition.h>
#include <calotte/progress.h>
#include <calotte/quality.h>
#include <calotte/raster.h>
#include <calotte/read.h>
#include <calotte/refine.h>
#include <calotte/remap.h>
#include <calotte/surface.h>
#include <calotte/version.h>
#include <calotte/voronoi.h>
#include <calotte/widths.h>
#include <calotte/write.h>
#include <calotte/write_grid.h>
