// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// The text of messages, tables and pictures.
namespace calotte::tools {

/// \throws Error invalid_argument with this message.
[[noreturn]] void refuse(const std::string& problem);

/// \throws Error parse, always: "PATH line LINE: problem".
[[noreturn]] void refuse_line(const std::string& path, std::int64_t line,
                              const std::string& problem);

/// Formats a number with the fewest digits that read back to the same bits.
std::string shortest(double value);

/// Formats a number as printf does; at most 63 characters.
/// \param format with one conversion of a double.
std::string formatted(const char* format, double value);

/// The words with a separator between them.
std::string joined(const std::vector<std::string>& words, const std::string& separator = ", ");

} // namespace calotte::tools
