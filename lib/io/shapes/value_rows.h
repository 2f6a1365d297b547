// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/text.h"
#include "io/shapes/row_parser.h"

#include <calotte/field_grid.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace calotte::io_detail {

/// Positions and values of consecutive lines.
struct ValueRows {
  std::vector<double> coordinates; ///< two of each row, as in the text
  std::vector<double> points;      ///< three of each row
  std::vector<double> values;      ///< of each row those of all fields; NaN where there is none

  void clear(); ///< keeps the memory
  void append(const ValueRows& next);
};

/// The columns of a text that are read.
struct ValueColumns {
  char separator = ' ';
  std::size_t count = 0; ///< of all columns
  std::array<std::size_t, 2> position{};
  bool named = false; ///< whether a header or the caller says which the position is
  std::vector<std::size_t> fields;
  std::vector<std::string> names; ///< of the fields
};

/// Parses the lines of a text of positions and values, in the syntax of read_positions().
class ValueParser {
public:
  explicit ValueParser(ColumnChoice choice);

  /// Whether there was a row. No header follows then, and each line can be parsed alone.
  bool has_points() const { return first_line_ > 0; }

  /// Adds the row of a line, if it has one.
  /// \throws Error parse.
  void parse(const LineReader& reader, std::string_view line, ValueRows& rows);

  /// As RowParser's.
  ValueParser following() const;
  void append(const ValueParser& next) { first_.append(next.first_); }

  /// \param reader at the end of the text.
  /// \throws Error parse.
  void finish(const LineReader& reader) const;

  const std::vector<std::string>& names() const { return columns_.names; } ///< of the fields

private:
  Columns kind() const { return choice_.plane ? Columns::xy : Columns::lonlat; }
  void begin(const LineReader& reader, std::string_view line);
  void choose_position(const LineReader& reader);
  void choose_fields(const LineReader& reader);
  std::size_t find(const LineReader& reader, const std::string& column) const;
  double coordinate(const LineReader& reader, std::size_t column) const;
  double value(const LineReader& reader, std::size_t field) const;
  std::string name_of(std::size_t column) const;

  ColumnChoice choice_;
  ValueColumns columns_;
  std::string header_; ///< the line before the first row
  std::int64_t header_line_ = 0;
  std::vector<Comment> comments_;  ///< that may be it
  std::vector<std::string> names_; ///< of all columns, by the header
  std::int64_t first_line_ = 0;    ///< number of the first row's line
  FirstColumn first_;
  std::vector<std::string_view> texts_; ///< columns of the current line
};

} // namespace calotte::io_detail
