/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CALOTTE_C_H
#define CALOTTE_C_H

/** \file
 * The library for C, and for languages that call C (Fortran by iso_c_binding, Julia by ccall,
 * Rust).
 *
 * A function returns CALOTTE_OK or a code, and then fills *error, unless that is null; its outputs
 * are unchanged. No C++ exception leaves a function. Points on the sphere are x y z, x y z, ... of
 * any norm; in a plane x y, x y, ... Ids are 0-based. Lengths on the sphere are radians and areas
 * steradians, of the unit sphere. Results have the same bits for any number of threads. Threads may
 * call functions at the same time, also with the same mesh.
 */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __GNUC__
#define CALOTTE_C_API __attribute__((visibility("default")))
#else
#define CALOTTE_C_API
#endif

/** Why a function failed; the values of calotte::ErrorCode, plus 1. */
typedef enum calotte_status {
  CALOTTE_OK = 0,        /**< success */
  CALOTTE_NOT_FINITE,    /**< a coordinate is NaN or infinite */
  CALOTTE_ZERO_VECTOR,   /**< a point at the origin has no direction */
  CALOTTE_DUPLICATE,     /**< equal points, where these are refused */
  CALOTTE_TOO_FEW_SITES, /**< too few distinct points, or a hemisphere without generators */
  CALOTTE_DEGENERATE,    /**< all points on one great circle or line */
  CALOTTE_BAD_OPTION,    /**< an argument out of its range */
  CALOTTE_PARSE,         /**< a file violates its format */
  CALOTTE_FILE,          /**< a file cannot be opened, read or written */
  CALOTTE_CANCELLED,     /**< a callback ended the run */
  CALOTTE_INTERNAL,      /**< a bug of the library; please report it */
  CALOTTE_NO_MEMORY      /**< memory is exhausted */
} calotte_status;

/** The error of a function. */
typedef struct calotte_error {
  int64_t index;     /**< 0-based index of the offender, or 1-based line of a file; -1 for none */
  char message[500]; /**< one line, ended by 0, with the remedy */
} calotte_error;

/** "MAJOR.MINOR.PATCH", for ever valid. */
CALOTTE_C_API const char* calotte_version(void);

/** The threads of later calls of this thread; 0 for all cores, the default. */
CALOTTE_C_API void calotte_set_threads(int count);

/* ---- Meshes */

/** A Delaunay triangulation of the sphere or of a plane. */
typedef struct calotte_mesh calotte_mesh;

/** Frees a mesh and all that pointers from it point to. Null is ignored. */
CALOTTE_C_API void calotte_mesh_free(calotte_mesh* mesh);

/** Triangulates n directions, which merge where they are equal. */
CALOTTE_C_API calotte_status calotte_delaunay(const double* xyz, int64_t n, calotte_mesh** mesh,
                                              calotte_error* error);

/** Triangulates n places in the plane; in the doubly periodic box [0, period_x) x [0, period_y) if
 * both are > 0. */
CALOTTE_C_API calotte_status calotte_delaunay_in_plane(const double* xy, int64_t n, double period_x,
                                                       double period_y, calotte_mesh** mesh,
                                                       calotte_error* error);

/** What a mesh holds; the pointers are valid until it is freed. */
typedef struct calotte_triangulation {
  int dimensions;               /**< 3 on the sphere, 2 in a plane */
  int64_t sites;                /**< number of sites */
  int64_t triangles;            /**< number of triangles */
  const double* points;         /**< dimensions numbers a site */
  const int32_t* corners;       /**< 3 sites a triangle, counter-clockwise seen from outside */
  const int32_t* neighbours;    /**< 3 a triangle: entry i is across corner i; -1 for none */
  int64_t inputs;               /**< number of input points */
  const int32_t* site_of_input; /**< for each input point its site */
} calotte_triangulation;

/** Fills *view. */
CALOTTE_C_API void calotte_mesh_view(const calotte_mesh* mesh, calotte_triangulation* view);

