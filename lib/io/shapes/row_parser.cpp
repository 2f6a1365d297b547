// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/row_parser.h"
#include "base/lonlat.h"
#include "io/bytes/file_error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ranges>
#include <string>

namespace calotte::io_detail {

/// The format of a line. Texts are parts of messages.
struct LineFormat {
  int columns;
  // for messages
  const char* expected; ///< what to write in a line
  const char* headers;  ///< headers that name further columns
  const char* perhaps;  ///< a remedy where a column is missing, or empty
  const char* use;      ///< what a non-finite number cannot give
  void (*require)(const LineReader&, const double*);
  void (*append)(std::vector<double>&, const double*);
};

namespace {

void require_direction(const LineReader& reader, const double* values) {
  if (values[0] == 0 && values[1] == 0 && values[2] == 0)
    reader.fail("the zero vector has no direction; remove the point or correct it");
}

void require_latitude(const LineReader& reader, const double* values) {
  if (std::abs(values[1]) > 90)
    reader.fail(
        "latitude {} is outside -90 to 90; write longitude first, then latitude, in degrees",
        values[1]);
}

void append_lonlat(std::vector<double>& coordinates, const double* values) {
  const base_detail::Vec3 p = base_detail::from_lonlat(values[0], values[1]);
  coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
}

void append_xyz(std::vector<double>& coordinates, const double* values) {
  coordinates.insert(coordinates.end(), values, values + 3);
}

void append_xy(std::vector<double>& coordinates, const double* values) {
  coordinates.insert(coordinates.end(), {values[0], values[1], 0});
}

const LineFormat& line_format(Columns columns) {
  static constexpr LineFormat lonlat{2,
                                     "write longitude and latitude in degrees on each line",
                                     "id lon lat, or lon lat value",
                                     "",
                                     "direction",
                                     require_latitude,
                                     append_lonlat};
  static constexpr LineFormat xy{2,
                                 "write two numbers x y on each line",
                                 "id x y, or x y value",
                                 "",
                                 "place",
                                 [](const LineReader&, const double*) {},
                                 append_xy};
  static constexpr LineFormat xyz{
      3,
      "write three numbers x y z on each line",
      "id x y z, or x y z value",
      ", or read them as longitude and latitude, or as places in a plane",
      "direction",
      require_direction,
      append_xyz};
  return columns == Columns::lonlat ? lonlat : columns == Columns::xy ? xy : xyz;
}

[[noreturn]] void refuse_line(const LineReader& reader, const Columned& read,
                              const LineFormat& format) {
  if (read.outcome != Outcome::too_few)
    reader.fail("{}; {}", describe(read), format.expected);
  reader.fail("{} {} only; {}{}", read.columns, read.columns == 1 ? "column" : "columns",
              format.expected, read.columns == 2 ? format.perhaps : "");
}

void require_finite(const LineReader& reader, const double* values, const LineFormat& format) {
  for (int i = 0; i < format.columns; ++i)
    if (!std::isfinite(values[i]))
      reader.fail("{} gives no {}; remove the point or correct it",
                  std::isnan(values[i]) ? "NaN" : "an infinite number", format.use);
}

Columned parse_named(std::string_view line, const PointHeader& header, int count, double* values,
                     std::vector<std::string_view>& texts) {
  split_columns(line, find_separator(line, header.separator), texts);
  for (int k = 0; k < count; ++k) {
    const std::size_t at = header.column[static_cast<std::size_t>(k)];
    if (at >= texts.size())
      return {Outcome::too_few, static_cast<int>(texts.size()), {}};
    if (const Columned read = parse_number(texts[at], values[k]); read.outcome != Outcome::ok)
      return {read.outcome, k, texts[at]};
  }
  return {};
}

/// Whether a name is another one and a unit, such as lat_deg, "Latitude [deg]" and "x (km)".
bool has_unit(std::string_view name, std::string_view of) {
  if (!name.starts_with(of) || name.size() == of.size())
    return false;
  const std::string_view rest = name.substr(of.size());
  return std::string_view(" [(/").find(rest[0]) != std::string_view::npos ||
         rest.starts_with("_deg") || rest == "_m" || rest == "_km";
}

int commas_in(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  int found = 0;
  for (std::size_t k = 1; k + 1 < text.size(); ++k)
    found += text[k] == ',' && is_digit(text[k - 1]) && is_digit(text[k + 1]) ? 1 : 0;
  return found;
}

/// Whether a line has decimal commas: in its columns, if semicolons separate them, or in each word,
/// if there are as many words as columns.
bool has_decimal_commas(std::string_view line, int count,
                        const std::optional<PointHeader>& header) {
  if (line.find(',') == std::string_view::npos)
    return false;
  if (line.find(';') != std::string_view::npos) {
    const std::vector<std::string_view> columns = split_columns(line, ';');
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      if (const std::size_t at = header ? header->column[k] : k;
          at < columns.size() && commas_in(columns[at]) > 0)
        return true;
    return false;
  }
  const std::vector<std::string_view> words = split_columns(line, ' ');
  return std::ssize(words) >= count &&
         std::ranges::all_of(words, [](std::string_view word) { return commas_in(word) == 1; });
}

} // namespace

// ---- Headers

void split_columns(std::string_view line, char separator, std::vector<std::string_view>& columns) {
  constexpr std::string_view around = " \t\r\"'";
  columns.clear();
  const auto is_end = [&](char c) {
    return separator == ' ' ? c == ' ' || c == '\t' : c == separator;
  };
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = begin;
    while (separator != ' ' && end < line.size() && line[end] == ' ')
      ++end;
    end = end_of_quoted(line, end);
    while (end < line.size() && !is_end(line[end]))
      ++end;
    std::string_view column = line.substr(begin, end - begin);
    const std::size_t first = column.find_first_not_of(around),
                      last = column.find_last_not_of(around);
    column = first == std::string_view::npos ? std::string_view()
                                             : column.substr(first, last - first + 1);
    if (separator != ' ' || !column.empty())
      columns.push_back(column);
    begin = end + 1;
  }
}

