/* SPDX-License-Identifier: GPL-3.0-or-later
 * Every function of the interface for C: laws and errors. Usage: c_example NAME.nc, a file to
 * write. */
#include <calotte/c.h>

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

static void expect(int holds, const char* what) {
  if (!holds) {
    fprintf(stderr, "c_example: not so: %s\n", what);
    ++failures;
  }
}

static calotte_error error; /* main() initialises it */

static calotte_recipe recipe_of(int64_t cells) {
  calotte_recipe recipe;
  calotte_recipe_init(&recipe);
  recipe.cells = cells;
  return recipe;
}

/* The status is that of a bad option, and the message holds a text. */
static void refuses(calotte_status status, const char* text) {
  const int holds = status == CALOTTE_INVALID_ARGUMENT && strstr(error.message, text) != NULL;
  if (!holds)
    fprintf(stderr, "c_example: status %d: %s\n", (int)status, error.message);
  expect(holds, text);
}

static void succeeds(calotte_status status, const char* what) {
  if (status != CALOTTE_OK)
    fprintf(stderr, "c_example: status %d: %s\n", (int)status, error.message);
  expect(status == CALOTTE_OK, what);
}

static calotte_triangulation view_of(const calotte_mesh* mesh) {
  calotte_triangulation view;
  calotte_triangulation_init(&view);
  succeeds(calotte_mesh_view(mesh, &view, &error), "a view");
  return view;
}

/* The caller frees it. */
static calotte_mesh* mesh_of(const double* points, int64_t n, const calotte_surface* surface,
                             const char* what) {
  calotte_mesh* mesh = NULL;
  succeeds(calotte_delaunay(points, n, surface, &mesh, &error), what);
  return mesh;
}

/* The mesh of a recipe that is complete; the caller frees it. */
static calotte_mesh* grid_of(const calotte_recipe* recipe, const char* what) {
  calotte_mesh* mesh = NULL;
  succeeds(calotte_make_grid(recipe, NULL, NULL, &mesh, NULL, &error), what);
  return mesh;
}

/* Widths differ by two between the hemispheres. */
static int density(const double* xyz, int64_t n, double* rho, void* data) {
  int64_t i;
  (void)data;
  for (i = 0; i < n; ++i)
    rho[i] = xyz[3 * i + 2] > 0 ? 1 : 0.0625;
  return 0;
}

static int cancels(const double* xyz, int64_t n, double* rho, void* data) {
  (void)xyz, (void)n, (void)rho, (void)data;
  return 1;
}

static int count(int64_t iterations, double residual, void* data) {
  (void)iterations, (void)residual;
  ++*(int*)data;
  return 0;
}

static int stop(int64_t iterations, double residual, void* data) {
  (void)residual, (void)data;
  return iterations >= 3;
}

