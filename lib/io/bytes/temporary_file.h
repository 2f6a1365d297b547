// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"
#include "io/bytes/system.h"

#include <string>

namespace calotte::io_detail {

/// A file named PLACE.partPID-K, in the folder of its place. It is locked (flock) until both
/// descriptors are closed.
struct TemporaryFile {
  std::string path = {};
  Descriptor file = {}; ///< for writing; none after a failure
  Descriptor lock = {}; ///< a second one, so that the first can be closed before a rename
  int error = 0;        ///< errno of a failure
};

/// Creates a file of a new name. First removes the temporary files of the same place that nobody
/// has locked, which killed processes left.
TemporaryFile open_temporary(const std::string& place);

} // namespace calotte::io_detail
