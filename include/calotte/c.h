/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CALOTTE_C_H
#define CALOTTE_C_H

/** \file
 * The library for C, and for languages that call C (Fortran by iso_c_binding, Julia by ccall,
 * Rust).
 *
 *     calotte_recipe recipe;
 *     calotte_error error;
 *     calotte_mesh* mesh = NULL;
 *     calotte_recipe_init(&recipe);
 *     calotte_error_init(&error);
 *     recipe.cells = 40962;
 *     if (calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error) != CALOTTE_OK)
 *       fprintf(stderr, "%s\n", error.message);
 *
 * A function returns CALOTTE_OK or a code, and then fills *error, unless that is null; its outputs
 * are unchanged. No C++ exception leaves a function. Points on the sphere are x y z, x y z, ... of
 * any norm; in a plane x y, x y, ... Ids are 0-based. Lengths on the sphere are radians and areas
 * steradians, of the unit sphere; in a plane its unit of length and the square of it. Results have
 * the same bits for any number of threads. Threads may call functions at the same time, also with
 * the same mesh.
 *
 * Every struct has a function of its name and _init, which sets all members to their defaults; the
 * caller then sets what it asks for. A struct that was not initialised is
 * CALOTTE_INVALID_ARGUMENT. The defaults of all structs but calotte_recipe are 0, so that
 * {.size = sizeof(calotte_surface)} initialises a surface, too. In a language that cannot call
 * inline functions a program sets `size`, and calls calotte_recipe_init_sized().
 *
 * The first member is the struct's size: a program that was compiled with an older header works
 * with a newer library, which reads and writes as many bytes at most. Members that the caller's
 * struct lacks have their defaults. A member that the library does not know and that is not 0 is
 * CALOTTE_INVALID_ARGUMENT. All members but arrays of characters have 8 bytes where pointers have.
 */

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

/** \def CALOTTE_C_API
 * The shared library exports what is declared with it. */
#ifdef __GNUC__
#define CALOTTE_C_API __attribute__((visibility("default")))
#else
#define CALOTTE_C_API
#endif

/** Why a function failed; the values of calotte::ErrorCode, plus 1. */
typedef enum calotte_status {
  CALOTTE_OK = 0,           /**< success */
  CALOTTE_NOT_FINITE,       /**< a coordinate is NaN or infinite */
  CALOTTE_ZERO_VECTOR,      /**< a point at the origin has no direction */
  CALOTTE_DUPLICATE,        /**< equal points, where these are refused */
  CALOTTE_TOO_FEW_SITES,    /**< too few distinct points, or a hemisphere without generators */
  CALOTTE_DEGENERATE,       /**< all points on one great circle or line */
  CALOTTE_INVALID_ARGUMENT, /**< an argument out of its range */
  CALOTTE_PARSE,            /**< a file violates its format */
  CALOTTE_FILE,             /**< a file cannot be opened, read or written */
  CALOTTE_CANCELLED,        /**< a callback ended the run */
  CALOTTE_INTERNAL,         /**< a bug of the library; please report it */
  CALOTTE_NO_MEMORY         /**< memory is exhausted */
} calotte_status;

/** The error of a function. */
typedef struct calotte_error {
  size_t size;       /**< sizeof(calotte_error) */
  int64_t index;     /**< 0-based index of the offender, or 1-based line of a file; -1 for none */
  char message[512]; /**< one line, ended by 0, with the remedy */
} calotte_error;

/** Initialises an error. */
static inline void calotte_error_init(calotte_error* error) {
  memset(error, 0, sizeof *error);
  error->size = sizeof *error;
}

/** "MAJOR.MINOR.PATCH", for ever valid. */
CALOTTE_C_API const char* calotte_version(void);

/** The threads of later calls of this thread; 0 for all cores, the default. */
CALOTTE_C_API void calotte_set_threads(int count);

/* ---- Surfaces */

/** Values of calotte_surface.kind. */
typedef enum calotte_kind {
  CALOTTE_SPHERE = 0, /**< the unit sphere */
  CALOTTE_PLANE = 1   /**< the plane, in any unit of length */
} calotte_kind;

