// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/value_rows.h"
#include "base/message.h"
#include "base/require.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/shapes/text_parts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <istream>
#include <limits>
#include <utility>

namespace calotte::io_detail {
namespace {

using base_detail::counted, base_detail::listed, base_detail::message;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What to write in place of a text that is no number.
std::string remedy(std::string_view text, bool optional) {
  if (text.find(',') != text.npos && text.find_first_not_of("0123456789+-,.eE ") == text.npos)
    return "write numbers with decimal points";
  return optional ? "write a number, or NaN where there is none" : "write a number";
}

bool is_number_of_column(const std::string& text) {
  return !text.empty() && text.size() < 7 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

} // namespace

void ValueRows::clear() {
  coordinates.clear();
  points.clear();
  values.clear();
}

void ValueRows::append(const ValueRows& next) {
  const auto add = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  add(coordinates, next.coordinates);
  add(points, next.points);
  add(values, next.values);
}

ValueParser::ValueParser(ColumnChoice choice) : choice_(std::move(choice)), first_(kind()) {}

void ValueParser::parse(const LineReader& reader, std::string_view line, ValueRows& rows) {
  const std::string_view content = without_comment(line);
  if (content.find_first_not_of(" \t\r") == std::string_view::npos) {
    if (content.size() < line.size() && !has_points())
      if (const std::string_view comment = line.substr(content.size() + 1);
          may_be_header(comment, kind()))
        comments_.push_back({std::string(comment), reader.number()});
    return;
  }
  if (!has_points() && header_.empty() && (!has_number(content) || parse_header(content, kind()))) {
    header_ = content;
    header_line_ = reader.number();
    return;
  }
  if (!has_points())
    begin(reader, content);
  split_columns(content, columns_.separator, texts_);
  if (texts_.size() != columns_.count)
    reader.fail("{}, and {} has {}; give each row the same columns, with NaN where there is no "
                "value",
                counted(std::ssize(texts_), "column"),
                header_.empty() ? message("line {}", first_line_) : "the header", columns_.count);
  const double at[2] = {coordinate(reader, columns_.position[0]),
                        coordinate(reader, columns_.position[1])};
  first_.take(reader, content, at[0], columns_.named);
  append_position(reader, kind(), at, rows.points);
  rows.coordinates.insert(rows.coordinates.end(), {at[0], at[1]});
  for (std::size_t k = 0; k < columns_.fields.size(); ++k)
    rows.values.push_back(value(reader, k));
}

/// Chooses the columns by the header and the first row.
void ValueParser::begin(const LineReader& reader, std::string_view line) {
  first_line_ = reader.number();
  if (header_.empty())
    if (const Comment* const comment = find_header(comments_, line, kind()))
      header_ = comment->text, header_line_ = comment->line;
  columns_.separator = find_separator(line, header_.empty() ? ' ' : find_separator(header_));
  split_columns(line, columns_.separator, texts_);
  columns_.count = texts_.size();
  if (!header_.empty())
    for (const std::string_view name : split_columns(header_, find_separator(header_)))
      names_.emplace_back(name);
  if (!names_.empty() && names_.size() != columns_.count)
    reader.fail("{}, and the header names {}; give each row the columns of the header, with NaN "
                "where there is no value",
                counted(std::ssize(texts_), "column"), names_.size());
  choose_position(reader);
  choose_fields(reader);
}

void ValueParser::choose_position(const LineReader& reader) {
  columns_.position = {0, 1};
  if (!choice_.position.empty()) {
    columns_.named = true;
    for (std::size_t k = 0; k < 2; ++k)
      columns_.position[k] = find(reader, choice_.position[k]);
    if (columns_.position[0] == columns_.position[1])
      reader.fail("the position has the same column twice; name two");
  } else if (const auto header = parse_header(header_, kind()); header && !names_.empty()) {
    columns_.named = true;
    columns_.position = {header->column[0], header->column[1]};
  } else if (!names_.empty()) {
    fail_at(reader.name(), header_line_,
            "the header names {}, and no {}; name the columns of the position (--position)",
            listed(names_), choice_.plane ? "x and y" : "longitude and latitude (lon, lat)");
  } else if (columns_.count < 2) {
    reader.fail("1 column only; write {} and the values on each line",
                choice_.plane ? "x y" : "longitude, latitude");
  }
  if (columns_.named)
    return;
  double value;
  for (std::size_t k = 0; k < 2; ++k)
    if (const Columned read = parse_number(texts_[k], value); read.outcome != Outcome::ok)
      reader.fail("{}; write {} on each line, then the values, or name the columns of the position "
                  "(--position)",
                  describe(read), choice_.plane ? "x y" : "longitude and latitude in degrees");
}

void ValueParser::choose_fields(const LineReader& reader) {
  if (choice_.fields) {
    for (const std::string& name : *choice_.fields)
      columns_.fields.push_back(find(reader, name));
  } else {
    for (std::size_t k = 0; k < columns_.count; ++k)
      if (k != columns_.position[0] && k != columns_.position[1] &&
          (names_.empty() || !names_[k].empty()))
        columns_.fields.push_back(k);
    if (columns_.fields.empty())
      reader.fail("no columns of values besides the position; add one");
  }
  for (const std::size_t column : columns_.fields) {
    const std::string name = name_of(column);
    if (std::ranges::find(columns_.names, name) != columns_.names.end())
      fail_at(reader.name(), std::max<std::int64_t>(header_line_, 1),
              "two columns have the name {}; choose by number (--fields)", name);
    columns_.names.push_back(name);
  }
}

std::string ValueParser::name_of(std::size_t column) const {
  return names_.empty() || names_[column].empty() ? message("column{}", column + 1)
                                                  : names_[column];
}

/// The column of a name, in any case where no other fits, or of a number from 1 on.
std::size_t ValueParser::find(const LineReader& reader, const std::string& column) const {
  if (const auto named = std::ranges::count(names_, column); named > 1)
    fail_at(reader.name(), std::max<std::int64_t>(header_line_, 1),
            "two columns have the name {}; choose by number (--fields)", column);
  else if (named == 1)
    return static_cast<std::size_t>(std::ranges::find(names_, column) - names_.begin());
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < names_.size(); ++k)
    if (lower(names_[k]) == lower(column))
      found.push_back(k);
  if (found.size() == 1)
    return found.front();
  if (is_number_of_column(column))
    if (const std::size_t number = std::stoul(column); number >= 1 && number <= columns_.count)
      return number - 1;
  if (names_.empty())
    fail_file(reader.name(), "no column {}; without a header columns have the numbers 1 to {}",
              column, columns_.count);
  fail_at(reader.name(), header_line_, "no column {}; the header names {}", column, listed(names_));
}

double ValueParser::coordinate(const LineReader& reader, std::size_t column) const {
  double value = none;
  const Columned read = parse_number(texts_[column], value);
  if (read.outcome == Outcome::ok)
    return value;
  const std::string name = names_.empty() ? message("{}", column + 1) : name_of(column);
  if (read.text.empty())
    reader.fail("the column {} of the position is empty; write a number, or remove the row", name);
  reader.fail("{}, in the column {} of the position; {}, or remove the row", describe(read), name,
              remedy(read.text, false));
}

double ValueParser::value(const LineReader& reader, std::size_t field) const {
  const std::string_view text = texts_[columns_.fields[field]];
  double value = none;
  const Columned read = parse_number(text, value);
  if (read.outcome == Outcome::ok && !std::isinf(value))
    return value;
  if (text.empty() || text == "NA" || text == "na" || text == "Na")
    return none;
  reader.fail("{}, in the column {}; {}{}",
              read.outcome == Outcome::ok ? in_quotes(text) + " is not finite" : describe(read),
              columns_.names[field], remedy(text, true),
              choice_.fields ? "" : ", or choose columns of numbers (--fields)");
}

ValueParser ValueParser::following() const {
  ValueParser next = *this;
  next.first_ = first_.following();
  return next;
}

void ValueParser::finish(const LineReader& reader) const {
  if (!has_points())
    fail_file(reader.name(), "no rows of numbers in {}; write {} and values on each line",
              counted(reader.number(), "line"),
              choice_.plane ? "x y" : "longitude and latitude in degrees");
  if (!columns_.fields.empty())
    first_.require_no_count(reader, 3);
}

namespace {

/// Positions and fields of all rows.
FieldGrid make_grid(const std::string& name, bool plane, const std::vector<std::string>& names,
                    const ValueRows& rows) {
  FieldGrid grid{.name = name};
  const auto n = std::ssize(rows.points) / 3, fields = std::ssize(names);
  Positions& positions = grid.positions.emplace();
  positions.surface = plane ? Surface::plane() : Surface::sphere();
  positions.points = Eigen::Map<const Points3>(rows.points.data(), 3, n);
  positions.coordinates = Eigen::Map<const Points2>(rows.coordinates.data(), 2, n);
  for (std::int64_t k = 0; k < fields; ++k) {
    MeshField& field = grid.fields.emplace_back();
    field.name = names[static_cast<std::size_t>(k)];
    field.values.resize(n);
    for (std::int64_t i = 0; i < n; ++i)
      field.values[i] = rows.values[static_cast<std::size_t>(i * fields + k)];
  }
  return grid;
}

} // namespace
} // namespace calotte::io_detail

namespace calotte {

FieldGrid read_positions(std::istream& in, const std::string& name, const ColumnChoice& choice) {
  using namespace io_detail;
  base_detail::require(choice.position.empty() || choice.position.size() == 2,
                       "the position has {} columns; name two, such as lon,lat",
                       choice.position.size());
  LineReader reader(in, name);
  ValueRows rows;
  const ValueParser parser =
      parse_text<ValueRows>(reader, ValueParser(choice), [&](const auto& parts, const LineReader&) {
        for (const auto& part : parts)
          rows.append(part.rows);
      });
  parser.finish(reader);
  return make_grid(name, choice.plane, parser.names(), rows);
}

FieldGrid read_positions(const std::string& path, const ColumnChoice& choice) {
  std::ifstream in = io_detail::open_input(path);
  return read_positions(in, path, choice);
}

} // namespace calotte