static const int64_t four_corners[2] = {0, 4};
static const double rectangle_ring[8] = {0, 0, 2, 0, 2, 1, 0, 1};
static const double octant_ring[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
static const int64_t three_corners[2] = {0, 3};

static const calotte_surface rectangle = {.size = sizeof(calotte_surface),
                                          .kind = CALOTTE_PLANE,
                                          .rings = 1,
                                          .corners = rectangle_ring,
                                          .begin = four_corners};
static const calotte_surface octant = {
    .size = sizeof(calotte_surface), .rings = 1, .corners = octant_ring, .begin = three_corners};
static const calotte_surface box = {
    .size = sizeof(calotte_surface), .kind = CALOTTE_PLANE, .period = {2, 1}};
static const calotte_surface plane = {.size = sizeof(calotte_surface), .kind = CALOTTE_PLANE};

static const double octahedron[] = {1, 0, 0, -1, 0, 0, 0,  2, 0, 0, -2,
                                    0, 0, 0, 1,  0, 0, -1, 1, 0, 0};
static const double square[] = {0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.4};

static double sum(const double* values, int64_t n) {
  double total = 0;
  int64_t i;
  for (i = 0; i < n; ++i)
    total += values[i];
  return total;
}

/* ---- Meshes */

static void sphere(void) {
  calotte_mesh* mesh = NULL;
  calotte_cells* cells = NULL;
  calotte_triangulation t;
  calotte_tessellation v;
  calotte_tessellation_init(&v);
  mesh = mesh_of(octahedron, 7, NULL, "an octahedron");
  t = view_of(mesh);
  expect(t.dimensions == 3 && t.sites == 6 && t.triangles == 8 && t.inputs == 7, "its counts");
  expect(t.site_of_input[6] == 0, "a duplicate");
  expect(memcmp(t.points, octahedron, 18 * sizeof(double)) == 0, "points keep their bits");
  succeeds(calotte_check(mesh, &error), "check");
  succeeds(calotte_voronoi(mesh, &cells, &error), "cells");
  succeeds(calotte_cells_view(cells, &v, &error), "their view");
  expect(v.edges == 12 && v.vertices == 8 && v.begin[6] == 24, "their counts");
  expect(fabs(sum(v.cell_area, v.cells) - 4 * 3.14159265358979323846) < 1e-12, "their area");
  calotte_cells_free(cells);
  calotte_mesh_free(mesh);
}

static void planes(void) {
  double in_box[64];
  int i;
  calotte_mesh* mesh = NULL;
  calotte_cells* cells = NULL;
  calotte_triangulation t;
  calotte_tessellation v;
  calotte_tessellation_init(&v);
  mesh = mesh_of(square, 5, &plane, "a square");
  t = view_of(mesh);
  expect(t.dimensions == 2 && t.triangles == 4, "its triangles");
  expect(memcmp(t.points, square, sizeof square) == 0, "places keep their bits");
  succeeds(calotte_check(mesh, &error), "check in the plane");
  calotte_mesh_free(mesh);

  for (i = 0; i < 32; ++i) {
    in_box[2 * i] = (i % 8) * 0.25 + (i * 7 % 5) * 0.03;
    in_box[2 * i + 1] = (i / 8) * 0.25 + (i * 3 % 7) * 0.02;
  }
  mesh = mesh_of(in_box, 32, &box, "a box");
  t = view_of(mesh);
  expect(t.sites == 32 && t.triangles == 64, "its triangles");
  succeeds(calotte_voronoi(mesh, &cells, &error), "cells of a box");
  succeeds(calotte_cells_view(cells, &v, &error), "their view");
  expect(fabs(sum(v.cell_area, v.cells) - 2) < 1e-12, "their area is that of the box");
  calotte_cells_free(cells);
  calotte_mesh_free(mesh);

  mesh = mesh_of(in_box, 32, &rectangle, "a rectangle");
  succeeds(calotte_voronoi(mesh, &cells, &error), "clipped cells");
  succeeds(calotte_cells_view(cells, &v, &error), "their view");
  expect(fabs(sum(v.cell_area, v.cells) - 2) < 1e-12, "their area is that of the rectangle");
  calotte_cells_free(cells);
  calotte_mesh_free(mesh);
}

static void surfaces(void) {
  const int64_t falling[2] = {3, 0};
  calotte_mesh* mesh = NULL;
  calotte_surface surface;
  calotte_surface_init(&surface);
  mesh = mesh_of(octahedron, 6, &surface, "the default is the sphere");
  expect(view_of(mesh).dimensions == 3, "its dimensions");
  calotte_mesh_free(mesh);
  mesh = NULL;
  surface.kind = 7;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "CALOTTE_PLANE");
  surface.kind = CALOTTE_SPHERE;
  surface.period[1] = 1;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "a period is that of a plane");
  refuses(calotte_delaunay(octahedron, 6, &octant, &mesh, &error), "leave out the rings");
  surface = rectangle;
  surface.period[0] = 1;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "rings bound the whole");
  surface = rectangle;
  surface.begin = falling;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "ring 0 begins at corner 3");
  surface.begin = NULL;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "null pointer");
  surface = rectangle;
  surface.rings = -1;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "number of rings");
  surface = box;
  surface.period[0] = -1;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error), "give two lengths");
  surface.size = 0;
  refuses(calotte_delaunay(square, 5, &surface, &mesh, &error),
          "initialise the surface with calotte_surface_init()");
  expect(mesh == NULL, "outputs stay unchanged");
}