/** Where points live, as calotte::Surface. Default: the whole sphere. */
typedef struct calotte_surface {
  size_t size;      /**< sizeof(calotte_surface) */
  int64_t kind;     /**< a calotte_kind */
  double period[2]; /**< of a plane in x and y; 0 in a direction without one */
  int64_t rings;    /**< number of closed rings that bound the part; 0: the whole surface */
  /** Of all rings, one after the other: directions on the sphere, where the part lies to the left
   * of every ring, seen from outside; x y in a plane. The last corner is joined to the first. */
  const double* corners;
  const int64_t* begin; /**< rings + 1: ring i has the corners begin[i] to begin[i + 1] - 1 */
} calotte_surface;

/** Initialises a surface. */
static inline void calotte_surface_init(calotte_surface* surface) {
  memset(surface, 0, sizeof *surface);
  surface->size = sizeof *surface;
}

/* ---- Meshes */

/** A triangulation of the sphere or of a plane. */
typedef struct calotte_mesh calotte_mesh;

/** Frees a mesh and all that pointers from it point to. Null is ignored. */
CALOTTE_C_API void calotte_mesh_free(calotte_mesh* mesh);

/** The Delaunay triangulation of n points. Equal points merge.
 * surface: null for the sphere; a plane, whose rings clip the Voronoi cells; or the doubly periodic
 * box [0, period[0]) x [0, period[1]), which the points lie in. Rings on the sphere are
 * CALOTTE_INVALID_ARGUMENT.
 * points: 3 numbers each on the sphere, 2 in a plane; 3 points or more. */
CALOTTE_C_API calotte_status calotte_delaunay(const double* points, int64_t n,
                                              const calotte_surface* surface, calotte_mesh** mesh,
                                              calotte_error* error);

/** The contents of a mesh; the pointers are valid until it is freed. */
typedef struct calotte_triangulation {
  size_t size;                  /**< sizeof(calotte_triangulation) */
  int64_t dimensions;           /**< 3 on the sphere, 2 in a plane */
  int64_t sites;                /**< number of sites */
  int64_t triangles;            /**< number of triangles */
  const double* points;         /**< `dimensions` numbers a site */
  const int32_t* corners;       /**< 3 sites a triangle, counter-clockwise seen from outside */
  const int32_t* neighbours;    /**< 3 a triangle: entry i is across corner i; -1 for none */
  int64_t inputs;               /**< number of input points */
  const int32_t* site_of_input; /**< for each input point its site */
} calotte_triangulation;

/** Initialises a triangulation. */
static inline void calotte_triangulation_init(calotte_triangulation* view) {
  memset(view, 0, sizeof *view);
  view->size = sizeof *view;
}

/** Fills *view. */
CALOTTE_C_API calotte_status calotte_mesh_view(const calotte_mesh* mesh,
                                               calotte_triangulation* view, calotte_error* error);

/** Proves that a mesh is the Delaunay triangulation of its points; of a part of the sphere, that
 * its triangles are well-formed and do not overlap, see calotte::check_surface().
 * CALOTTE_INVALID_ARGUMENT with the violated law in the message if it is not. */
CALOTTE_C_API calotte_status calotte_check(const calotte_mesh* mesh, calotte_error* error);

/** Locates n positions in the triangles of a mesh. An output that is null is not computed for the
 * caller.
 * positions: 3 numbers each on the sphere, 2 in a plane.
 * triangles: n; the lowest triangle that contains the position; -1 outside of an open mesh.
 * weights: 3 n; barycentric weights of the triangle's corners, from 0 to 1; NaN outside.
 * nearest: n; the nearest site, of several the lowest. */
CALOTTE_C_API calotte_status calotte_locate(const calotte_mesh* mesh, const double* positions,
                                            int64_t n, int32_t* triangles, double* weights,
                                            int32_t* nearest, calotte_error* error);

