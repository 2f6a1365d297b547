// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/text.h"

#include <calotte/read.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace calotte::io_detail {

/// Points of consecutive lines.
struct PointRows {
  std::vector<double> coordinates; ///< three of each point
  std::vector<std::int64_t> lines; ///< number of each point's line

  void clear() { coordinates.clear(), lines.clear(); } ///< keeps the memory
};

struct LineFormat;

/// The columns of the coordinates according to the first line of a file.
struct PointHeader {
  char separator = ' ';
  std::array<std::size_t, 3> column{};
};

/// Splits a line into columns at a separator, or at a blank as separator at all blanks and tabs.
/// Removes quotes and blanks around them. A column that starts with a double quote goes on to the
/// next one, whatever is between.
std::vector<std::string_view> split_columns(std::string_view line, char separator);
/// The same into memory that serves for many lines.
void split_columns(std::string_view line, char separator, std::vector<std::string_view>& columns);

/// Finds the separator of a line: comma, semicolon, bar or tab, else a blank.
char find_separator(std::string_view line);
/// The same of a row: that of its header, if the row has it.
char find_separator(std::string_view row, char of_header);

/// Parses a header. Returns none unless it names the coordinates: by their names alone, or else
/// with a unit, such as lat_deg, "Latitude [deg]" and "x (km)".
std::optional<PointHeader> parse_header(std::string_view line, Columns columns);

/// A comment before the rows, and the number of its line.
struct Comment {
  std::string text;
  std::int64_t line;
};

/// The last comment that may be the header of a row: it names positions, and as many columns as the
/// row has. Blanks may separate names if those of the position are the first, which they are in few
/// sentences. Null without one.
const Comment* find_header(const std::vector<Comment>& comments, std::string_view row,
                           Columns columns);
/// Whether a comment is worth keeping for that.
bool may_be_header(std::string_view comment, Columns columns);

/// Appends the point of a position, three numbers.
/// \param values its coordinates as in the file.
/// \throws Error parse, for numbers that give no point.
void append_position(const LineReader& reader, Columns columns, const double* values,
                     std::vector<double>& coordinates);

/// Checks whether the first column is not a coordinate, in files with more columns than are read:
/// it then numbers the lines, or is not a longitude.
class FirstColumn {
public:
  explicit FirstColumn(Columns columns);

  bool has_further() const { return further_; }

  /// \param named whether a header names the columns.
  void take(const LineReader& reader, std::string_view line, double value, bool named);
  /// \param fewest number of lines that are sufficient evidence.
  void require_no_count(const LineReader& reader, std::int64_t fewest) const;

  /// As RowParser's.
  FirstColumn following() const;
  void append(const FirstColumn& next);

private:
  [[noreturn]] void refuse(const LineReader& reader, const char* what) const;

  bool lonlat_;
  const LineFormat* format_;
  bool follows_ = false; ///< whether lines before are known
  std::int64_t lines_ = 0;
  double begin_ = 0;
  bool further_ = false, counts_ = false;
};

/// Parses the lines of a text of points, in the syntax of read_points().
class RowParser {
public:
  explicit RowParser(Columns columns);

  /// Whether there was a point. No header follows then, and each line can be parsed alone.
  bool has_points() const { return has_points_; }

  /// Adds the point of a line, if it has one.
  /// \throws Error parse.
  void parse(const LineReader& reader, std::string_view line, PointRows& rows);

  /// A parser for lines that follow, whose lines before are parsed at the same time.
  /// \pre has_points()
  RowParser following() const;
  /// Adds what the parser of the next lines has found.
  void append(const RowParser& next) { first_.append(next.first_); }

  /// \param reader at the end of the text.
  /// \returns whether there are more columns than are read, which no header names.
  /// \throws Error parse.
  bool finish(const LineReader& reader) const;

private:
  void accept_comment(const LineReader& reader, std::string_view line);
  void require_names(const LineReader& reader, std::string_view header) const;
  void take_header(const LineReader& reader, std::string_view line, const Columned& read);
  void add(const LineReader& reader, std::string_view line, const double* values, PointRows& rows);

  Columns columns_;
  const LineFormat* format_;
  bool header_ = false, has_points_ = false;
  std::vector<Comment> comments_; ///< that may be headers
  std::optional<PointHeader> names_;
  FirstColumn first_;
  std::vector<std::string_view> texts_; ///< columns of the current line
};

} // namespace calotte::io_detail
