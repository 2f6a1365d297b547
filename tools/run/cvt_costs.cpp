// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/cvt_costs.h"

#include "run/progress.h"

#include <calotte/generators.h>

#include <algorithm>
#include <fstream>

#include <unistd.h>

namespace calotte::tools {
namespace {

/// Neighbours of a cell that MPAS files leave room for: those of the pairs of 5 and 7 in a graded
/// grid.
constexpr int most_neighbours = 7;

/// The arrays of a complete file, see lib/io/mpas/mpas_write.cpp, of n cells, 2n - 4 vertices and
/// 3n - 6 edges. Cells, vertices and edges have five coordinates and a number each.
double mpas_bytes(double cells, int neighbours) {
  constexpr double real = 8, integer = 4, position = 5 * real + integer;
  const double of_cell = position + integer * (1 + 3 * neighbours) + 4 * real,
               of_vertex = position + integer * (3 + 1 + 3 + 1) + real * (1 + 3 + 2),
               of_edge =
                   position + integer * (2 + 2 + 1) + 3 * real + 2 * neighbours * (integer + real);
  return cells * of_cell + (2 * cells - 4) * of_vertex + (3 * cells - 6) * of_edge;
}

/// Points and their fields (four numbers and the count of neighbours), three corners and an offset
/// a triangle.
double vtp_bytes(double cells) {
  constexpr double of_point = 3 * 8 + 4 * 8 + 4, of_triangle = 4 * 8;
  return cells * of_point + (2 * cells - 4) * of_triangle;
}

/// Seconds of a thread to evaluate the density at a point.
double seconds_of_point(const Density& density, const Surface& surface) {
  constexpr std::int64_t count = 1 << 14;
  constexpr int rounds = 3;
  const Points3 points =
      surface.is_sphere() ? fibonacci_sphere(count) : random_points(count, surface);
  double least = 1;
  for (int round = 0; round < rounds; ++round)
    least = std::min(least, seconds_of([&] { evaluate(density, points, surface); }));
  return least / count;
}

// Default runs with x4, x8, x16, caps of a contrast of 100, a coast and an ocean by rules, with 41
// 000 to 1.6 million cells, evaluate each cell 30 to 42 times. An evaluation took 150 to 900 ns of
// a cell on AMD EPYC virtual machines, of two threads together, as others used these more or less.

/// Evaluations in units of the result's cells: of a uniform grid of the sphere, see Start, and of
/// all others.
constexpr double evaluations_uniform = 30, evaluations_graded = 40;
constexpr double seconds_of_cell = 280e-9; ///< per evaluation, without the density
constexpr double points_of_cell = 36;      ///< at which the density is evaluated
constexpr double efficiency = 0.9;         ///< of each further thread

/// Bytes: the peaks of runs with 41 000 to 10 million cells, within a sixth of them. From a million
/// generators on, descents store fewer L-BFGS pairs.
constexpr double memory_of_cell = 800, memory_of_cell_of_many = 520, memory_of_program = 55e6;
constexpr double many = 1e6;

} // namespace

CvtCosts cvt_costs(std::int64_t cells, const Density& density, const Surface& surface, int threads,
                   std::optional<double> evaluations) {
  const auto n = static_cast<double>(cells);
  const bool uniform = density.uniform();
  const double of_cell =
      seconds_of_cell + (uniform ? 0 : points_of_cell * seconds_of_point(density, surface));
  CvtCosts costs;
  const double usual =
      uniform && surface.is_whole_sphere() ? evaluations_uniform : evaluations_graded;
  costs.seconds = evaluations.value_or(usual) * n * of_cell / (1 + efficiency * (threads - 1));
  costs.memory = memory_of_program + (n < many ? memory_of_cell : memory_of_cell_of_many) * n;
  costs.mpas_file = file_bytes(Format::mpas, cells, uniform);
  costs.vtp_file = file_bytes(Format::vtp, cells, uniform);
  return costs;
}

double machine_memory() {
  double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  // The limit of a container, of either version of control groups; "max" is none.
  for (const char* path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double limit = 0;
    if (std::ifstream(path) >> limit && limit > 0)
      memory = std::min(memory, limit);
  }
  return memory;
}

double file_bytes(Format format, std::int64_t cells, bool uniform) {
  const auto n = static_cast<double>(cells);
  if (format == Format::mpas)
    return mpas_bytes(n, uniform ? 6 : most_neighbours);
  return format == Format::vtp ? vtp_bytes(n) : 0;
}

} // namespace calotte::tools
