// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/text.h"

#include "io/bytes/file.h"
#include "io/bytes/file_error.h"

#include <calotte/error.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <istream>
#include <system_error>

namespace calotte::io_detail {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_mark(char c) { return c == ',' || c == ';' || c == '|'; }

const char* skip_blanks(const char* p, const char* end) {
  while (p != end && is_blank(*p))
    ++p;
  return p;
}

/// A column runs to the next separator.
const char* column_end(const char* p, const char* end) {
  return std::find_if(p, end, [](char c) { return is_blank(c) || is_mark(c); });
}

/// std::from_chars does not accept a plus sign.
const char* skip_plus(const char* p, const char* end) {
  return end - p > 1 && p[0] == '+' && p[1] != '+' && p[1] != '-' ? p + 1 : p;
}

/// The length of the whole lines at the start of a text that goes on.
std::size_t whole_lines(std::string_view text) {
  for (std::size_t i = text.size(); i-- > 0;)
    if (text[i] == '\n' || (text[i] == '\r' && i + 1 < text.size())) // or else a CRLF, perhaps
      return i + 1;
  return 0;
}

template <class T> Columned parse(std::string_view line, int count, T* values) {
  const char* const end = line.data() + line.size();
  const char* p = skip_blanks(line.data(), end);
  Columned read;
  while (true) {
    if (p == end) {
      read.outcome = Outcome::too_few;
      return read;
    }
    const auto result = std::from_chars(skip_plus(p, end), end, values[read.columns]);
    const bool whole = result.ptr == end || is_blank(*result.ptr) || is_mark(*result.ptr);
    if (result.ec != std::errc() || !whole) {
      const bool range = result.ec == std::errc::result_out_of_range && whole;
      read.outcome = range ? Outcome::out_of_range : Outcome::no_number;
      read.text = {p, static_cast<std::size_t>(column_end(p, end) - p)};
      return read;
    }
    if (++read.columns == count)
      return read;
    p = skip_blanks(result.ptr, end);
    if (p != end && is_mark(*p))
      p = skip_blanks(p + 1, end);
  }
}

} // namespace

LineReader::LineReader(std::istream& in, std::string name)
    : in_(&in), name_(std::move(name)), buffer_(buffer_bytes), at_first_(bytes_left(in)),
      text_(buffer_.data()) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  while (end_ < mark.size() && refill()) {
  }
  if (std::string_view(text_, end_).starts_with(mark))
    begin_ = mark.size();
}

LineReader::LineReader(std::string_view part, std::string name, std::int64_t before)
    : name_(std::move(name)), text_(part.data()), end_(part.size()), number_(before) {}

/// Skips the LF of a CRLF whose CR was the last byte that was read.
void LineReader::skip_lf() {
  if (after_cr_ && begin_ != end_) {
    begin_ += text_[begin_] == '\n' ? 1 : 0;
    after_cr_ = false;
  }
}

bool LineReader::next(std::string_view& line) {
  std::size_t length = 0;
  while (true) {
    skip_lf();
    line = {text_ + begin_, end_ - begin_};
    while (length != line.size() && line[length] != '\n' && line[length] != '\r')
      ++length;
    if (length != line.size())
      break;
    if (!refill()) {
      begin_ = end_;
      number_ += line.empty() ? 0 : 1;
      return !line.empty();
    }
  }
  after_cr_ = line[length] == '\r';
  line = line.substr(0, length);
  begin_ += length + 1;
  ++number_;
  return true;
}

std::string_view LineReader::take_lines(std::size_t size) {
  if (buffer_.size() < size) {
    buffer_.resize(size);
    text_ = buffer_.data();
  }
  std::size_t whole = 0;
  for (bool more = in_ != nullptr; whole == 0; size *= 2) {
    while (more && end_ - begin_ < size)
      more = refill();
    skip_lf();
    const std::string_view unread(text_ + begin_, end_ - begin_);
    whole = more ? whole_lines(unread) : unread.size();
    if (unread.empty())
      break;
  }
  begin_ += whole;
  return {text_ + begin_ - whole, whole};
}

std::int64_t LineReader::estimate_all(std::int64_t items) const {
  constexpr double spare = 1.1; // lines differ in length
  const std::size_t taken = read_ - (end_ - begin_);
  if (at_first_ == 0 || taken == 0)
    return 2 * items;
  const double all = static_cast<double>(at_first_) / static_cast<double>(taken);
  return static_cast<std::int64_t>(std::max(1., spare * all) * static_cast<double>(items));
}

/// Moves the unread bytes to the front of the buffer and reads more; false at the end of the
/// stream.
bool LineReader::refill() {
  constexpr std::size_t most_line = std::size_t{1} << 24;
  if (in_ == nullptr)
    return false;
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ >= most_line) {
    ++number_;
    fail("a line longer than 16 MiB; give a text file");
  }
  if (end_ == buffer_.size()) {
    buffer_.resize(2 * buffer_.size());
    text_ = buffer_.data();
  }
  read_some(*in_, buffer_.data() + end_, static_cast<std::int64_t>(buffer_.size() - end_), name_);
  const auto count = static_cast<std::size_t>(in_->gcount());
  end_ += count, read_ += count;
  if (count == 0)
    require_whole(read_, at_first_, name_);
  return count > 0;
}

bool LineReader::next_content(std::string_view& line) {
  while (next(line)) {
    line = line.substr(0, line.find('#'));
    if (!std::all_of(line.begin(), line.end(), is_blank))
      return true;
  }
  return false;
}