/** Proves that a mesh is the Delaunay triangulation of its points. CALOTTE_BAD_OPTION with the
 * violated law in the message if it is not. */
CALOTTE_C_API calotte_status calotte_check(const calotte_mesh* mesh, calotte_error* error);

/* ---- Voronoi cells */

/** The Voronoi cells of a closed mesh or of a periodic box. */
typedef struct calotte_cells calotte_cells;

/** Frees cells and all that pointers from them point to. Null is ignored. */
CALOTTE_C_API void calotte_cells_free(calotte_cells* cells);

/** Computes the Voronoi cells of a mesh. */
CALOTTE_C_API calotte_status calotte_voronoi(const calotte_mesh* mesh, calotte_cells** cells,
                                             calotte_error* error);

/** What cells hold, as calotte::Voronoi documents it; the pointers are valid until they are freed.
 * Cell i has the entries begin[i] to begin[i + 1] - 1 of the next three arrays. */
typedef struct calotte_tessellation {
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

/** Fills *view. */
CALOTTE_C_API void calotte_cells_view(const calotte_cells* cells, calotte_tessellation* view);

/* ---- Centroidal Voronoi tessellations of the sphere */

/** Sets rho[i] to the density at direction i of xyz (unit vectors). Many threads call it at once. A
 * result other than 0 ends the run with CALOTTE_CANCELLED. */
typedef int (*calotte_density)(const double* xyz, int64_t n, double* rho, void* data);

/** Called after each iteration; a result other than 0 ends the run there, with its mesh. */
typedef int (*calotte_progress)(int64_t iterations, double residual, void* data);

/** Options of a run; see calotte_cvt_defaults(). */
typedef struct calotte_cvt_options {
  calotte_density density;   /**< null: uniform */
  void* density_data;        /**< its last argument */
  calotte_progress progress; /**< null: none */
  void* progress_data;       /**< its last argument */
  double tolerance;   /**< of the rms distance to the centroids over the spacing; 0: the default */
  int64_t iterations; /**< the most of a level; 0: the default, 1000 */
  int64_t seed;       /**< of random points */
  int32_t well_centred; /**< 1: without obtuse triangles and short Voronoi edges */
} calotte_cvt_options;

/** The course of a run, as calotte::CvtReport. */
typedef struct calotte_cvt_report {
  int32_t converged;    /**< 1 if the norm is at most the tolerance */
  int32_t well_centred; /**< 1 if a finish brought all shapes within their limits */
  int64_t iterations;   /**< number of evaluations */
  double residual;      /**< the norm at the end */
  double energy;        /**< at the end */
  double seconds;       /**< wall-clock time */
} calotte_cvt_report;

/** Zeros, and the seed 1. */
CALOTTE_C_API void calotte_cvt_defaults(calotte_cvt_options* options);

/** A grid of `cells` generators, from the start that the command takes: a geodesic one if the
 * density is uniform, otherwise levels with insertion. Report and options may be null. */
CALOTTE_C_API calotte_status calotte_grid(int64_t cells, const calotte_cvt_options* options,
                                          calotte_mesh** mesh, calotte_cvt_report* report,
                                          calotte_error* error);

/** The tessellation that n generators descend to. */
CALOTTE_C_API calotte_status calotte_cvt(const double* xyz, int64_t n,
                                         const calotte_cvt_options* options, calotte_mesh** mesh,
                                         calotte_cvt_report* report, calotte_error* error);

/* ---- Files */

/** Reads a mesh of the sphere in any format that calotte::read_mesh() reads. */
CALOTTE_C_API calotte_status calotte_read(const char* path, calotte_mesh** mesh,
                                          calotte_error* error);

/** Writes a mesh in the format of its name (.nc: MPAS).
 * sphere_radius: of NetCDF files, in their unit of length; 1 in a plane. */
CALOTTE_C_API calotte_status calotte_write(const char* path, const calotte_mesh* mesh,
                                           double sphere_radius, calotte_error* error);

#ifdef __cplusplus
}
#endif

#endif
