// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <cstdint>

/// The classic formats of NetCDF store numbers with the most significant byte first.
namespace calotte::io_detail {

/// Converts values of 1, 2, 4 or 8 bytes between the machine's byte order and big-endian order, in
/// either direction.
/// \param out need not be aligned; may be `values`.
void swap_big_endian(const char* values, std::int64_t count, std::int64_t size, char* out);

/// The same for an array.
template <class T> void to_big_endian(const T* values, std::int64_t count, char* out) {
  swap_big_endian(reinterpret_cast<const char*>(values), count, sizeof(T), out);
}

} // namespace calotte::io_detail