static void searches(void) {
  const double at[] = {1, 1, 1, 3, 0, 0, -1, 2, -3}, bad[] = {0, 0, 0};
  int32_t triangles[3], again[3], nearest[3], sites[18];
  const int32_t far[] = {-1, 5, 7}, wrong[] = {0, 8, 0};
  int64_t begin[4];
  calotte_mesh* mesh = mesh_of(octahedron, 6, NULL, "an octahedron");
  calotte_locator* locator = NULL;
  int i;
  succeeds(calotte_locator_make(mesh, &locator, &error), "prepare");
  succeeds(calotte_locate(mesh, at, 3, triangles, NULL, nearest, &error), "locate");
  succeeds(calotte_locator_find(locator, at, 3, far, again, NULL, NULL, &error), "with hints");
  for (i = 0; i < 3; ++i)
    expect(again[i] == triangles[i], "hints change nothing");
  succeeds(calotte_locator_find(locator, at, 3, NULL, again, NULL, NULL, &error), "no hints");
  succeeds(calotte_locator_nearest(locator, at, 3, 6, sites, &error), "six nearest");
  for (i = 0; i < 3; ++i)
    expect(sites[6 * i] == nearest[i], "the nearest first");
  expect(sites[0] + sites[1] + sites[2] == 0 + 2 + 4 && sites[0] < sites[1], "ties by id");
  succeeds(calotte_locator_within(locator, at, 3, 1.1, begin, NULL, &error), "count");
  expect(begin[0] == 0 && begin[1] == 3 && begin[2] == 4 && begin[3] == 6, "those within 1.1");
  succeeds(calotte_locator_within(locator, at, 3, 1.1, begin, sites, &error), "within");
  expect(sites[0] == 0 && sites[1] == 2 && sites[2] == 4 && sites[3] == 0, "ascending");
  refuses(calotte_locator_find(locator, at, 3, wrong, again, NULL, NULL, &error), "hint 1 is 8");
  refuses(calotte_locator_nearest(locator, at, 3, 7, sites, &error), "k is 7");
  refuses(calotte_locator_nearest(locator, at, 3, 0, sites, &error), "k is 0");
  refuses(calotte_locator_nearest(locator, at, 3, 1, NULL, &error), "null pointer");
  refuses(calotte_locator_within(locator, at, 3, 4, begin, sites, &error), "at most pi");
  refuses(calotte_locator_within(locator, at, 3, 1, NULL, NULL, &error), "null pointer");
  refuses(calotte_locator_find(NULL, at, 3, NULL, NULL, NULL, NULL, &error), "null pointer");
  refuses(calotte_locator_make(NULL, &locator, &error), "null pointer");
  refuses(calotte_locator_make(mesh, NULL, &error), "null");
  expect(calotte_locator_find(locator, bad, 1, NULL, NULL, NULL, NULL, &error) ==
             CALOTTE_ZERO_VECTOR,
         "the zero vector");
  calotte_locator_free(locator);
  calotte_locator_free(NULL);
  calotte_mesh_free(mesh);
}

static void area_weights(void) {
  const double pi = 3.14159265358979323846;
  double weights[7], points[21];
  memcpy(points, octahedron, 18 * sizeof(double));
  memcpy(points + 18, octahedron, 3 * sizeof(double));
  succeeds(calotte_area_weights(points, 7, NULL, 0, 0, weights, &error), "weights");
  expect(fabs(sum(weights, 7) - 4 * pi) < 1e-14 && weights[6] == weights[0] &&
             fabs(weights[1] / weights[0] - 2) < 1e-14,
         "the sphere, with a point twice");
  succeeds(calotte_area_weights(points, 6, NULL, CALOTTE_EDGE_REACH, 0.5, weights, &error),
           "discs");
  expect(fabs(weights[3] - 2 * pi * (1 - cos(0.5))) < 1e-15, "discs apart");
  succeeds(calotte_area_weights(square, 5, &plane, CALOTTE_EDGE_HULL, 0, weights, &error), "plane");
  expect(fabs(sum(weights, 5) - 1) < 1e-15, "a square");
  refuses(calotte_area_weights(points, 6, NULL, 5, 0, weights, &error), "edge is 5");
  refuses(calotte_area_weights(points, 6, NULL, 0, 0, NULL, &error), "null pointer");
  refuses(calotte_area_weights(points, 6, NULL, CALOTTE_EDGE_REACH, 0, weights, &error), "reach");
}

