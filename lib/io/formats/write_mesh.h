// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/file.h"
#include "io/formats/formats.h"
#include "io/formats/room.h"

#include <calotte/voronoi.h>

#include <string>

/// What the writers of a mesh and of the contents of a file have in common.
namespace calotte::io_detail {

/// \throws Error invalid_argument, that names the file.
[[noreturn]] void refuse_to_write(const std::string& path, const std::string& problem);

/// \throws Error invalid_argument, for a radius out of range or an ill-formed density.
void require_options(const std::string& path, const WriteOptions& options);

/// A file from front to back.
template <class Put>
void put_file(const std::string& path, const ProgressCallback& progress, std::int64_t expected,
              const Put& put) {
  OutputFile file(path);
  file.watch(progress, expected);
  put([&](std::string_view bytes) { file.append(bytes); });
  file.commit();
}

/// A site's share of a file, roughly: progress alone depends on it.
std::int64_t expected_bytes(Format format);

/// A caller's callback for the part of a run from one fraction on.
ProgressCallback rest_of(const ProgressCallback& progress, double from);

/// Polygons in a format of cells other than MPAS.
/// \throws Error invalid_argument, for polygons of a plane in a format of longitudes and latitudes.
void write_polygons(const std::string& path, const CellGrid& grid, const WriteOptions& options);

/// The names of the formats of cells that hold any polygons, for messages.
std::string formats_of_polygons(bool on_sphere);

} // namespace calotte::io_detail
