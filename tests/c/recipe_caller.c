/* SPDX-License-Identifier: GPL-3.0-or-later
 * Makes a request of tests/grids/recipes_test.py with the interface for C. Usage: recipe_caller
 * REQUEST OUTPUT. The output holds the cells' generators, 3 doubles each, in a plane with z = 0. */
#include "../grids/requests.h"

#include <calotte/c.h>

#include <stdio.h>
#include <string.h>

static int density(const double* xyz, int64_t n, double* rho, void* data) {
  int64_t i;
  (void)data;
  for (i = 0; i < n; ++i)
    rho[i] = request_density(xyz[3 * i + 2]);
  return 0;
}

static const int64_t one_ring[2] = {0, ring_corners}, four_corners[2] = {0, 4};

static calotte_surface region = {
    .size = sizeof(calotte_surface), .rings = 1, .corners = region_ring, .begin = one_ring};
static calotte_surface small_region = {
    .size = sizeof(calotte_surface), .rings = 1, .corners = small_ring, .begin = one_ring};
static calotte_surface rectangle = {.size = sizeof(calotte_surface),
                                    .kind = CALOTTE_PLANE,
                                    .rings = 1,
                                    .corners = rectangle_ring,
                                    .begin = four_corners};
static calotte_surface box = {
    .size = sizeof(calotte_surface), .kind = CALOTTE_PLANE, .period = {2, 1}};

static double start_points[3 * start_count];

/* Returns 0 for an unknown name. */
static int recipe_named(const char* name, calotte_recipe* out) {
  const struct {
    const char* name;
    calotte_recipe recipe;
  } requests[] = {
      {"uniform", {.cells = 642}},
      {"x8", {.cells = 2562, .density = density}},
      {"widths",
       {.widths = widths_km,
        .widths_x = width_longitudes,
        .widths_y = width_latitudes,
        .widths_nx = width_columns,
        .widths_ny = width_rows}},
      {"rules", {.widths_file = "rules.toml"}},
      {"region", {.cells = 500, .surface = &region}},
      {"limited-area",
       {.surface = &small_region,
        .widths = uniform_km,
        .widths_x = uniform_longitudes,
        .widths_y = uniform_latitudes,
        .widths_nx = 2,
        .widths_ny = 2,
        .limited_area = 1}},
      {"plane", {.cells = 300, .surface = &rectangle}},
      {"box", {.cells = 400, .surface = &box}},
      {"walls", {.cells = 300, .surface = &box, .walls_y = 1}},
      {"fixed", {.cells = 500, .fixed = fixed_directions, .fixed_count = fixed_count}},
      {"points", {.start_points = start_points, .start_count = start_count}},
      {"pure", {.cells = 642, .density = density, .well_centred = -1, .tolerance = 1e-3}},
      {"well-centred", {.cells = 642, .well_centred = 1}},
      {"lloyd", {.cells = 642, .density = density, .method = "lloyd", .iterations = 20}},
  };
  size_t i;
  for (i = 0; i < sizeof requests / sizeof *requests; ++i)
    if (strcmp(requests[i].name, name) == 0) {
      *out = requests[i].recipe;
      out->size = sizeof *out;
      return 1;
    }
  return 0;
}

static int write_points(const char* path, const calotte_triangulation* view) {
  FILE* file = fopen(path, "wb");
  int64_t i;
  int good = file != NULL;
  for (i = 0; good && i < view->sites; ++i) {
    double point[3] = {0, 0, 0};
    memcpy(point, view->points + view->dimensions * i, (size_t)view->dimensions * sizeof(double));
    good = fwrite(point, sizeof point, 1, file) == 1;
  }
  return file != NULL && fclose(file) == 0 && good;
}

int main(int argc, char** argv) {
  calotte_recipe recipe;
  calotte_error error = {.size = sizeof error};
  calotte_triangulation view = {.size = sizeof view};
  calotte_mesh* mesh = NULL;
  int i, k, good;
  for (i = 0; i < start_count; ++i)
    for (k = 0; k < 3; ++k)
      start_points[3 * i + k] = start_coordinate(i, k);
  if (argc != 3 || !recipe_named(argv[1], &recipe)) {
    fprintf(stderr, "usage: recipe_caller REQUEST OUTPUT\n");
    return 2;
  }
  good = calotte_make_grid(&recipe, NULL, NULL, &mesh, NULL, &error) == CALOTTE_OK &&
         calotte_mesh_view(mesh, &view, &error) == CALOTTE_OK;
  if (!good)
    fprintf(stderr, "recipe_caller: %s\n", error.message);
  good = good && write_points(argv[2], &view);
  calotte_mesh_free(mesh);
  return good ? 0 : 1;
}
