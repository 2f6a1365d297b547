// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/require.h"
#include "io/bytes/file_error.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// The text of messages, tables and pictures.
namespace calotte::tools {

// Messages are made as in the library, by its headers without exported symbols.
using base_detail::counted, base_detail::listed, base_detail::message;
using base_detail::refuse, base_detail::refuse_at, base_detail::require;
using io_detail::fail_at, io_detail::fail_file, io_detail::fail_read, io_detail::fail_write;
using io_detail::refuse_path;

/// Formats a number with the fewest digits that read back to the same bits.
std::string shortest(double value);

/// Formats a number as printf does; at most 63 characters.
/// \param format with one conversion of a double.
std::string formatted(const char* format, double value);

/// "2562", "10 242": a count for people, its digits in groups of three from five digits on.
std::string spaced(std::int64_t count);

/// "0.41 s", "110 s", "2.5 min", "26 h": a time for people, of two digits or whole.
std::string duration(double seconds);

/// "41.2 kB", "325 MB", "2.87 GB": the size of data, of three digits.
std::string data_size(double bytes);

/// A line of a table: the name, blanks up to a column, at least one, and the value.
std::string row(std::string name, std::size_t column, const std::string& value);

/// The parts of a text between separators, at least one.
std::vector<std::string> split(std::string_view text, char separator);

} // namespace calotte::tools