static void positions(void) {
  const double at[] = {1, 1, 1, 3, 0, 0, -1, 2, -3}, outside[] = {0.25, 0.25, 5, 5};
  double values[6], weights[9], out[3];
  int32_t triangles[3], nearest[3];
  calotte_mesh* mesh = NULL;
  int i;
  mesh = mesh_of(octahedron, 6, NULL, "an octahedron");
  succeeds(calotte_locate(mesh, at, 3, triangles, weights, nearest, &error), "locate");
  for (i = 0; i < 3; ++i)
    expect(triangles[i] >= 0 && triangles[i] < 8 && fabs(sum(weights + 3 * i, 3) - 1) < 1e-15,
           "weights sum to 1");
  expect(fabs(weights[0] - 1. / 3) < 1e-15 && nearest[0] == 0, "the middle of a triangle");
  expect(nearest[1] == 0 && weights[3] + weights[4] + weights[5] == 1, "a site");
  expect(nearest[2] == 5, "the nearest site");
  succeeds(calotte_locate(mesh, at, 3, NULL, NULL, NULL, &error), "outputs may be null");
  succeeds(calotte_locate(mesh, NULL, 0, NULL, NULL, NULL, &error), "no position");
  for (i = 0; i < 6; ++i)
    values[i] = i;
  succeeds(calotte_interpolate(mesh, values, at, 3, 0, out, &error), "interpolate");
  expect(out[1] == 0 && fabs(out[0] - (0 + 2 + 4) / 3.) < 1e-14, "linear on a triangle");
  succeeds(calotte_interpolate(mesh, values, octahedron, 3, 1, out, &error), "natural neighbours");
  expect(out[0] == 0 && out[1] == 1 && out[2] == 2, "exact at sites");
  refuses(calotte_interpolate(mesh, NULL, at, 3, 0, out, &error), "null pointer");
  refuses(calotte_interpolate(mesh, values, at, 3, 2, out, &error), "natural is 2");
  refuses(calotte_locate(mesh, NULL, 3, triangles, NULL, NULL, &error), "null pointer");
  refuses(calotte_locate(NULL, at, 3, triangles, NULL, NULL, &error), "null pointer");
  calotte_mesh_free(mesh);

  mesh = mesh_of(square, 5, &plane, "a square");
  succeeds(calotte_locate(mesh, outside, 2, triangles, weights, nearest, &error), "in the plane");
  expect(triangles[0] >= 0 && triangles[1] == -1 && isnan(weights[3]) && nearest[1] == 3,
         "a position outside");
  for (i = 0; i < 5; ++i)
    values[i] = 3 * square[2 * i] - square[2 * i + 1];
  for (i = 0; i < 2; ++i) {
    succeeds(calotte_interpolate(mesh, values, outside, 2, i, out, &error), "interpolate");
    expect(fabs(out[0] - 0.5) < 1e-14 && isnan(out[1]), "exact for linear functions; NaN outside");
  }
  calotte_mesh_free(mesh);
}

/* ---- Structs of other sizes */

static const char uninitialised[] = "initialise the recipe with calotte_recipe_init()";

/* Sizes of recipes that no initialised one has. */
static void recipe_sizes(void) {
  struct {
    calotte_recipe recipe;
    double newer;
  } later;
  calotte_recipe recipe = {.size = 0, .cells = 42};
  calotte_mesh* mesh = NULL;
  refuses(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error), uninitialised);
  recipe.size = (size_t)-1;
  refuses(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error), uninitialised);
  recipe.size = sizeof recipe;
  refuses(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error), uninitialised);
  refuses(calotte_make_grid(NULL, NULL, NULL, &mesh, NULL, &error), "calotte_recipe is null");
  calotte_recipe_init_sized(NULL, sizeof recipe);
  calotte_recipe_init_sized(&recipe, 0);
  expect(recipe.size == sizeof recipe, "no size, no struct");

  memset(&later, 1, sizeof later);
  calotte_recipe_init_sized(&later.recipe, sizeof later);
  expect(later.recipe.size == sizeof later && later.newer == 0 && later.recipe.seed == 1,
         "a longer struct is initialised");
  later.recipe.cells = 42;
  calotte_mesh_free(grid_of(&later.recipe, "members of a longer struct may be 0"));
  later.newer = 1;
  refuses(calotte_make_grid(&later.recipe, NULL, NULL, &mesh, NULL, &error), "beyond the");
  expect(mesh == NULL, "outputs stay unchanged");
}

/* The recipe of an older header, which lacks the last members. */
static void shorter_recipes(void) {
  calotte_recipe today = recipe_of(100), old;
  calotte_mesh *one = NULL, *two = NULL;
  calotte_triangulation a, b;
  memset(&old, 1, sizeof old);
  calotte_recipe_init_sized(&old, offsetof(calotte_recipe, widths_file));
  expect(old.seed == 1 && old.widths_file != NULL, "what it has is initialised, and no more");
  old.cells = 100;
  one = grid_of(&old, "a file beyond the struct is not read");
  two = grid_of(&today, "the same");
  a = view_of(one);
  b = view_of(two);
  expect(memcmp(a.points, b.points, 300 * sizeof(double)) == 0, "has the same bits");
  calotte_mesh_free(one);
  calotte_mesh_free(two);
  old = (calotte_recipe){.size = offsetof(calotte_recipe, widths_file), .cells = 100};
  one = NULL;
  refuses(calotte_make_grid(&old, NULL, NULL, &one, NULL, &error), uninitialised);
}

