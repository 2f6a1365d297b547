// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <calotte/cvt.h>
#include <calotte/export.h>
#include <calotte/read.h>
#include <calotte/write.h>

#include <string>

CALOTTE_API_BEGIN
namespace calotte {

/// Writes a checkpoint: the state of a run in binary, with a checksum. The file is complete or
/// absent, as with write().
/// \param configuration text that identifies the configuration of the run, such as its options, one
///        per line.
/// \param command text for read_checkpoint_command(), such as all options, which are not compared.
/// \throws Error file.
void write_checkpoint(const std::string& path, const CvtState& state,
                      const std::string& configuration, const std::string& command = {});

/// Reads a checkpoint. The state has the bits of the one written.
/// \param configuration must equal the text that the checkpoint was written with.
/// \throws Error file; parse for a file that is not a checkpoint, is incomplete or damaged, or
///         comes from another version or byte order; invalid_argument if the configuration differs,
///         naming the first line that does.
CvtState read_checkpoint(const std::string& path, const std::string& configuration);

/// The command that a checkpoint was written with. Reads the beginning of the file only.
/// \throws Error file; parse for a file that is not a checkpoint, or comes from another version or
///         byte order.
std::string read_checkpoint_command(const std::string& path);

} // namespace calotte
CALOTTE_API_END
