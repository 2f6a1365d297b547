// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/density.h>
#include <calotte/surface.h>
#include <calotte/write.h>

#include <cstdint>
#include <optional>

namespace calotte::tools {

/// What a run of calotte cvt takes, roughly.
struct CvtCosts {
  double seconds = 0;   ///< wall-clock time to compute the mesh, without writing it
  double memory = 0;    ///< largest resident memory, bytes
  double mpas_file = 0; ///< bytes of a complete MPAS file
  double vtp_file = 0;  ///< bytes of the triangles as .vtp
};

/// Estimates a run with the default options, whose time may be a third or three times as long. It
/// follows from the number of cells, the number of evaluations that graded runs took when this
/// model was made, and the time that the density takes at a point, which is measured in a few
/// milliseconds. Memory excludes that of the writers. The sizes of files are those that the writers
/// give, but for a few kB and for cells with more than 7 neighbours.
///
/// \param cells >= 12.
/// \param surface where the run meshes.
/// \param threads >= 1.
/// \param evaluations of all cells, if the run's options give their number.
/// \throws Error as evaluate().
CvtCosts cvt_costs(std::int64_t cells, const Density& density, const Surface& surface, int threads,
                   std::optional<double> evaluations = {});

/// The memory of this machine, bytes, or the limit of the container where that is less.
double machine_memory();

/// The size alone of a file in a format; 0 where it is not known.
double file_bytes(Format format, std::int64_t cells, bool uniform);

} // namespace calotte::tools