static void other_sizes(void) {
  calotte_recipe recipe = recipe_of(42);
  calotte_error brief = {.size = offsetof(calotte_error, message) + 8, .message = "unchanged text"};
  calotte_triangulation view = {.size = offsetof(calotte_triangulation, triangles),
                                .triangles = -7};
  calotte_mesh* mesh = grid_of(&recipe, "a number of cells is a request");
  succeeds(calotte_mesh_view(mesh, &view, &error), "a short view");
  expect(view.sites == 42 && view.triangles == -7, "the library writes what fits");
  view.size = 0;
  refuses(calotte_mesh_view(mesh, &view, &error),
          "initialise the triangulation with calotte_triangulation_init()");
  calotte_mesh_free(mesh);
  mesh = NULL;
  expect(calotte_make_grid(NULL, NULL, NULL, &mesh, NULL, &brief) == CALOTTE_INVALID_ARGUMENT &&
             strlen(brief.message) == 7 && strcmp(brief.message + 8, " text") != 0,
         "a short message");
  expect(strcmp(brief.message + 10, "text") == 0, "nothing beyond it is written");
  brief.size = 0;
  expect(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &brief) == CALOTTE_INVALID_ARGUMENT &&
             mesh == NULL,
         "an error without a size");
}

/* ---- Grids */

static void runs(void) {
  calotte_recipe recipe = recipe_of(642);
  calotte_report report;
  calotte_mesh *mesh = NULL, *again = NULL;
  calotte_triangulation a, b;
  int calls = 0;
  calotte_report_init(&report);
  succeeds(calotte_make_grid(&recipe, count, &calls, &mesh, &report, &error), "a uniform grid");
  expect(report.converged && calls > 1 && report.iterations >= calls, "its report");
  expect(report.residual <= 1e-6 && report.energy > 0 && report.worst_cell == -1, "its numbers");
  a = view_of(mesh);
  expect(a.sites == 642 && a.triangles == 1280, "its counts");
  calotte_mesh_free(mesh);

  recipe.cells = 1000;
  recipe.density = density;
  calotte_set_threads(1);
  succeeds(calotte_make_grid(&recipe, NULL, NULL, &mesh, &report, &error), "a graded grid");
  expect(report.well_centred == 1 && report.cells_beyond_limits == 0, "it is well-centred");
  calotte_set_threads(2);
  again = grid_of(&recipe, "the same with two threads");
  calotte_set_threads(0);
  a = view_of(mesh);
  b = view_of(again);
  expect(a.sites == 1000 && memcmp(a.points, b.points, 3000 * sizeof(double)) == 0, "same bits");
  calotte_mesh_free(again);

  recipe.cells = 0;
  recipe.start_points = a.points;
  recipe.start_count = a.sites;
  succeeds(calotte_make_grid(&recipe, stop, NULL, &again, &report, &error), "an early end");
  expect(report.iterations >= 3 && report.iterations < 9 && !report.converged, "its report");
  calotte_mesh_free(again);
  again = NULL;
  recipe.density = cancels;
  expect(calotte_make_grid(&recipe, NULL, NULL, &again, NULL, &error) == CALOTTE_CANCELLED &&
             again == NULL,
         "a density that ends the run");
  report.size = 0;
  refuses(calotte_make_grid(&recipe, NULL, NULL, &again, &report, &error),
          "initialise the report with calotte_report_init()");
  refuses(calotte_make_grid(&recipe, NULL, NULL, NULL, NULL, &error), "receives the mesh");
  calotte_mesh_free(mesh);
}

static void recipes(void) {
  const double fixed[] = {0.5, 0.5, 1.5, 0.5};
  calotte_recipe recipe = recipe_of(60);
  calotte_mesh* mesh = NULL;
  calotte_triangulation view;
  recipe.surface = &rectangle;
  recipe.fixed = fixed;
  recipe.fixed_count = 2;
  mesh = grid_of(&recipe, "fixed points in a rectangle");
  view = view_of(mesh);
  expect(view.sites == 60 && view.dimensions == 2, "its cells");
  expect(memcmp(view.points, fixed, sizeof fixed) == 0, "fixed points are the first sites");
  calotte_mesh_free(mesh);

  recipe = recipe_of(100);
  recipe.surface = &octant;
  mesh = grid_of(&recipe, "a part of the sphere");
  expect(view_of(mesh).sites == 100, "its cells");
  succeeds(calotte_check(mesh, &error), "its triangles");
  calotte_mesh_free(mesh);
}

static void refused_recipes(void) {
  const double fixed[] = {0.5, 0.5, 1.5, 0.5};
  calotte_recipe recipe = recipe_of(0);
  calotte_mesh* mesh = NULL;
  refuses(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error), "no number of cells");
