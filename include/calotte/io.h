// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/export.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// A checkpoint: a run's state as binary, with a text of the caller's that identifies the
/// configuration. Reading throws for a file that is incomplete, damaged, or from another version.
/// \throws Error file.
void write_checkpoint(const std::string& path, const CvtState& state,
                      const std::string& configuration);
/// \throws Error file, parse, bad_option (of another configuration).
CvtState read_checkpoint(const std::string& path, const std::string& configuration);

} // namespace calotte
CALOTTE_API_END
