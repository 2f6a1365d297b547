// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"
#include "io/bytes/file.h"
#include "io/bytes/file_error.h"
#include "io/bytes/scalars.h"
#include "io/formats/formats.h"
#include "io/formats/poly_data.h"

#include <array>
#include <bit>
#include <optional>
#include <utility>

// The Stanford polygon format (Turk, 1994) as other programs write it: in text or in binary of
// either order of bytes, with properties and elements besides those of a mesh.

namespace calotte::io_detail {
namespace {

// ---- The head

struct Property {
  std::string name;
  Scalar type = Scalar::float64;
  std::optional<Scalar> count; ///< for a list: type of the number of items that precedes them
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct Head {
  bool binary = false, swapped = false;
  std::vector<Element> elements;
};

constexpr std::array<std::pair<std::string_view, Scalar>, 18> ply_types{
    {{"char", Scalar::int8},
     {"int8", Scalar::int8},
     {"uchar", Scalar::uint8},
     {"uint8", Scalar::uint8},
     {"short", Scalar::int16},
     {"int16", Scalar::int16},
     {"ushort", Scalar::uint16},
     {"uint16", Scalar::uint16},
     {"int", Scalar::int32},
     {"int32", Scalar::int32},
     {"uint", Scalar::uint32},
     {"uint32", Scalar::uint32},
     {"int64", Scalar::int64},
     {"uint64", Scalar::uint64},
     {"float", Scalar::float32},
     {"float32", Scalar::float32},
     {"double", Scalar::float64},
     {"float64", Scalar::float64}}};

Scalar parse_type(std::string_view word, const std::string& name) {
  for (const auto& [text, type] : ply_types)
    if (text == word)
      return type;
  fail_damaged(name, "{} is not a type of .ply files", in_quotes(word));
}

void read_format(std::string_view words, const std::string& name, Head& head) {
  const std::string_view format = take_word(words);
  const bool big = format == "binary_big_endian";
  head.binary = big || format == "binary_little_endian";
  head.swapped = big == (std::endian::native == std::endian::little);
  if (!head.binary && format != "ascii")
    fail_damaged(name, "its format {} is not ascii, binary_little_endian or binary_big_endian",
                 in_quotes(format));
}

Element parse_element(std::string_view words, const std::string& name) {
  Element element{std::string(take_word(words)), 0, {}};
  const std::string_view count = take_word(words);
  std::int32_t number = -1;
  if (!parse_number(count, Scalar::int64, number) || number < 0)
    fail_damaged(name, "the number of element {} is {}, not one from 0 to 2147483647",
                 in_quotes(element.name), in_quotes(count));
  element.count = number;
  return element;
}

Property parse_property(std::string_view words, const std::string& name) {
  std::string_view word = take_word(words);
  Property property;
  if (word == "list") {
    property.count = parse_type(take_word(words), name);
    word = take_word(words);
  }
  property.type = parse_type(word, name);
  property.name = take_word(words);
  return property;
}

/// \throws Error parse for a file that does not start as a .ply file.
void require_ply(std::string_view start, const std::string& name) {
  if (take_word(start) != "ply")
    fail_file(name, "it does not start with the line \"ply\", so it is no .ply file");
}

/// Removes the head, up to the end of its last line, from the content of a file, and parses it.
Head take_head(std::string_view& content, const std::string& name) {
  constexpr int most_lines = 100'000; // so that memory stays in proportion to the file
  Head head;
  for (int lines = 0; lines < most_lines; ++lines) {
    const bool first = lines == 0;
    const std::size_t end = content.find('\n');
    std::string_view line = content.substr(0, end);
    const std::string_view keyword = take_word(line);
    if (end == std::string_view::npos)
      fail_damaged(name, "its head has no end_header");
    content.remove_prefix(end + 1);
    if (keyword == "end_header")
      return head;
    if (keyword == "format")
      read_format(line, name, head);
    else if (keyword == "element")
      head.elements.push_back(parse_element(line, name));
    else if (keyword == "property" && !head.elements.empty())
      head.elements.back().properties.push_back(parse_property(line, name));
    else if (!first && keyword != "comment" && keyword != "obj_info" && !keyword.empty())
      fail_damaged(name, "{} is not a keyword of the head of a .ply file", in_quotes(keyword));
  }
  fail_damaged(name, "its head has more than {} lines", most_lines);
}

// ---- The rows

/// The content after the head, number by number.
class Body {
public:
  Body(std::string_view rest, const Head& head, const std::string& name)
      : rest_(rest), head_(head), name_(name) {}

  /// \throws Error parse if the file is too short for the rows of an element.
  void require_rows(const Element& element) const {
    std::int64_t least = 0;
    for (const Property& property : element.properties)
      least += head_.binary ? size_of(property.count.value_or(property.type)) : 2;
    if (least > 0 && element.count > (size() + 1) / least)
      fail_row(element, 0, message("the file ends before its {} rows", element.count));
  }

  template <class T> T take(const Element& element, Scalar type, std::int64_t row) {
    T number{};
    if (head_.binary) {
      const std::int64_t width = size_of(type);
      require(element, row, width);
      number = stored_as<T>(rest_.data(), type, head_.swapped);
      rest_.remove_prefix(static_cast<std::size_t>(width));
    } else if (const std::string_view word = take_word(rest_); !parse_number(word, type, number)) {
      fail_row(element, row,
               word.empty() ? "the file ends before"
                            : message("{} is not a number of its type", in_quotes(word)));
    }
    return number;
  }