#define REFUSES(MEMBER, VALUE, TEXT)                                                               \
  recipe = recipe_of(100);                                                                         \
  recipe.MEMBER = VALUE;                                                                           \
  refuses(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error), TEXT)
  REFUSES(cells, -1, "-1");
  REFUSES(start, "somewhere", "'somewhere'; give one of automatic, points, multilevel");
  REFUSES(norm, "l3", "'l3'; give one of l2, linf");
  REFUSES(method, "newton", "'newton'; give one of auto, lloyd");
  REFUSES(bisections, -2, "bisections");
  REFUSES(bisections, 5000000000, "5000000000");
  REFUSES(insertion_rounds, -2, "rounds of insertion");
  REFUSES(tolerance, -2, "tolerance");
  REFUSES(max_iterations, -1, "iterations");
  REFUSES(iterations, -2, "iterations");
  REFUSES(insertion_rounds, 0, "rounds of insertion is 0; give 1 to 100");
  REFUSES(tolerance, 0, "tolerance");
  REFUSES(iterations, 0, "iterations is 0; give 1 or more");
  REFUSES(well_centred, 2, "well_centred is 2; give 0 or 1");
  REFUSES(least_spacing, 1, "spacing");
  REFUSES(most_off_midpoint, 0, "most_off_midpoint is 0; give a share");
  REFUSES(limited_area, 1, "limited area");
  REFUSES(limited_area, 2, "limited_area is 2; give 0 or 1");
  REFUSES(walls_x, 1, "walls");
  REFUSES(walls_y, -1, "walls_y is -1");
  REFUSES(boundary_generators, 1, "give the rings");
  REFUSES(refuse_duplicates, 2, "refuse_duplicates is 2");
  REFUSES(merge_within, -1, "merge");
  REFUSES(fixed_count, 1, "the fixed points are a null pointer");
  REFUSES(start_count, -1, "number of points is -1");
  REFUSES(widths, fixed, "widths_x and widths_y");
  REFUSES(widths_nx, 2, "null pointer");
#undef REFUSES
  double
      twice[45]; /* the corners of a cube, and of an octahedron, the last of which is there twice */
  for (int i = 0; i < 24; ++i)
    twice[i] = (i / 3) >> (i % 3) & 1 ? 1 : -1;
  memcpy(twice + 24, octahedron, 21 * sizeof *twice);
  recipe = recipe_of(0);
  recipe.start_points = twice;
  recipe.start_count = 15;
  recipe.refuse_duplicates = 1;
  expect(calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error) == CALOTTE_DUPLICATE &&
             error.index == 14,
         "equal points are refused");
  expect(mesh == NULL, "outputs stay unchanged");
}

/* Numbers that the caller gives mean themselves, also 0. */
static void zeros(void) {
  calotte_recipe recipe = recipe_of(100), other = recipe;
  calotte_report report;
  calotte_schedule schedule;
  calotte_mesh *one = NULL, *two = NULL;
  calotte_triangulation a, b;
  calotte_report_init(&report);
  calotte_schedule_init(&schedule);
  recipe.start = other.start = "random";
  other.seed = 0;
  one = grid_of(&recipe, "the seed 1");
  two = grid_of(&other, "the seed 0");
  a = view_of(one);
  b = view_of(two);
  expect(memcmp(a.points, b.points, 300 * sizeof(double)) != 0, "other random points");
  calotte_mesh_free(one);
  calotte_mesh_free(two);

  recipe = recipe_of(200);
  recipe.surface = &octant;
  recipe.density = density;
  succeeds(calotte_plan(&recipe, &schedule, &error), "a plan");
  expect(strcmp(schedule.start, "multilevel") == 0 && schedule.well_centred == 1, "its start");
  other = recipe;
  other.bisections = 0;
  succeeds(calotte_plan(&other, &schedule, &error), "no bisections");
  expect(strcmp(schedule.start, "density") == 0, "exclude the start multilevel");
  other = recipe;
  other.well_centred = 0;
  succeeds(calotte_plan(&other, &schedule, &error), "a pure CVT");
  expect(schedule.well_centred == 0 && schedule.tolerance == 1e-6, "its end");

  recipe.surface = NULL;
  one = grid_of(&recipe, "the least spacing 0.83");
  other = recipe;
  other.least_spacing = 0;
  two = grid_of(&other, "any spacing");
  a = view_of(one);
  b = view_of(two);
  expect(memcmp(a.points, b.points, 600 * sizeof(double)) != 0, "moves other generators");
  calotte_mesh_free(one);
  calotte_mesh_free(two);

  recipe.start = "density";
  recipe.well_centred = recipe.max_iterations = 0;
  succeeds(calotte_make_grid(&recipe, NULL, NULL, &one, &report, &error), "no evaluation");
  expect(report.iterations == 0 && !report.converged, "its report");
  calotte_mesh_free(one);
}

