// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "io/bytes/room.h"

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace calotte::io_detail {

// ---- Reading

/// The lines of a stream, which end in LF, CRLF or CR; the last may lack its ending. A UTF-8 byte
/// order mark before the first is skipped.
class LineReader {
public:
  /// \param name stands for the stream in messages.
  LineReader(std::istream& in, std::string name);

  /// The lines of a part of a text, such as parts_of() gives; it must outlive the reader.
  /// \param before the number of lines before the part.
  LineReader(std::string_view part, std::string name, std::int64_t before = 0);

  /// Reads the next line, without its ending; valid until the next call. False after the last one.
  /// \throws Error file.
  bool next(std::string_view& line);

  /// As next(), without comments; skips lines without other content.
  bool next_content(std::string_view& line);

  /// Takes the next lines out of the stream for other readers: whole ones of about `size` bytes, at
  /// least one; empty after the last line. Valid until the next call. count_lines() counts them.
  /// \pre size <= 8 MiB
  /// \throws Error file.
  std::string_view take_lines(std::size_t size);
  void count_lines(std::int64_t lines) { number_ += lines; }

  /// Estimates how many items the stream has, rather too many, if the lines so far have `items`:
  /// twice as many where its size is unknown.
  std::int64_t estimate_all(std::int64_t items) const;

  std::int64_t number() const { return number_; } ///< 1-based, of the line that `next` returned
  const std::string& name() const { return name_; }

  /// \throws Error parse that names the current line. \param problem or a pattern, as in message()
  [[noreturn]] void fail(const std::string& problem) const;
  template <class Value, class... Values>
  [[noreturn]] void fail(std::type_identity_t<Pattern<Value, Values...>> pattern,
                         const Value& value, const Values&... values) const {
    fail(message(pattern, value, values...));
  }

private:
  void skip_lf();
  bool refill();

  std::istream* in_ = nullptr; ///< null for a part of a text
  std::string name_;
  std::vector<char> buffer_;            ///< of the stream
  std::size_t at_first_ = 0, read_ = 0; ///< bytes that the stream had, and those read
  const char* text_;                    ///< the buffer, or the part
  std::size_t begin_ = 0, end_ = 0;     ///< what is unread of it
  std::int64_t number_ = 0;
  bool after_cr_ = false; ///< a following LF belongs to the same line ending
};

/// Cuts a text of whole lines into parts of whole lines, of about `size` bytes.
std::vector<std::string_view> parts_of(std::string_view text, std::size_t size);

/// The result of parsing the numbers at the start of a line.
enum class Outcome {
  ok,
  too_few,      ///< the line ends before `count` columns
  no_number,    ///< a column is not a number, or empty
  out_of_range, ///< a column is a number out of the range of the type
};

/// The first invalid column, or the number of columns read.
struct Columned {
  Outcome outcome = Outcome::ok;
  int columns = 0;       ///< read so far
  std::string_view text; ///< text of the invalid column
};

/// Reads the first `count` columns of a line: blanks and tabs, and at most one of comma, semicolon
/// and bar, separate them.
Columned parse_columns(std::string_view line, int count, double* values);
Columned parse_columns(std::string_view line, int count, std::int64_t* values);

/// Parses a whole text as one number, without blanks around it.
/// \returns `text` is that given.
Columned parse_number(std::string_view text, double& value);

/// Parses a whole text as finite numbers. Blanks, or one of comma, semicolon and bar, separate
/// them. Returns none for any other text.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

/// Appends the ids of one line of text. They count from `first` in the text and from 0 in `faces`.
/// \throws Error parse for an id that is not one of the points.
void parse_ids(const LineReader& reader, const std::int64_t* ids, std::int64_t points,
               std::vector<std::int32_t>& faces, std::int64_t first = 0, std::int64_t count = 3);

/// A text with its ASCII letters in lower case.
std::string lower(std::string_view text);

/// The end of the quoted text that starts at an index, behind its closing quote, or of the line
/// where that lacks; the index itself if no quote stands there. Two quotes within stand for one.
std::size_t end_of_quoted(std::string_view line, std::size_t begin);

/// A line before its comment, which a `#` starts that is not in quotes. Quotes start with a column.
std::string_view without_comment(std::string_view line);

/// True if one of the line's columns is a number.
bool has_number(std::string_view line);

/// Text from a file as one short printable line within quotes.
std::string in_quotes(std::string_view text);

/// A description such as "`abc` is not a number", without the remedy.
/// \pre the outcome is not ok.
std::string describe(const Columned& read);

/// Reads the next line that has content.
/// \param awaited its expected content, for the message.
/// \throws Error parse, where the stream ends.
std::string_view line_with(LineReader& reader, const std::string& awaited);

/// \throws Error parse, unless `count` columns were read.
void require_columns(const LineReader& reader, const Columned& read, int count);
/// The same.
/// \param awaited expected content of the columns, for the message.
void require_columns(const LineReader& reader, const Columned& read, const std::string& awaited);

/// Reads the first `count` columns of the current line as numbers.
/// \throws Error parse.
template <class T>
void take_columns(const LineReader& reader, std::string_view line, int count, T* values) {
  require_columns(reader, parse_columns(line, count, values), count);
}
template <class T>
void take_columns(const LineReader& reader, std::string_view line, int count, T* values,
                  const std::string& awaited) {
  require_columns(reader, parse_columns(line, count, values), awaited);
}

/// The same for the next line that has content.
template <class T>
void take_columns(LineReader& reader, int count, T* values, const std::string& awaited) {
  take_columns(reader, line_with(reader, awaited), count, values, awaited);
}

// ---- Writing

/// Receives output bytes.
using Sink = std::function<void(std::string_view)>;

/// An array's bytes.
template <class T> std::string_view bytes_of(const T* data, std::int64_t count) {
  return {reinterpret_cast<const char*>(data), sizeof(T) * static_cast<std::size_t>(count)};
}

/// Collects small pieces for a sink. Call flush() at the end.
class Writer {
public:
  explicit Writer(Sink sink);

  Writer& text(std::string_view bytes);
  Writer& number(double value); ///< the fewest digits that read back to the same bits
  Writer& number(std::int64_t value);
  template <class T> Writer& raw(const T& value) {
    return text({reinterpret_cast<const char*>(&value), sizeof value});
  }
  void flush();

private:
  Sink sink_;
  std::string buffer_;
};

} // namespace calotte::io_detail
