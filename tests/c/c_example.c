/* SPDX-License-Identifier: GPL-3.0-or-later
 * Every function of the interface for C. Usage: c_example NAME.nc, a file to write. */
#include <calotte/c.h>

#include <math.h>
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

/* Widths differ by two between the hemispheres. */
static int density(const double* xyz, int64_t n, double* rho, void* data) {
  int64_t i;
  (void)data;
  for (i = 0; i < n; ++i)
    rho[i] = xyz[3 * i + 2] > 0 ? 1 : 0.0625;
  return 0;
}

static int refuses(const double* xyz, int64_t n, double* rho, void* data) {
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

static void octahedron(void) {
  const double xyz[] = {1, 0, 0, -1, 0, 0, 0, 2, 0, 0, -2, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0};
  calotte_mesh* mesh = NULL;
  calotte_cells* cells = NULL;
  calotte_error error;
  calotte_triangulation t;
  calotte_tessellation v;
  double area = 0;
  int64_t i;
  expect(calotte_delaunay(xyz, 7, &mesh, &error) == CALOTTE_OK, "an octahedron");
  calotte_mesh_view(mesh, &t);
  expect(t.dimensions == 3 && t.sites == 6 && t.triangles == 8 && t.inputs == 7, "its counts");
  expect(t.site_of_input[6] == 0, "a duplicate");
  expect(memcmp(t.points, xyz, 18 * sizeof(double)) == 0, "points keep their bits");
  expect(calotte_check(mesh, &error) == CALOTTE_OK, "check");
  expect(calotte_voronoi(mesh, &cells, &error) == CALOTTE_OK, "cells");
  calotte_cells_view(cells, &v);
  for (i = 0; i < v.cells; ++i)
    area += v.cell_area[i];
  expect(v.edges == 12 && v.vertices == 8 && v.begin[6] == 24, "their counts");
  expect(fabs(area - 4 * 3.14159265358979323846) < 1e-12, "their area");
  calotte_cells_free(cells);
  calotte_mesh_free(mesh);
}

static void plane(void) {
  const double xy[] = {0, 0, 1, 0, 0, 1, 1, 1, 0.5, 0.4};
  calotte_mesh* mesh = NULL;
  calotte_triangulation t;
  expect(calotte_delaunay_in_plane(xy, 5, 0, 0, &mesh, NULL) == CALOTTE_OK, "a square");
  calotte_mesh_view(mesh, &t);
  expect(t.dimensions == 2 && t.triangles == 4, "its triangles");
  calotte_mesh_free(mesh);
}

static void grids(const char* path) {
  calotte_cvt_options options;
  calotte_cvt_report report;
  calotte_mesh *mesh = NULL, *read = NULL, *again = NULL;
  calotte_triangulation a, b;
  calotte_error error;
  int calls = 0;
  calotte_cvt_defaults(&options);
  options.progress = count;
  options.progress_data = &calls;
  expect(calotte_grid(642, &options, &mesh, &report, &error) == CALOTTE_OK, "a uniform grid");
  expect(report.converged && calls > 1, "its report");
  expect(calotte_write(path, mesh, 6371229, &error) == CALOTTE_OK, "write");
  expect(calotte_read(path, &read, &error) == CALOTTE_OK, "read");
  calotte_mesh_view(mesh, &a);
  calotte_mesh_view(read, &b);
  expect(a.sites == 642 && a.triangles == b.triangles, "the file's mesh");
  calotte_mesh_free(read);

  options.density = density;
  options.well_centred = 1;
  calotte_set_threads(2);
  expect(calotte_grid(1000, &options, &again, &report, &error) == CALOTTE_OK, "a graded grid");
  calotte_set_threads(0);
  calotte_mesh_free(again);
  options.progress = stop;
  again = NULL;
  expect(calotte_cvt(a.points, a.sites, &options, &again, &report, &error) == CALOTTE_OK &&
             report.iterations == 3 && !report.converged,
         "a run that ends early");
  calotte_mesh_free(again);
  options.density = refuses;
  expect(calotte_cvt(a.points, a.sites, &options, &again, &report, &error) == CALOTTE_CANCELLED,
         "a density that ends the run");
  calotte_mesh_free(mesh);
}

static void errors(void) {
  double xyz[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  calotte_error error;
  calotte_mesh* mesh = NULL;
  xyz[4] = nan("");
  expect(calotte_delaunay(xyz, 4, &mesh, &error) == CALOTTE_NOT_FINITE && error.index == 1, "NaN");
  xyz[4] = 1;
  expect(calotte_delaunay(xyz, 4, &mesh, &error) == CALOTTE_ZERO_VECTOR && error.index == 3,
         "a point at the origin");
  expect(calotte_delaunay(xyz, 2, &mesh, &error) == CALOTTE_TOO_FEW_SITES, "2 points");
  expect(calotte_delaunay(NULL, 3, &mesh, &error) == CALOTTE_BAD_OPTION, "a null pointer");
  expect(calotte_delaunay(xyz, -1, &mesh, NULL) == CALOTTE_BAD_OPTION, "a negative count");
  expect(calotte_read("no such file.nc", &mesh, &error) == CALOTTE_FILE, "no file");
  expect(strstr(error.message, "no such file.nc") != NULL, "a message with its name");
  expect(mesh == NULL, "outputs stay unchanged");
  calotte_mesh_free(NULL);
}

int main(int argc, char** argv) {
  if (argc != 2 || strlen(calotte_version()) < 5)
    return 2;
  octahedron();
  plane();
  grids(argv[1]);
  errors();
  return failures != 0;
}
