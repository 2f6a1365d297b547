// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/file.h"
#include "io/formats/format_table.h"
#include "io/formats/room.h"

#include <calotte/coastal_cells.h>
#include <calotte/voronoi.h>

#include <string>

/// Common code of the writers of a mesh and of the contents of a file.
namespace calotte::io_detail {

/// \throws Error invalid_argument, for a radius out of range or an ill-formed density.
void require_options(const std::string& path, const WriteOptions& options);

/// Whether the format has a place of its own for a field of depths, or of an open boundary.
bool is_coast_field(const MeshField& field, Format format);

/// Moves such fields to the options' depths and open sites, unless these are given.
/// \param options of a known format.
void take_coast_fields(WriteOptions& options);

/// Writes a mesh of the sphere, see write().
/// \param mesh its own is freed as early as the format allows.
/// \returns what coastal_cells() changed, if the file has the cells of a region.
CoastChanges write_sphere(const std::string& path, WrittenMesh mesh, const WriteOptions& options);

/// The order of the cells in a file of the options' format, which is known.
Numbering choose_numbering(const WriteOptions& options);

/// Writes a file from front to back.
/// \param sites number of sites or cells, for progress.
template <class Put>
void put_file(const std::string& path, const WriteOptions& options, std::int64_t sites,
              const Put& put) {
  OutputFile file(path);
  file.watch(options.progress, find_row(options.format).bytes_a_site * sites);
  put([&](std::string_view bytes) { file.append(bytes); });
  file.commit();
}

/// A callback that maps its progress to the part of a run from one fraction on.
ProgressCallback progress_from(const ProgressCallback& progress, double from);

} // namespace calotte::io_detail
