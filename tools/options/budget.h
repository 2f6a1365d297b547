// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// What a grid costs the model that runs on it.
namespace calotte::tools {

/// The memory of a model. The default is MPAS-Atmosphere 8.3 with its usual physics in numbers of
/// 32 bits: 366 of them a cell and level, by the fields of its Registry.xml with 55 levels, without
/// halos and buffers of files. With numbers of 64 bits it is twice as much.
struct ModelMemory {
  int levels = 55;
  double bytes_per_level = 1500; ///< of a cell

  double of(double cells) const { return cells * levels * bytes_per_level; }
  bool operator==(const ModelMemory&) const = default;
};

/// The longest step of MPAS-Atmosphere, s: 0.9 times the least distance of cells over its fastest
/// flow. That distance is the part of the least width that a well-centred grid keeps.
/// \param width the least of cells, km. \param least_spacing that part, CvtStop::least_spacing.
double longest_step(double width, double least_spacing);
/// The least width for a step, km: its inverse.
double width_of_step(double seconds, double least_spacing);

/// What a grid may cost: a number of cells, or the step of the model.
struct Budget {
  std::optional<std::int64_t> cells; ///< of a number, or of memory
  std::optional<double> bytes;       ///< of memory
  std::optional<double> step;        ///< s
};

/// The numbers of cells that a run can make.
inline constexpr double fewest_cells = 12, most_cells = 1 << 30;

/// The budget of its words: "24GiB", "24GB", "500000-cells", "step=10s".
/// \throws Error invalid_argument.
Budget budget_of(const std::string& words, const ModelMemory& memory);

} // namespace calotte::tools