/** A mesh, prepared for many searches, which threads may make at the same time. */
typedef struct calotte_locator calotte_locator;

/** Frees a locator, not its mesh. Null is ignored. */
CALOTTE_C_API void calotte_locator_free(calotte_locator* locator);

/** Prepares a mesh, which must outlive the locator. */
CALOTTE_C_API calotte_status calotte_locator_make(const calotte_mesh* mesh,
                                                  calotte_locator** locator, calotte_error* error);

/** As calotte_locate(), from a triangle near each position.
 * hints: n triangles, such as earlier results; -1 for none. Null: none for all. They change no
 * result in a Delaunay triangulation, and save little time.
 * triangles, weights, nearest: as of calotte_locate(); each may be null. */
CALOTTE_C_API calotte_status calotte_locator_find(const calotte_locator* locator,
                                                  const double* positions, int64_t n,
                                                  const int32_t* hints, int32_t* triangles,
                                                  double* weights, int32_t* nearest,
                                                  calotte_error* error);

/** Finds the k nearest sites of n positions, by distance; those that are equally near by id. Exact
 * in a Delaunay triangulation and in a part of one.
 * k: 1 to the number of sites.
 * sites: n k; those of the first position first. */
CALOTTE_C_API calotte_status calotte_locator_nearest(const calotte_locator* locator,
                                                     const double* positions, int64_t n, int64_t k,
                                                     int32_t* sites, calotte_error* error);

/** Finds the sites within a distance of n positions. Of those whose distance is that up to
 * rounding, some. A first call with null sites gives the room that the second one needs.
 * distance: 0 or more; radians, at most pi, or the unit of the plane.
 * begin: n + 1; position i has the sites begin[i] to begin[i + 1] - 1, ascending. Not null.
 * sites: begin[n], or null. */
CALOTTE_C_API calotte_status calotte_locator_within(const calotte_locator* locator,
                                                    const double* positions, int64_t n,
                                                    double distance, int64_t* begin, int32_t* sites,
                                                    calotte_error* error);

/** Interpolates values at the sites of a mesh to n positions.
 * values: one for each site.
 * positions: as for calotte_locate().
 * natural: 0: linear on each triangle; 1: natural neighbours, smooth except at the sites.
 * out: n; NaN outside of an open mesh. */
CALOTTE_C_API calotte_status calotte_interpolate(const calotte_mesh* mesh, const double* values,
                                                 const double* positions, int64_t n, int natural,
                                                 double* out, calotte_error* error);

/* ---- Weights */

/** Where cells end at the edge of a set of points, as calotte::EdgeCells. */
typedef enum calotte_edge {
  CALOTTE_EDGE_USUAL = 0,      /**< whole around the sphere and in rings, else neighbours */
  CALOTTE_EDGE_WHOLE = 1,      /**< nowhere: Voronoi cells */
  CALOTTE_EDGE_HULL = 2,       /**< at the convex hull of the points */
  CALOTTE_EDGE_NEIGHBOURS = 3, /**< half way to the neighbours, mirrored at their point */
  CALOTTE_EDGE_REACH = 4       /**< all at a distance from their point */
} calotte_edge;

/** The areas of the Voronoi cells of n points; equal points share theirs.
 * points, surface: as for calotte_delaunay(); rings bound the cells, on the sphere, too.
 * edge: a calotte_edge.
 * reach: with CALOTTE_EDGE_REACH, more than 0; an angle of at most pi/2, or a length.
 * weights: n; steradians, or the square of the plane's unit. */
CALOTTE_C_API calotte_status calotte_area_weights(const double* points, int64_t n,
                                                  const calotte_surface* surface, int64_t edge,
                                                  double reach, double* weights,
                                                  calotte_error* error);

/* ---- Voronoi cells */

/** The Voronoi cells of a mesh. */
typedef struct calotte_cells calotte_cells;

/** Frees cells and all that pointers from them point to. Null is ignored. */
CALOTTE_C_API void calotte_cells_free(calotte_cells* cells);

