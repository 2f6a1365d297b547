// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// All of the library.
#include <calotte/cell_width.h>
#include <calotte/check.h>
#include <calotte/check_file.h>
#include <calotte/cull.h>
#include <calotte/cut.h>
#include <calotte/cvt.h>
#include <calotte/delaunay.h>
#include <calotte/density.h>
#include <calotte/error.h>
#include <calotte/export.h>
#include <calotte/generators.h>
#include <calotte/grid.h>
#include <calotte/interpolate.h>
#include <calotte/io.h>
#include <calotte/limited_area.h>
#include <calotte/lists.h>
#include <calotte/locate.h>
#include <calotte/lonlat.h>
#include <calotte/matrices.h>
#include <calotte/model.h>
#include <calotte/ocean.h>
#include <calotte/operators.h>
#include <calotte/options.h>
#include <calotte/planar_raster.h>
#include <calotte/progress.h>
#include <calotte/quality.h>
#include <calotte/read.h>
#include <calotte/renumber.h>
#include <calotte/surface.h>
#include <calotte/types.h>
#include <calotte/version.h>
#include <calotte/voronoi.h>
#include <calotte/write.h>
#include <calotte/write_grid.h>
