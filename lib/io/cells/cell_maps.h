// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/file.h"
#include "io/cells/room.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Maps from the cells of one mesh to those of another, in text.
namespace calotte::io_detail {

/// The files of MPAS-Tools' culler with option -c, in a folder, see cell_map_paths(). They are
/// written at once and named by commit().
class CellMaps {
public:
  /// An id, or -1 for none.
  using Id = std::function<std::int32_t(std::int64_t i)>;

  /// \param old_cells, new_cells their numbers. \throws Error file.
  CellMaps(const std::string& folder, std::int64_t old_cells, const Id& new_of_old,
           std::int64_t new_cells, const Id& old_of_new);
  /// \throws Error file.
  void commit();

private:
  std::vector<std::unique_ptr<OutputFile>> files_;
};

} // namespace calotte::io_detail