static void plans(void) {
  const double x[] = {0, 180}, y[] = {-90, 0, 90}, km[] = {300, 300, 400, 400, 500, 500};
  const char* kind[31];
  int64_t cells[31], times[31], iterations[31];
  double tolerance[31];
  calotte_recipe recipe = recipe_of(0);
  calotte_schedule schedule;
  recipe.widths = km;
  recipe.widths_x = x;
  recipe.widths_y = y;
  recipe.widths_nx = 2;
  recipe.widths_ny = 3;
  calotte_schedule_init(&schedule);
  schedule.action_capacity = 31;
  schedule.action_kind = kind;
  schedule.action_cells = cells;
  schedule.action_times = times;
  schedule.action_tolerance = tolerance;
  schedule.action_iterations = iterations;
  succeeds(calotte_plan(&recipe, &schedule, &error), "a plan");
  expect(schedule.actions >= 5 && schedule.actions <= 31, "its actions");
  expect(strcmp(kind[0], "start") == 0, "the first action");
  expect(strcmp(kind[schedule.actions - 1], "raise") == 0, "the last action");
  expect(cells[schedule.actions - 1] == schedule.cells, "the last action has the cells");
  expect(fabs((double)schedule.cells - schedule.implied_cells) <= 0.5, "as many as implied");
  expect(strcmp(schedule.start, "multilevel") == 0 && schedule.first != NULL, "its start");
  expect(schedule.insertion_rounds == 1 && times[schedule.actions - 4] == 1, "its rounds");
  expect(schedule.well_centred == 1 && schedule.tolerance == 1e-4, "its end");
  expect(tolerance[0] > 0 && iterations[0] > 0 && schedule.fixed == 0, "its descents");
  schedule.action_capacity = 0;
  cells[0] = -7;
  succeeds(calotte_plan(&recipe, &schedule, &error), "a plan without actions");
  expect(cells[0] == -7 && schedule.actions >= 5, "no array is filled beyond its length");
  recipe.earth_radius_km = 6371. / 2;
  succeeds(calotte_plan(&recipe, &schedule, &error), "half the radius");
  expect(fabs(schedule.implied_cells * 4 - (double)schedule.cells * 4) <= 2, "a quarter of cells");
  recipe.earth_radius_km = 0;
  refuses(calotte_plan(&recipe, &schedule, &error), "radius");
  recipe.earth_radius_km = 6371;
  recipe.density = density;
  refuses(calotte_plan(&recipe, &schedule, &error), "several of a density, widths");
  recipe.density = NULL;
  schedule.action_capacity = -1;
  refuses(calotte_plan(&recipe, &schedule, &error), "action_capacity");
  schedule.size = 0;
  refuses(calotte_plan(&recipe, &schedule, &error),
          "initialise the schedule with calotte_schedule_init()");
}

static void put(const char* path, const char* text) {
  FILE* file = fopen(path, "w");
  expect(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0, "a file of text");
}

/* A file of rules says the same as in the command. */
static void rules(void) {
  calotte_recipe recipe = recipe_of(0);
  calotte_schedule schedule;
  calotte_schedule_init(&schedule);
  recipe.widths_file = "c_example.toml";
  put("c_example.toml", "[cell-width]\nby-latitude = [[-90, 600], [0, 300], [90, 600]]\n");
  succeeds(calotte_plan(&recipe, &schedule, &error), "rules");
  expect(schedule.cells > 2000 && schedule.cells < 6545, "cells of 300 to 600 km");
  put("c_example_part.geojson", "{\"type\": \"Polygon\", \"coordinates\": "
                                "[[[0, 0], [60, 0], [0, 60], [0, 0]]]}");
  put("c_example.toml", "[cell-width]\nwidth = 300\nwithin = \"c_example_part.geojson\"\n");
  refuses(calotte_plan(&recipe, &schedule, &error), "no rule gives a width at longitude");
  recipe.widths_file = "absent.toml";
  expect(calotte_plan(&recipe, &schedule, &error) != CALOTTE_OK &&
             strstr(error.message, "absent.toml") != NULL,
         "a file that is not there");
}

/* ---- Files */

