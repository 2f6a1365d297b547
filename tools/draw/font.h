// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cairo.h>

namespace calotte::tools {

/// Sets the font of what is written next: DejaVu Sans, which is part of the command, so that
/// pictures are the same on every machine.
/// \param size height of a line, in the context's units.
void set_font(cairo_t* context, double size, bool italic = false);

} // namespace calotte::tools
