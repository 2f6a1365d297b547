// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/file.h"
#include "io/formats/format_table.h"
#include "io/formats/room.h"

#include <calotte/voronoi.h>

#include <string>

/// What the writers of a mesh and of the contents of a file have in common.
namespace calotte::io_detail {

/// \throws Error invalid_argument, for a radius out of range or an ill-formed density.
void require_options(const std::string& path, const WriteOptions& options);

/// The order of the cells in a file of the options' format, which is known.
Numbering numbering_of(const WriteOptions& options);

/// A file from front to back. \param sites their number, or that of the cells.
template <class Put>
void put_file(const std::string& path, const WriteOptions& options, std::int64_t sites,
              const Put& put) {
  OutputFile file(path);
  file.watch(options.progress, row_of(options.format).bytes_a_site * sites);
  put([&](std::string_view bytes) { file.append(bytes); });
  file.commit();
}

/// A caller's callback for the part of a run from one fraction on.
ProgressCallback progress_from(const ProgressCallback& progress, double from);

} // namespace calotte::io_detail