static void files(const char* path) {
  const double x[] = {0, 180}, y[] = {-90, 90}, km[] = {600, 600, 600, 600};
  calotte_recipe recipe = recipe_of(642);
  calotte_mesh *mesh = NULL, *read = NULL;
  calotte_triangulation a, b;
  mesh = grid_of(&recipe, "a uniform grid");
  a = view_of(mesh);
  succeeds(calotte_write(path, mesh, 6371229, &error), "write");
  succeeds(calotte_read(path, &read, &error), "read");
  b = view_of(read);
  expect(a.sites == 642 && a.triangles == b.triangles, "the file's mesh");
  calotte_mesh_free(read);
  succeeds(calotte_write_grid(path, mesh, &recipe, 1, &error), "a grid of the whole sphere");
  refuses(calotte_write(path, mesh, 0, &error), "radius");
  refuses(calotte_write(NULL, mesh, 1, &error), "null pointer");
  refuses(calotte_write(path, NULL, 1, &error), "null pointer");
  refuses(calotte_write_grid(path, mesh, NULL, 1, &error), "calotte_recipe is null");

  recipe.cells = 0;
  recipe.surface = &octant;
  recipe.widths = km;
  recipe.widths_x = x;
  recipe.widths_y = y;
  recipe.widths_nx = recipe.widths_ny = 2;
  recipe.limited_area = 1;
  refuses(calotte_write_grid(path, mesh, &recipe, 1, &error), "another surface");
  calotte_mesh_free(mesh);
  mesh = grid_of(&recipe, "a limited area");
  succeeds(calotte_write_grid(path, mesh, &recipe, 1, &error), "its file");
  read = NULL;
  succeeds(calotte_read(path, &read, &error), "which is read");
  expect(view_of(read).sites < view_of(mesh).sites, "cells beyond the rings are left out");
  calotte_mesh_free(read);
  refuses(calotte_write_grid("area.vtp", mesh, &recipe, 1, &error), "give a name that ends in .nc");
  calotte_mesh_free(mesh);

  recipe = recipe_of(200);
  recipe.surface = &box;
  recipe.walls_y = 1;
  mesh = grid_of(&recipe, "a box with walls");
  expect(view_of(mesh).sites > 200, "the gap beyond them has cells");
  succeeds(calotte_write_grid(path, mesh, &recipe, 1, &error), "its file");
  calotte_mesh_free(mesh);
}

static void errors(void) {
  double xyz[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  calotte_mesh* mesh = NULL;
  calotte_cells* cells = NULL;
  xyz[4] = nan("");
  expect(calotte_delaunay(xyz, 4, NULL, &mesh, &error) == CALOTTE_NOT_FINITE && error.index == 1,
         "NaN");
  xyz[4] = 1;
  expect(calotte_delaunay(xyz, 4, NULL, &mesh, &error) == CALOTTE_ZERO_VECTOR && error.index == 3,
         "a point at the origin");
  expect(calotte_delaunay(xyz, 2, NULL, &mesh, &error) == CALOTTE_TOO_FEW_SITES, "2 points");
  refuses(calotte_delaunay(NULL, 3, NULL, &mesh, &error), "the points are a null pointer");
  refuses(calotte_delaunay(xyz, -1, NULL, &mesh, &error), "-1");
  refuses(calotte_delaunay(xyz, 3, NULL, NULL, &error), "receives the mesh");
  expect(calotte_delaunay(xyz, -1, NULL, &mesh, NULL) == CALOTTE_INVALID_ARGUMENT,
         "without an error");
  expect(calotte_read("no such file.nc", &mesh, &error) == CALOTTE_FILE, "no file");
  expect(strstr(error.message, "no such file.nc") != NULL, "a message with its name");
  refuses(calotte_voronoi(mesh, &cells, &error), "null pointer");
  refuses(calotte_mesh_view(mesh, NULL, &error), "null pointer");
  refuses(calotte_cells_view(cells, NULL, &error), "null pointer");
  refuses(calotte_check(mesh, &error), "null pointer");
  expect(mesh == NULL && cells == NULL, "outputs stay unchanged");
  calotte_mesh_free(NULL);
  calotte_cells_free(NULL);
}

int main(int argc, char** argv) {
  if (argc != 2 || strlen(calotte_version()) < 5)
    return 2;
  calotte_error_init(&error);
  sphere();
  planes();
  surfaces();
  positions();
  searches();
  area_weights();
  recipe_sizes();
  shorter_recipes();
  other_sizes();
  runs();
  recipes();
  refused_recipes();
  zeros();
  plans();
  rules();
  files(argv[1]);
  errors();
  return failures != 0;
}