/** The Voronoi cells of a mesh of the whole sphere or of a periodic box, or of a surface with
 * rings, which clip them. */
CALOTTE_C_API calotte_status calotte_voronoi(const calotte_mesh* mesh, calotte_cells** cells,
                                             calotte_error* error);

/** The contents of cells, see calotte::Voronoi; the pointers are valid until they are freed.
 * Cell i has the entries begin[i] to begin[i + 1] - 1 of the next three arrays. -1 stands for a
 * missing cell or edge along a boundary. In a plane the third coordinate is 0. */
typedef struct calotte_tessellation {
  size_t size;                     /**< sizeof(calotte_tessellation) */
  int64_t cells;                   /**< number of cells */
  int64_t edges;                   /**< number of edges */
  int64_t vertices;                /**< number of vertices */
  const double* edge_points;       /**< 3 numbers an edge: the middle of its Delaunay edge */
  const double* vertex_points;     /**< 3 numbers a vertex: circumcentres */
  const int64_t* begin;            /**< cells + 1 */
  const int32_t* edges_on_cell;    /**< by begin */
  const int32_t* vertices_on_cell; /**< by begin */
  const int32_t* cells_on_cell;    /**< by begin: the cell across each edge */
  const int32_t* cells_on_vertex;  /**< 3 a vertex */
  const int32_t* cells_on_edge;    /**< 2 an edge */
  const int32_t* vertices_on_edge; /**< 2 an edge */
  const double* dc;                /**< distance between the two cells of an edge */
  const double* dv;                /**< distance between its two vertices */
  const double* cell_area;         /**< of each cell */
  const double* vertex_area;       /**< of each vertex' triangle */
} calotte_tessellation;

/** Initialises a tessellation. */
static inline void calotte_tessellation_init(calotte_tessellation* view) {
  memset(view, 0, sizeof *view);
  view->size = sizeof *view;
}

/** Fills *view. */
CALOTTE_C_API calotte_status calotte_cells_view(const calotte_cells* cells,
                                                calotte_tessellation* view, calotte_error* error);

/* ---- Grids: centroidal Voronoi tessellations */

/** Sets rho[i] to the density at point i of xyz: 3 numbers, unit vectors on the sphere, x y 0 in a
 * plane. It is 0 or from 1e-150 to 1e150 and depends on the point alone. Many threads call it at
 * once. A result other than 0 ends the run with CALOTTE_CANCELLED. */
typedef int (*calotte_density)(const double* xyz, int64_t n, double* rho, void* data);

/** Called after each iteration; a result other than 0 ends the run there, with its mesh. */
typedef int (*calotte_progress)(int64_t iterations, double residual, void* data);

/** Instead of a number of a recipe: the library chooses, as the member says. */
#define CALOTTE_AUTOMATIC (-1)

/** A request for a grid, see calotte::Recipe, which documents the ranges. Initialised by
 * calotte_recipe_init(), it lacks a number of cells only. A number means itself, also 0. A default
 * other than 0 and null stands in brackets. */