std::vector<std::string_view> split_columns(std::string_view line, char separator) {
  std::vector<std::string_view> columns;
  split_columns(line, separator, columns);
  return columns;
}

char find_separator(std::string_view line) {
  bool begins = true; // a column
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (begins)
      i = end_of_quoted(line, i);
    if (i < line.size() && std::string_view(",;|\t").find(line[i]) != std::string_view::npos)
      return line[i];
    begins = i < line.size() && line[i] == ' ';
  }
  return ' ';
}

char find_separator(std::string_view row, char of_header) {
  return of_header != ' ' && row.find(of_header) != row.npos ? of_header : find_separator(row);
}

std::optional<PointHeader> parse_header(std::string_view line, Columns columns) {
  using Names = std::vector<std::string_view>;
  const std::vector<Names> wanted =
      columns == Columns::lonlat
          ? std::vector<Names>{{"lon", "longitude", "long", "lng", "x"}, {"lat", "latitude", "y"}}
      : columns == Columns::xy ? std::vector<Names>{{"x"}, {"y"}}
                               : std::vector<Names>{{"x"}, {"y"}, {"z"}};
  PointHeader header;
  header.separator = find_separator(line);
  std::vector<std::string> names;
  for (const std::string_view name : split_columns(line, header.separator))
    names.push_back(lower(name));
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    auto found = names.end();
    for (const std::string_view known : wanted[k]) // the first that there is
      if (found == names.end())
        found = std::ranges::find(names, known);
    for (const std::string_view known : wanted[k])
      if (found == names.end())
        found =
            std::ranges::find_if(names, [&](const auto& name) { return has_unit(name, known); });
    if (found == names.end())
      return std::nullopt;
    header.column[k] = static_cast<std::size_t>(found - names.begin());
  }
  return header;
}

namespace {

/// Whether a header names positions, but of another kind.
bool names_other(std::string_view header, Columns columns) {
  return columns == Columns::xyz && !parse_header(header, columns) &&
         parse_header(header, Columns::lonlat);
}

/// Whether the columns of the position are the first ones.
bool is_first(const PointHeader& header, std::size_t count) {
  return std::ranges::all_of(header.column | std::views::take(count),
                             [&](std::size_t column) { return column < count; });
}

} // namespace

bool may_be_header(std::string_view comment, Columns columns) {
  return parse_header(comment, columns) || names_other(comment, columns);
}

const Comment* find_header(const std::vector<Comment>& comments, std::string_view row,
                           Columns columns) {
  const std::size_t count = split_columns(row, find_separator(row)).size();
  for (std::size_t k = comments.size(); k-- > 0;) {
    const std::string& text = comments[k].text;
    const bool other = names_other(text, columns);
    const std::optional<PointHeader> header = parse_header(text, other ? Columns::lonlat : columns);
    if (header && split_columns(text, header->separator).size() == count &&
        (header->separator != ' ' || is_first(*header, columns == Columns::xyz && !other ? 3 : 2)))
      return &comments[k];
  }
  return nullptr;
}

// ---- Positions

