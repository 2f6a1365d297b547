// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/shapes/points_text.h"
#include "base/lonlat.h"
#include "base/points.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"

#include <calotte/read.h>
#include <calotte/write.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>
#include <ostream>

namespace calotte {
namespace {

using io_detail::Columned;
using io_detail::LineReader;
using io_detail::Outcome;

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

LineFormat line_format(Columns columns) {
  if (columns == Columns::lonlat)
    return {2,
            "write longitude and latitude in degrees on each line",
            "id lon lat, or lon lat value",
            "",
            "direction",
            require_latitude,
            append_lonlat};
  if (columns == Columns::xy)
    return {2,
            "write two numbers x y on each line",
            "id x y, or x y value",
            "",
            "place",
            [](const LineReader&, const double*) {},
            append_xy};
  return {3,
          "write three numbers x y z on each line",
          "id x y z, or x y z value",
          ", or read them as longitude and latitude, or as places in a plane",
          "direction",
          require_direction,
          append_xyz};
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

// ---- Headers

/// Splits a line into columns at a separator or at blanks. Removes quotes and blanks around them.
std::vector<std::string_view> split_columns(std::string_view line, char separator) {
  constexpr std::string_view around = " \t\r\"'";
  std::vector<std::string_view> columns;
  const auto is_end = [&](char c) {
    return separator == ' ' ? c == ' ' || c == '\t' : c == separator;
  };
  for (std::size_t begin = 0; begin <= line.size();) {
    std::size_t end = begin;
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
  return columns;
}

/// The columns of the coordinates according to the first line of a file.
struct Header {
  char separator = ' ';
  std::array<std::size_t, 3> column{};
  bool first = true;                 ///< whether they are the first columns, in order
  std::size_t names = 0, wanted = 0; ///< number of all columns, and of the coordinates
};

/// Finds the separator of a line. It may differ from that of the header.
char find_separator(std::string_view line) {
  const std::size_t at = line.find_first_of(",;|\t");
  return at == std::string_view::npos ? ' ' : line[at];
}

/// The letters at the start of a name such as "Latitude [deg]", in lower case.
std::string leading_letters(std::string_view name) {
  std::string letters;
  for (const char c : name)
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else
      break;
  return letters;
}

/// Parses a header. Returns none unless it names the coordinates.
std::optional<Header> parse_header(std::string_view line, Columns columns) {
  using Names = std::vector<std::string_view>;
  const std::vector<Names> wanted =
      columns == Columns::lonlat
          ? std::vector<Names>{{"lon", "longitude", "long", "lng", "x"}, {"lat", "latitude", "y"}}
      : columns == Columns::xy ? std::vector<Names>{{"x"}, {"y"}}
                               : std::vector<Names>{{"x"}, {"y"}, {"z"}};
  Header header;
  header.separator = find_separator(line);
  std::vector<std::string> names;
  for (const std::string_view name : split_columns(line, header.separator))
    names.push_back(leading_letters(name));
  header.names = names.size();
  header.wanted = wanted.size();
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    auto found = names.end();
    for (const std::string_view known : wanted[k]) // the first that there is
      if (found == names.end())
        found = std::find(names.begin(), names.end(), known);
    if (found == names.end())
      return std::nullopt;
    header.column[k] = static_cast<std::size_t>(found - names.begin());
    header.first = header.first && header.column[k] == k;
  }
  return header;
}

Columned parse_named(std::string_view line, const Header& header, int count, double* values) {
  const std::vector<std::string_view> columns = split_columns(line, header.separator);
  for (int k = 0; k < count; ++k) {
    const std::size_t at = header.column[static_cast<std::size_t>(k)];
    if (at >= columns.size())
      return {Outcome::too_few, static_cast<int>(columns.size()), {}};
    const Columned read = io_detail::parse_columns(columns[at], 1, values + k);
    if (read.outcome != Outcome::ok)
      return {read.outcome == Outcome::too_few ? Outcome::no_number : read.outcome, k, columns[at]};
  }
  return {};
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
bool has_decimal_commas(std::string_view line, int count, const std::optional<Header>& header) {
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

/// Checks whether the first column is not a coordinate, in files with more columns than are read:
/// it then numbers the lines, or is not a longitude.
class FirstColumn {
public:
  FirstColumn(Columns columns, const LineFormat& format)
      : lonlat_(columns == Columns::lonlat), format_(format) {}

  bool has_further() const { return further_; }

  /// \param named whether a header names the columns.
  void take(const LineReader& reader, std::string_view line, double value, bool named) {
    if (lines_++ == 0) {
      double values[4];
      further_ =
          io_detail::parse_columns(line, format_.columns + 1, values).outcome != Outcome::too_few;
      counts_ = further_ && !named && value == std::floor(value);
      begin_ = value;
    }
    counts_ = counts_ && value == begin_ + static_cast<double>(lines_ - 1);
    if (further_ && !named && lonlat_ && std::abs(value) > 360)
      refuse(reader, "the first column is no longitude");
  }
  /// \param fewest number of lines that are sufficient evidence.
  void require_no_count(const LineReader& reader, std::int64_t fewest) const {
    if (counts_ && lines_ >= fewest)
      refuse(reader, "the first column counts the lines");
  }

private:
  [[noreturn]] void refuse(const LineReader& reader, const std::string& what) const {
    reader.fail("{}, and there are more than {}; write a header that names the columns, such as {}",
                what, format_.columns, format_.headers);
  }

  bool lonlat_;
  const LineFormat& format_;
  std::int64_t lines_ = 0;
  double begin_ = 0;
  bool further_ = false, counts_ = false;
};

PointLines read_rows(std::istream& in, const std::string& name, Columns columns) {
  const LineFormat format = line_format(columns);
  LineReader reader(in, name);
  PointLines result;
  std::vector<double> coordinates;
  bool header = false;
  std::optional<Header> names;
  FirstColumn first(columns, format);
  for (std::string_view line; reader.next(line);) {
    const std::size_t comment = line.find('#');
    const std::string_view content = line.substr(0, comment);
    if (content.find_first_not_of(" \t\r") == std::string_view::npos) {
      if (comment != std::string_view::npos && coordinates.empty() && !header)
        names = parse_header(line.substr(comment + 1), columns);
      continue;
    }
    line = content;
    if (coordinates.empty() && names && !header) { // "# lat lon", or a sentence
      const bool is_list = names->separator != ' ' || names->names == names->wanted;
      names->separator = find_separator(line);
      if (!is_list || split_columns(line, names->separator).size() != names->names)
        names.reset();
    }
    double values[3];
    if (has_decimal_commas(line, format.columns, names))
      reader.fail("commas separate columns; write numbers with decimal points");
    const Columned read = names && !names->first
                              ? parse_named(line, *names, format.columns, values)
                              : io_detail::parse_columns(line, format.columns, values);
    if (read.outcome != Outcome::ok) {
      if (header || !coordinates.empty() || io_detail::has_number(line))
        refuse_line(reader, read, format);
      header = true;
      if (const std::optional<Header> found = parse_header(line, columns))
        names = found;
      continue;
    }
    require_finite(reader, values, format);
    first.take(reader, line, values[0], names.has_value());
    if (columns == Columns::lonlat && std::abs(values[1]) > 90) // an id may precede the longitude
      first.require_no_count(reader, 1);
    format.require(reader, values);
    format.append(coordinates, values);
    result.lines.push_back(reader.number());
  }
  if (coordinates.empty())
    io_detail::fail_file(name, "no points in {} {}; {}", reader.number(),
                         reader.number() == 1 ? "line" : "lines", format.expected);
  first.require_no_count(reader, 3);
  result.further_columns = first.has_further() && !names;
  result.points = Eigen::Map<const Points3>(coordinates.data(), 3, std::ssize(coordinates) / 3);
  return result;
}

} // namespace

PointLines read_point_lines(std::istream& in, const std::string& name, Columns columns) {
  return read_rows(in, name, columns);
}

PointLines read_point_lines(const std::string& path, Columns columns) {
  std::ifstream in = io_detail::open_input(path);
  return read_rows(in, path, columns);
}

Points3 read_points(std::istream& in, const std::string& name, Columns columns) {
  return read_rows(in, name, columns).points;
}

Points3 read_points(const std::string& path, Columns columns) {
  return read_point_lines(path, columns).points;
}

namespace {

// ---- Writing

/// Writes each column on a line, with blanks between its coordinates.
void put_rows(const io_detail::Sink& sink, const PointsRef& points) {
  io_detail::Writer out(sink);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    for (Eigen::Index j = 0; j < points.rows(); ++j)
      out.number(points(j, i)).text(j + 1 == points.rows() ? "\n" : " ");
  out.flush();
}

void require_2_or_3_rows(const PointsRef& points) {
  if (points.rows() != 3)
    base_detail::require_rows(points, 2, "2 x n columns x y, or 3 x n columns x y z", {});
}

} // namespace

void io_detail::put_points(const Sink& sink, const Points3& points) { put_rows(sink, points); }

void write_points(const std::string& path, const PointsRef& points) {
  require_2_or_3_rows(points);
  io_detail::OutputFile file(path);
  put_rows([&](std::string_view bytes) { file.append(bytes); }, points);
  file.commit();
}

void write_points(std::ostream& out, const PointsRef& points) {
  require_2_or_3_rows(points);
  put_rows(
      [&](std::string_view bytes) {
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      },
      points);
  if (!out.flush())
    io_detail::fail_write("the points", "the stream failed; make room or write elsewhere");
}

} // namespace calotte