typedef struct calotte_recipe {
  size_t size;         /**< sizeof(calotte_recipe) */
  int64_t initialised; /**< 1, by calotte_recipe_init(): 0 in other members is not a default */
  /** Number of cells, fixed points among them. 0: as many as the widths imply, or of the start's
   * points. */
  int64_t cells;
  const calotte_surface* surface; /**< null: the sphere */
  calotte_density density;        /**< null: uniform, or that of widths */
  void* density_data;             /**< its last argument */
  /** Cell widths: the distances between the centres of neighbouring cells, which set the density.
   * widths_nx times widths_ny numbers, those of the first y first; km on the sphere, in a plane its
   * unit. Bilinear between the nodes, see calotte::Raster. Null:
   * none. */
  const double* widths;
  const double* widths_x; /**< widths_nx, ascending: degrees of longitude; x in a plane */
  const double* widths_y; /**< widths_ny, ascending: degrees of latitude; y in a plane */
  int64_t widths_nx;      /**< >= 2 */
  int64_t widths_ny;      /**< >= 2 */
  double earth_radius_km; /**< of the sphere that the widths refer to; > 0 [6371] */
  /** Generators that stay where they are, the first sites of the mesh: 3 numbers each on the
   * sphere, 2 in a plane. Null: none. */
  const double* fixed;
  int64_t fixed_count;        /**< their number */
  const double* start_points; /**< the other generators at the start, likewise; null: none */
  int64_t start_count;        /**< their number; `cells` is then 0 */
  const char* start;          /**< "automatic" (null), "multilevel", "density", ...: --start */
  const char* norm;           /**< "l2-scaled" (null), "linf", ...: --norm */
  const char* method;         /**< "auto" (null), "lloyd", "lbfgs", ...: --method */
  /** Of the converged grid, 0 to 13. Automatic: those that the starts multilevel and continuation
   * choose, else 0. These starts take no number. [CALOTTE_AUTOMATIC] */
  int64_t bisections;
  /** Of the start multilevel, 1 to 100. Automatic: 1, with fixed points 3. [CALOTTE_AUTOMATIC] */
  int64_t insertion_rounds;
  /** Of the norm, > 0. Automatic: 1e-4 if the run ends well-centred, else 1e-6.
   * [CALOTTE_AUTOMATIC] */
  double tolerance;
  int64_t max_iterations; /**< evaluations of a descent, at most [1000] */
  /** Exactly this number of evaluations of each level, >= 1, instead of norm, tolerance and
   * max_iterations. Automatic: these end the run. [CALOTTE_AUTOMATIC] */
  int64_t iterations;
  /** 1: shapes are brought within the limits of models at the end; 0: they are not. Automatic: 1
   * for the start multilevel unless `iterations` is given, else 0. [CALOTTE_AUTOMATIC] */
  int64_t well_centred;
  double least_spacing; /**< of that end: the least edge over the spacing; 0 to 0.95 [0.83] */
  int64_t seed;         /**< of random points [1] */
  int64_t limited_area; /**< 1: the surface, a part of the sphere, with rings around it, for
                           calotte_write_grid(); requires widths */
  int64_t walls_x;      /**< 1: the box ends at walls in x; see calotte_write_grid() */
  int64_t walls_y;      /**< 1: the same in y */
  int64_t boundary_generators; /**< 1: the mesh of a part of the sphere ends at generators on the
                                  boundary; 0: the boundary clips cells */
  int64_t refuse_duplicates;   /**< 1: equal points of the start are an error; 0: they merge */
  double merge_within; /**< points of the start at most this far apart merge; 0: equal ones */
  /** A file of widths instead of a density and of widths, as the command's --cell-width reads it:
   * rules (.toml), NetCDF (.nc), JIGSAW's spacings (.msh), polygons that have widths (.geojson).
   * Null: none. */
  const char* widths_file;
  double most_off_midpoint; /**< of a well-centred end: the distance between the midpoints of an
                               edge and of its Voronoi edge, over the edge, that has no penalty;
                               above 0, 1: none has one [1] */
} calotte_recipe;

/** Initialises a recipe of `size` bytes, for languages that cannot call inline functions: `size` is
 * that of the caller's struct, which has the first members of this one. */
CALOTTE_C_API void calotte_recipe_init_sized(calotte_recipe* recipe, size_t size);

/** Initialises a recipe. */
static inline void calotte_recipe_init(calotte_recipe* recipe) {
  calotte_recipe_init_sized(recipe, sizeof *recipe);
}

/** The course of a run, as calotte::CvtReport. */
typedef struct calotte_report {
  size_t size;                 /**< sizeof(calotte_report) */
  int64_t converged;           /**< 1 if the norm is at most the tolerance */
  int64_t well_centred;        /**< 1 if a polish brought all shapes within their limits */
  int64_t cells_beyond_limits; /**< after a polish that did not: cells beyond a limit */
  int64_t worst_cell;          /**< the one farthest beyond; -1 for none */
  int64_t iterations;          /**< number of evaluations */
  double residual;             /**< the norm at the end */
  double energy;               /**< at the end */
  double seconds;              /**< wall-clock time */
  /** With boundary_generators: the mesh's outer edges that do not join generators on the boundary;
   * 0 if the mesh ends there. */
  int64_t off_boundary;
} calotte_report;

