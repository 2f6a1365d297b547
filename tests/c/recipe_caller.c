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

static void set_widths(calotte_recipe* recipe, const double* km, const double* x, int64_t nx,
                       const double* y, int64_t ny) {
  recipe->widths = km;
  recipe->widths_x = x;
  recipe->widths_y = y;
  recipe->widths_nx = nx;
  recipe->widths_ny = ny;
}

/* Returns 0 for an unknown name. */
static int recipe_named(const char* name, calotte_recipe* out) {
  calotte_recipe_init(out);
  if (strcmp(name, "uniform") == 0) {
    out->cells = 642;
  } else if (strcmp(name, "x8") == 0) {
    out->cells = 2562;
    out->density = density;
  } else if (strcmp(name, "widths") == 0) {
    set_widths(out, widths_km, width_longitudes, width_columns, width_latitudes, width_rows);
  } else if (strcmp(name, "rules") == 0) {
    out->widths_file = "rules.toml";
  } else if (strcmp(name, "region") == 0) {
    out->cells = 500;
    out->surface = &region;
  } else if (strcmp(name, "limited-area") == 0) {
    out->surface = &small_region;
    set_widths(out, uniform_km, uniform_longitudes, 2, uniform_latitudes, 2);
    out->limited_area = 1;
  } else if (strcmp(name, "plane") == 0) {
    out->cells = 300;
    out->surface = &rectangle;
  } else if (strcmp(name, "box") == 0) {
    out->cells = 400;
    out->surface = &box;
  } else if (strcmp(name, "walls") == 0) {
    out->cells = 300;
    out->surface = &box;
    out->walls_y = 1;
  } else if (strcmp(name, "fixed") == 0) {
    out->cells = 500;
    out->fixed = fixed_directions;
    out->fixed_count = fixed_count;
  } else if (strcmp(name, "points") == 0) {
    out->start_points = start_points;
    out->start_count = start_count;
  } else if (strcmp(name, "pure") == 0) {
    out->cells = 642;
    out->density = density;
    out->well_centred = 0;
    out->tolerance = 1e-3;
  } else if (strcmp(name, "well-centred") == 0) {
    out->cells = 642;
    out->well_centred = 1;
  } else if (strcmp(name, "lloyd") == 0) {
    out->cells = 642;
    out->density = density;
    out->method = "lloyd";
    out->iterations = 20;
  } else {
    return 0;
  }
  return 1;
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
  calotte_error error;
  calotte_triangulation view;
  calotte_mesh* mesh = NULL;
  int i, k, good;
  calotte_error_init(&error);
  calotte_triangulation_init(&view);
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
