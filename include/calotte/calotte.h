// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// All of the library.
#include <calotte/area_weights.h>  // areas of the cells of points
#include <calotte/boundary.h>      // parts of the boundary of a mesh
#include <calotte/check.h>         // whether a mesh is Delaunay, in exact arithmetic
#include <calotte/checkpoint.h>    // the state of a run in a file
#include <calotte/coastal_cells.h> // cells that end at a coast
#include <calotte/cut.h>           // parts of files: limited areas cut, land culled
#include <calotte/cvt.h>           // recipes, schedules, reports and states of runs
#include <calotte/delaunay.h>      // triangulations of points
#include <calotte/density.h>       // densities of cells
#include <calotte/error.h>         // what is thrown
#include <calotte/export.h>        // what a shared library exports
#include <calotte/field_grid.h>    // interpolation between files
#include <calotte/gates.h>         // the demands of models on grids
#include <calotte/generalise.h>    // the sea at the widths of a grid
#include <calotte/generators.h>    // points to start from, longitudes and latitudes
#include <calotte/grid.h>          // grids by recipes: plan() and make_grid()
#include <calotte/limited_area.h>  // grids of limited areas
#include <calotte/locate.h>        // which triangle and which cell holds a point
#include <calotte/matrices.h>      // points, ids and lists
#include <calotte/mesh.h>          // meshes, polygons, fields, neighbours
#include <calotte/mesh_file.h>     // what a file of a mesh holds, and its check
#include <calotte/multimesh.h>     // nested nodes for graphs of machine learning
#include <calotte/ocean.h>         // land, seas and coasts
#include <calotte/partition.h>     // parts of cells for processes
#include <calotte/progress.h>      // progress and cancelling
#include <calotte/quality.h>       // what a model judges a grid by
#include <calotte/raster.h>        // rasters of longitude and latitude, or x and y
#include <calotte/read.h>          // files that are read
#include <calotte/refine.h>        // finer or coarser cells in a part
#include <calotte/remap.h>         // weights and interpolation
#include <calotte/rotate.h>        // files that are rotated, with their fields
#include <calotte/rotation.h>      // rotations of the sphere
#include <calotte/surface.h>       // the sphere, planes and their parts
#include <calotte/version.h>       // the version
#include <calotte/voronoi.h>       // the dual mesh, its edges and fields
#include <calotte/widths.h>        // cell widths as rules and rasters
#include <calotte/write.h>         // meshes written, for models
#include <calotte/write_grid.h>    // grids in formats of their cells
#include <calotte/write_region.h>  // regions
