// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/scalars.h"
#include "io/formats/poly_data.h"
#include "io/formats/room.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The legacy files of VTK: words of text, and numbers between them, as text or in big-endian
/// bytes.
namespace calotte::io_detail {

/// \throws Error parse for a file that does not start as a legacy VTK file.
void require_legacy_vtk(std::string_view start, const std::string& name);

class LegacyText {
public:
  /// Reads the head up to the word after ASCII or BINARY. \throws Error parse.
  /// \pre require_legacy_vtk()
  LegacyText(std::string_view content, std::string name);

  const std::string& name() const { return name_; } ///< of the file

  /// Reads the next word of the text, in any line; empty at the end.
  std::string_view word();
  /// Reads the next word of this line; empty at its end.
  std::string_view word_of_line();
  /// Whether the next word is the keyword, in any case. If so, reads it.
  bool take(std::string_view keyword);
  /// Reads the rest of the line.
  std::string_view line();

  /// Reads the next word as a number from 0 to 2147483647. \throws Error parse.
  std::int64_t count(const std::string& what);
  /// Reads a name, in which %XX encodes a character.
  std::string decoded_name();
  /// Reads the next word as a type of numbers; none for bits and strings. \throws Error parse, for
  /// a word that is not a type.
  struct Type {
    std::string name;
    std::optional<Scalar> scalar;
  };
  Type type();

  /// Reads numbers from the next line on.
  /// \param array for messages.
  /// \throws Error parse.
  template <class T> Column<T> numbers(const std::string& array, Scalar type, std::int64_t count);
  /// Skips values. \throws Error parse.
  void skip(const std::string& array, const Type& type, std::int64_t count);
  /// Skips the lines of METADATA, up to an empty one.
  void skip_metadata();

private:
  void skip_bytes(const std::string& array, std::int64_t count);
  void skip_string(const std::string& array);
  void start_numbers();

  std::string_view rest_;
  std::string name_;
  bool binary_ = false;
};

extern template Column<double> LegacyText::numbers(const std::string&, Scalar, std::int64_t);
extern template Column<std::int32_t> LegacyText::numbers(const std::string&, Scalar, std::int64_t);
extern template Column<std::int64_t> LegacyText::numbers(const std::string&, Scalar, std::int64_t);

} // namespace calotte::io_detail