/** Initialises a report. */
static inline void calotte_report_init(calotte_report* report) {
  memset(report, 0, sizeof *report);
  report->size = sizeof *report;
}

/** Makes the grid of a recipe, as the command `calotte cvt` does.
 * progress: null for none. progress_data: its last argument. report: may be null.
 * A run that does not converge, or that progress ends, is no error: see the report. */
CALOTTE_C_API calotte_status calotte_make_grid(const calotte_recipe* recipe,
                                               calotte_progress progress, void* progress_data,
                                               calotte_mesh** mesh, calotte_report* report,
                                               calotte_error* error);

/** The plan that follows from a recipe, before any generator moves, see calotte::Schedule. The
 * first seven members are those of the caller; calotte_plan() fills the others. */
typedef struct calotte_schedule {
  size_t size; /**< sizeof(calotte_schedule) */
  /** Length of the following five arrays of the caller; a run has at most 31 actions. Each array
   * may be null. calotte_plan() fills them with what the run does, in order. */
  int64_t action_capacity;
  const char** action_kind;   /**< "start", "bisect", "insert", "converge", "polish", "raise" */
  int64_t* action_cells;      /**< number of generators at its end */
  int64_t* action_times;      /**< how often, at most */
  double* action_tolerance;   /**< at which each of its descents ends; 0 for none */
  int64_t* action_iterations; /**< evaluations of each, at most */
  int64_t actions;            /**< number of actions, of which the arrays hold the first */
  int64_t cells;              /**< of the run: with walls or a limited area more than are written;
                                 0 where the start's points are given */
  double implied_cells;       /**< by the widths; 0 without */
  int64_t fixed;              /**< fixed generators, those on the boundary among them */
  int64_t on_boundary;        /**< the last of them, by boundary_generators */
  const char* start;          /**< as calotte_recipe.start; for ever valid */
  const char* first;          /**< how the points of the first level are made, likewise */
  int64_t insertion_rounds;   /**< of the last level */
  int64_t well_centred;       /**< 1 if the run ends so, else 0 */
  double tolerance;           /**< of the norm */
} calotte_schedule;

/** Initialises a schedule. */
static inline void calotte_schedule_init(calotte_schedule* schedule) {
  memset(schedule, 0, sizeof *schedule);
  schedule->size = sizeof *schedule;
}

/** Makes all choices of a recipe, as calotte_make_grid() does before it starts. */
CALOTTE_C_API calotte_status calotte_plan(const calotte_recipe* recipe, calotte_schedule* schedule,
                                          calotte_error* error);

/* ---- Files */

/** Reads a mesh of the sphere or of a plane in any format that calotte::read_mesh() reads. */
CALOTTE_C_API calotte_status calotte_read(const char* path, calotte_mesh** mesh,
                                          calotte_error* error);

/** Writes a mesh in the format of its name (.nc: MPAS).
 * sphere_radius: of NetCDF files, in their unit of length (MPAS: metres); > 0. No effect in a
 * plane. */
CALOTTE_C_API calotte_status calotte_write(const char* path, const calotte_mesh* mesh,
                                           double sphere_radius, calotte_error* error);

/** Writes the grid of a recipe, as the command `calotte cvt` does: of a limited area the cells of
 * the region and of the rings around it, an MPAS file; with walls the cells between them; else the
 * mesh. The file has the density of the recipe.
 * mesh: of calotte_make_grid() with the same recipe. sphere_radius: as for calotte_write(). */
CALOTTE_C_API calotte_status calotte_write_grid(const char* path, const calotte_mesh* mesh,
                                                const calotte_recipe* recipe, double sphere_radius,
                                                calotte_error* error);

#ifdef __cplusplus
}
#endif

#endif
