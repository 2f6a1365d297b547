// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"
#include "io/bytes/system.h"

#include <string>

namespace calotte::io_detail {

/// A file named TARGET.partPID-K, in the folder of its target. It is locked (flock) until both
/// descriptors are closed.
struct TemporaryFile {
  std::string path = {};
  Descriptor file = {}; ///< for writing; none after a failure
  Descriptor lock = {}; ///< a second one, so that the first can be closed before a rename
  int error = 0;        ///< errno of a failure
};

/// Creates a file of a new name. First removes the temporary files of the same target that killed
/// processes left: nobody has locked them.
TemporaryFile open_temporary(const std::string& target);

} // namespace calotte::io_detail
