// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <array>
#include <cstdint>
#include <istream>
#include <streambuf>
#include <string>

namespace calotte::io_detail {

/// The bytes of a JSON text on their way to a parser, which stores each word as a whole and copies
/// it into its messages. Refuses what no GeoJSON file needs: values nested deeper than
/// `deepest`, and numbers, names and texts longer than `longest`.
class JsonBuffer : public std::streambuf {
public:
  static constexpr int deepest = 100;
  static constexpr int longest = 1 << 20; ///< bytes

  /// \param name stands for the stream in messages.
  JsonBuffer(std::istream& in, const std::string& name) : in_(in), name_(name) {}

protected:
  /// \throws Error parse or file.
  int_type underflow() override;

private:
  void check(char c);
  [[noreturn]] void fail(const std::string& problem) const;

  std::istream& in_;
  const std::string& name_;
  std::array<char, 1 << 16> bytes_;
  std::int64_t position_ = 0; ///< of the byte that is checked
  int depth_ = 0, length_ = 0;
  bool in_text_ = false, escaped_ = false;
};

} // namespace calotte::io_detail