  /// Reads the number of items of a list. The file must be long enough for them.
  std::int64_t take_count(const Element& element, const Property& property, std::int64_t row) {
    const auto count = take<std::int64_t>(element, *property.count, row);
    if (count < 0 || count > size())
      fail_row(element, row,
               message("the number of items of {} is invalid", in_quotes(property.name)));
    return count;
  }

  void skip(const Element& element, const Property& property, std::int64_t row) {
    const std::int64_t count = property.count ? take_count(element, property, row) : 1;
    if (head_.binary) {
      const std::int64_t bytes = count * size_of(property.type);
      require(element, row, bytes);
      rest_.remove_prefix(static_cast<std::size_t>(bytes));
    } else {
      for (std::int64_t k = 0; k < count; ++k)
        take<double>(element, property.type, row);
    }
  }

  void finish() const {
    std::string_view rest = rest_;
    if (!take_word(rest).empty())
      fail_damaged(name_, "{} bytes follow after its last element", size());
  }

  [[noreturn]] void fail_row(const Element& element, std::int64_t row,
                             const std::string& problem) const {
    fail_file(name_, row, "element {}, row {} (0-based): {}{}", in_quotes(element.name), row,
              problem, damaged);
  }

private:
  std::int64_t size() const { return static_cast<std::int64_t>(rest_.size()); }
  void require(const Element& element, std::int64_t row, std::int64_t bytes) const {
    if (bytes > size())
      fail_row(element, row, "the file ends before");
  }

  std::string_view rest_;
  const Head& head_;
  const std::string& name_;
};

/// The coordinate that a property is: 0 to 2 for x to z, or -1.
int find_coordinate(const Property& property) {
  const bool coordinate = !property.count && property.name.size() == 1 && 'x' <= property.name[0] &&
                          property.name[0] <= 'z';
  return coordinate ? property.name[0] - 'x' : -1;
}

bool lists_corners(const Property& property) {
  return property.count && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// \throws Error parse, unless `count` properties are wanted.
template <class Wanted>
void require_properties(const Element& element, const Wanted& wanted, std::ptrdiff_t count,
                        const std::string& what, const std::string& name) {
  if (std::count_if(element.properties.begin(), element.properties.end(), wanted) != count)
    fail_damaged(name, "its element {} does not have {}", in_quotes(element.name), what);
}

void read_points(const Element& element, const std::string& name, Body& body, PolyData& poly_data) {
  require_properties(
      element, [](const Property& p) { return find_coordinate(p) >= 0; }, 3,
      "the properties x, y and z once each", name);
  poly_data.points.resize(3, element.count);
  for (std::int64_t row = 0; row < element.count; ++row)
    for (const Property& property : element.properties)
      if (const int k = find_coordinate(property); k >= 0)
        poly_data.points(k, row) = body.take<double>(element, property.type, row);
      else
        body.skip(element, property, row);
  for (const Property& property : element.properties)
    if (find_coordinate(property) < 0)
      poly_data.ignored.push_back(property.name);
    else
      poly_data.single |= property.type == Scalar::float32;
}

void read_faces(const Element& element, const std::string& name, Body& body, PolyData& poly_data) {
  require_properties(element, lists_corners, 1, "one list vertex_indices or vertex_index", name);
  std::vector<std::int32_t> ids;
  poly_data.ids.begin = Offsets::Zero(element.count + 1);
  for (std::int64_t row = 0; row < element.count; ++row) {
    for (const Property& property : element.properties) {
      if (!lists_corners(property)) {
        body.skip(element, property, row);
        continue;
      }
      const std::int64_t corners = body.take_count(element, property, row);
      for (std::int64_t k = 0; k < corners; ++k)
        ids.push_back(body.take<std::int32_t>(element, property.type, row));
    }
    poly_data.ids.begin[row + 1] = std::ssize(ids);
  }
  poly_data.ids.items = Eigen::Map<const Ids>(ids.data(), std::ssize(ids));
  for (const Property& property : element.properties)
    if (!lists_corners(property))
      poly_data.ignored.push_back(property.name);
}

void skip_rows(const Element& element, Body& body, PolyData& poly_data) {
  if (!element.properties.empty())
    for (std::int64_t row = 0; row < element.count; ++row)
      for (const Property& property : element.properties)
        body.skip(element, property, row);
  poly_data.ignored.push_back(element.name);
}

} // namespace

RawMesh get_ply(std::istream& in, const std::string& name) {
  const std::string content = read_all(in, name, require_ply);
  std::string_view rest = content;
  const Head head = take_head(rest, name);
  Body body(rest, head, name);
  PolyData poly_data;
  for (const Element& element : head.elements) {
    if (element.name == "tristrips")
      fail_file(name, "it has triangle strips, which are not read; write triangles");
    body.require_rows(element);
    if (element.name == "vertex")
      read_points(element, name, body, poly_data);
    else if (element.name == "face")
      read_faces(element, name, body, poly_data);
    else
      skip_rows(element, body, poly_data);
  }
  body.finish();
  require_polygons(name, poly_data, {"face", "face"});
  return make_raw_mesh(name, std::move(poly_data));
}

} // namespace calotte::io_detail