std::vector<std::string_view> parts_of(std::string_view text, std::size_t size) {
  std::vector<std::string_view> parts;
  while (!text.empty()) {
    std::size_t part = 0;
    for (std::size_t most = size; part == 0; most *= 2)
      part = most < text.size() ? whole_lines(text.substr(0, most)) : text.size();
    parts.push_back(text.substr(0, part));
    text.remove_prefix(part);
  }
  return parts;
}

void LineReader::fail(const std::string& problem) const { fail_at(name_, number_, problem); }

Columned parse_columns(std::string_view line, int count, double* values) {
  return parse(line, count, values);
}

Columned parse_columns(std::string_view line, int count, std::int64_t* values) {
  return parse(line, count, values);
}

Columned parse_number(std::string_view text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(skip_plus(text.data(), end), end, value);
  if (problem == std::errc() && stop == end)
    return {Outcome::ok, 1, text};
  const bool range = problem == std::errc::result_out_of_range && stop == end;
  return {range ? Outcome::out_of_range : Outcome::no_number, 0, text};
}

std::optional<std::vector<double>> parse_numbers(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view blanks = " \t";
  const char *at = text.data(), *const end = text.data() + text.size();
  const auto skip = [&](std::string_view characters, int most) {
    for (; at != end && most > 0 && characters.find(*at) != std::string_view::npos; --most)
      ++at;
  };
  constexpr int any = 1 << 30;
  for (skip(blanks, any); at != end; skip(blanks, any)) {
    if (!numbers.empty()) {
      skip(",;|", 1);
      skip(blanks, any);
    }
    skip("+", 1);
    double number = 0;
    const auto [stop, problem] = std::from_chars(at, end, number);
    if (problem != std::errc() || !std::isfinite(number))
      return std::nullopt;
    at = stop;
    if (at != end && (blanks.find(*at) == std::string_view::npos) && *at != ',' && *at != ';' &&
        *at != '|')
      return std::nullopt;
    numbers.push_back(number);
  }
  return numbers.empty() ? std::nullopt : std::optional(numbers);
}

void parse_ids(const LineReader& reader, const std::int64_t* ids, std::int64_t points,
               std::vector<std::int32_t>& faces, std::int64_t first, std::int64_t count) {
  for (std::int64_t i = 0; i < count; ++i) {
    if (ids[i] < first || ids[i] - first >= points)
      reader.fail("id {} is not one of the {} points; ids count from {}", ids[i], points, first);
    faces.push_back(static_cast<std::int32_t>(ids[i] - first));
  }
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

std::size_t end_of_quoted(std::string_view line, std::size_t begin) {
  if (begin >= line.size() || line[begin] != '"')
    return begin;
  for (std::size_t end = begin + 1; end < line.size(); ++end)
    if (line[end] == '"' && line.substr(end + 1, 1) != "\"")
      return end + 1;
    else if (line[end] == '"')
      ++end;
  return line.size();
}

std::string_view without_comment(std::string_view line) {
  const std::size_t mark = line.find('#');
  if (mark == line.npos || line.substr(0, mark).find('"') == line.npos)
    return line.substr(0, mark);
  bool begins = true; // a column
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (begins)
      i = end_of_quoted(line, i);
    if (i < line.size() && line[i] == '#')
      return line.substr(0, i);
    begins = i < line.size() && (is_blank(line[i]) || is_mark(line[i]));
  }
  return line;
}

bool has_number(std::string_view line) {
  const char* const end = line.data() + line.size();
  for (const char* p = line.data(); p != end;) {
    const char* const stop = column_end(p, end);
    double value;
    std::string_view column(p, static_cast<std::size_t>(stop - p));
    if (column.size() > 2 && column.front() == '"' && column.back() == '"')
      column = column.substr(1, column.size() - 2);
    if (parse_columns(column, 1, &value).outcome == Outcome::ok)
      return true;
    p = stop == end ? end : stop + 1;
  }
  return false;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return message("\"{}{}\"", shown, text.size() > longest ? "..." : "");
}

std::string describe(const Columned& read) {
  if (read.outcome == Outcome::too_few)
    return "too few columns";
  if (read.outcome == Outcome::out_of_range)
    return in_quotes(read.text) + " is out of range";
  return read.text.empty() ? "a column is empty" : in_quotes(read.text) + " is not a number";
}

std::string_view line_with(LineReader& reader, const std::string& awaited) {
  std::string_view line;
  if (!reader.next_content(line))
    reader.fail("the file ends before {}; it is incomplete; make it again", awaited);
  return line;
}

void require_columns(const LineReader& reader, const Columned& read, int count) {
  if (read.outcome == Outcome::too_few)
    reader.fail("fewer than {} columns", count);
  if (read.outcome != Outcome::ok)
    reader.fail(describe(read));
}

void require_columns(const LineReader& reader, const Columned& read, const std::string& awaited) {
  if (read.outcome != Outcome::ok)
    reader.fail("{} where {} belongs", describe(read), awaited);
}

Writer::Writer(Sink sink) : sink_(std::move(sink)) { buffer_.reserve(buffer_bytes + 64); }

Writer& Writer::text(std::string_view bytes) {
  if (bytes.size() > buffer_bytes) {
    flush();
    sink_(bytes);
    return *this;
  }
  buffer_.append(bytes);
  if (buffer_.size() >= buffer_bytes)
    flush();
  return *this;
}

Writer& Writer::number(double value) {
  char digits[32];
  return text({digits, std::to_chars(digits, digits + sizeof digits, value).ptr});
}

Writer& Writer::number(std::int64_t value) {
  char digits[32];
  return text({digits, std::to_chars(digits, digits + sizeof digits, value).ptr});
}

void Writer::flush() {
  sink_(buffer_);
  buffer_.clear();
}

} // namespace calotte::io_detail