void append_position(const LineReader& reader, Columns columns, const double* values,
                     std::vector<double>& coordinates) {
  const LineFormat& format = line_format(columns);
  require_finite(reader, values, format);
  format.require(reader, values);
  format.append(coordinates, values);
}

FirstColumn::FirstColumn(Columns columns)
    : lonlat_(columns == Columns::lonlat), format_(&line_format(columns)) {}

void FirstColumn::take(const LineReader& reader, std::string_view line, double value, bool named) {
  if (lines_ == 0 && !follows_) {
    double values[4];
    further_ = parse_columns(line, format_->columns + 1, values).outcome != Outcome::too_few;
    counts_ = further_ && !named && value == std::floor(value);
  }
  if (lines_++ == 0)
    begin_ = value;
  counts_ = counts_ && value == begin_ + static_cast<double>(lines_ - 1);
  if (further_ && !named && lonlat_ && std::abs(value) > 360)
    refuse(reader, "the first column is no longitude");
}

void FirstColumn::require_no_count(const LineReader& reader, std::int64_t fewest) const {
  if (counts_ && lines_ >= fewest)
    refuse(reader, "the first column counts the lines");
}

FirstColumn FirstColumn::following() const {
  FirstColumn next = *this;
  next.follows_ = true;
  next.lines_ = 0;
  return next;
}

void FirstColumn::append(const FirstColumn& next) {
  if (next.lines_ == 0)
    return;
  counts_ = counts_ && next.counts_ && next.begin_ == begin_ + static_cast<double>(lines_);
  lines_ += next.lines_;
}

void FirstColumn::refuse(const LineReader& reader, const char* what) const {
  reader.fail("{}, and there are more than {}; write a header that names the columns, such as {}",
              what, format_->columns, format_->headers);
}

RowParser::RowParser(Columns columns)
    : columns_(columns), format_(&line_format(columns)), first_(columns) {}

void RowParser::parse(const LineReader& reader, std::string_view line, PointRows& rows) {
  const std::string_view content = without_comment(line);
  if (content.find_first_not_of(" \t\r") == std::string_view::npos) {
    if (content.size() < line.size() && !has_points_ && !header_)
      if (const std::string_view comment = line.substr(content.size() + 1);
          may_be_header(comment, columns_))
        comments_.push_back({std::string(comment), reader.number()});
    return;
  }
  if (!has_points_ && !header_)
    accept_comment(reader, content);
  double values[3];
  if (has_decimal_commas(content, format_->columns, names_))
    reader.fail("commas separate columns; write numbers with decimal points");
  const Columned read = names_ ? parse_named(content, *names_, format_->columns, values, texts_)
                               : parse_columns(content, format_->columns, values);
  if (read.outcome == Outcome::ok)
    add(reader, content, values, rows);
  else
    take_header(reader, content, read);
}

/// Takes the names of a comment before the first line if one fits it.
void RowParser::accept_comment(const LineReader& reader, std::string_view line) {
  if (const Comment* const comment = find_header(comments_, line, columns_)) {
    require_names(reader, comment->text);
    names_ = parse_header(comment->text, columns_);
  }
  comments_.clear();
}

/// Refuses a header that names another kind of position.
void RowParser::require_names(const LineReader& reader, std::string_view header) const {
  if (names_other(header, columns_))
    reader.fail("the header names no x, y and z; write these{}", format_->perhaps);
}

void RowParser::take_header(const LineReader& reader, std::string_view line, const Columned& read) {
  const std::optional<PointHeader> found = parse_header(line, columns_);
  if (header_ || has_points_ || (!found && has_number(line)))
    refuse_line(reader, read, *format_);
  require_names(reader, line);
  header_ = true;
  if (found)
    names_ = found;
}

void RowParser::add(const LineReader& reader, std::string_view line, const double* values,
                    PointRows& rows) {
  require_finite(reader, values, *format_);
  first_.take(reader, line, values[0], names_.has_value());
  if (columns_ == Columns::lonlat && std::abs(values[1]) > 90) // an id may precede the longitude
    first_.require_no_count(reader, 1);
  format_->require(reader, values);
  format_->append(rows.coordinates, values);
  rows.lines.push_back(reader.number());
  has_points_ = true;
}

RowParser RowParser::following() const {
  RowParser next = *this;
  next.first_ = first_.following();
  return next;
}

bool RowParser::finish(const LineReader& reader) const {
  if (!has_points_)
    fail_file(reader.name(), "no points in {} {}; {}", reader.number(),
              reader.number() == 1 ? "line" : "lines", format_->expected);
  first_.require_no_count(reader, 3);
  return first_.has_further() && !names_;
}

} // namespace calotte::io_detail
