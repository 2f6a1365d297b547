// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/room.h"

/// Bytes and text: files that appear whole or not at all, lines and numbers, big-endian and base64
/// data, XML, JSON as a stream.
///
/// In: a path or a stream. Out: bytes, lines and numbers, or one line that names the file and the
/// line in it.
namespace calotte::io_detail {}
