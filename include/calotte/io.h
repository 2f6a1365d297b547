// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/export.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// A checkpoint: a run's state as binary, with the configuration that it belongs to in words of the
/// caller's choice. A file that was cut short or damaged is refused, and so is another version's.
/// \throws Error file.
void write_checkpoint(const std::string& path, const CvtState& state,
                      const std::string& configuration);
/// \throws Error file, parse, bad_option (of another configuration).
CvtState read_checkpoint(const std::string& path, const std::string& configuration);

} // namespace calotte
CALOTTE_API_END
