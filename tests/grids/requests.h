/* SPDX-License-Identifier: GPL-3.0-or-later
 * The numbers of the requests that tests/grids/recipes_test.py makes of several callers, for C and
 * C++. Callers in other languages take them from that script; the formulas use + - * / and % only,
 * so that all languages compute the same bits. */
#ifndef CALOTTE_TESTS_REQUESTS_H
#define CALOTTE_TESTS_REQUESTS_H

enum { ring_corners = 8, width_columns = 4, width_rows = 3, fixed_count = 3, start_count = 100 };

/* The directions of longitude and latitude (-115, 25), (-95, 25), (-85, 35), (-85, 45), (-95, 55),
 * (-115, 55), (-125, 45) and (-125, 35), as calotte::from_lonlat() has them. */
static const double region_ring[3 * ring_corners] = {
    -0.38302222155948901,  -0.82139380484326963, 0.42261826174069944,  -0.07898992833716563,
    -0.90285901228517351,  0.42261826174069944,  0.071393804843269654, -0.81603492345170836,
    0.57357643635104605,   0.061628416716219353, -0.70441602640275869, 0.70710678118654757,
    -0.049990480332730299, -0.57139380484326963, 0.8191520442889918,   -0.24240387650610401,
    -0.51983679072568445,  0.8191520442889918,   -0.40557978767263886, -0.57922796533956922,
    0.70710678118654757,   -0.46984631039295416, -0.67101007166283433, 0.57357643635104605};

/* The same of (-110, 33), (-100, 33), (-95, 38), (-95, 42), (-100, 47), (-110, 47), (-115, 42) and
 * (-115, 38). */
static const double small_ring[3 * ring_corners] = {
    -0.28684222785171393, -0.78809254396864181,  0.54463903501502697,   -0.14563361578661238,
    -0.82592927753580536, 0.54463903501502697,   -0.068679662523735696, -0.78501213478229726,
    0.61566147532565829,  -0.064769339233561096, -0.74031693505489571,  0.66913060635885824,
    -0.11842777239668789, -0.67163727253116001,  0.73135370161917046,   -0.23325717685644679,
    -0.64086882633882092, 0.73135370161917046,   -0.3140665743648518,   -0.67351794222615458,
    0.66913060635885824,  -0.33302773492225141,  -0.71418028226239094,  0.61566147532565829};

static const double rectangle_ring[8] = {0, 0, 2, 0, 2, 1, 0, 1};

/* Cell widths in km at the nodes of longitudes and latitudes, those of the first latitude first. */
static const double width_longitudes[width_columns] = {0, 90, 180, 270};
static const double width_latitudes[width_rows] = {-60, 0, 60};
static const double widths_km[width_columns * width_rows] = {1200, 1000, 1100, 1300, 900,  800,
                                                             1000, 1200, 1100, 900,  1000, 1400};

/* 200 km everywhere. */
static const double uniform_longitudes[2] = {0, 180};
static const double uniform_latitudes[2] = {-90, 90};
static const double uniform_km[4] = {200, 200, 200, 200};

static const double fixed_directions[3 * fixed_count] = {1, 0, 0, 0, 1, 0, 0, 0.6, 0.8};

/* Widths at the equator are half of those at the poles. */
static inline double request_density(double z) {
  const double root = 1 + 15 * (z * z);
  return 16 / (root * root);
}

/* Coordinate k of start point i, not on the unit sphere. */
static inline double start_coordinate(int i, int k) {
  static const int step[3] = {37, 59, 71}, shift[3] = {11, 5, 17}, modulus[3] = {101, 103, 107};
  return (double)((i * step[k] + shift[k]) % modulus[k] - modulus[k] / 2) / 8;
}

#endif
