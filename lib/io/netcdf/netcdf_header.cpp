// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_header.h"

#include "io/bytes/file.h"
#include "io/bytes/utf8.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <set>

namespace calotte::io_detail {
namespace {

enum Tag : std::int64_t {
  absent = 0,
  dimensions_follow = 10,
  variables_follow = 11,
  attributes_follow = 12
};

/// Of all lists: dimensions, variables and attributes. The C library takes quadratic time for some.
constexpr std::int64_t most_entries = 200'000;

std::int64_t padded(std::int64_t bytes) { return (bytes + 3) / 4 * 4; }

/// A variable's bytes in one record, or in all where it has none; -1 past 64 bits.
struct Shape {
  std::int64_t bytes = 0;
  bool of_records = false;
};

/// Reads the header of a classic file from its first byte on.
class HeaderWalk {
public:
  explicit HeaderWalk(const std::string& path)
      : path_(path), in_(open_input(path)), size_(static_cast<std::int64_t>(bytes_left(in_))) {
    char magic[4] = {};
    read_some(in_, magic, sizeof magic, path_);
    position_ = sizeof magic;
    version_ = in_ ? magic[3] : 0;
  }

  NetcdfLayout layout() {
    NetcdfLayout layout;
    records_ = records();
    read_dimensions();
    attributes();
    std::vector<Shape> shapes;
    const std::int64_t variables = list_of(variables_follow, "variables");
    std::set<std::string> names;
    for (std::int64_t v = 0; v < variables; ++v) {
      layout.variables.push_back({.name = new_name(names)});
      shapes.push_back(shape());
      layout.variables.back().begin = number(version_ == 1 ? 4 : 8);
    }
    layout.header = position_;
    add_ends(shapes, layout.variables);
    return layout;
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::parse, path_ + ": " + problem + "; make it again");
  }
  [[noreturn]] void damaged(const std::string& what) const {
    fail("its header is damaged: byte " + std::to_string(position_) + " " + what);
  }
  void require(bool truth, const std::string& what) const {
    if (!truth)
      damaged(what);
  }
  void require_left(std::int64_t bytes) const {
    if (bytes > size_ - position_)
      fail("it is cut short: its header is incomplete");
  }

  std::int64_t count_size() const { return version_ == 5 ? 8 : 4; }

  /// A number of 4 or 8 bytes.
  std::int64_t number(std::int64_t bytes) {
    require_left(bytes);
    std::array<char, 8> text{};
    read_some(in_, text.data(), bytes, path_);
    position_ += bytes;
    std::uint64_t value = 0;
    for (std::int64_t i = 0; i < bytes; ++i)
      value = value << 8U | static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
    require(value <= INT64_MAX, "has a number that is too large");
    return static_cast<std::int64_t>(value);
  }
  std::int64_t count() { return number(count_size()); }

  void skip(std::int64_t bytes) {
    require_left(bytes);
    position_ += bytes;
    in_.seekg(position_);
  }

  std::string name() {
    const std::int64_t length = count();
    require(length > 0 && length <= NC_MAX_NAME, "has a name without or with too many letters");
    require_left(padded(length));
    std::string text(static_cast<std::size_t>(length), '\0');
    read_some(in_, text.data(), length, path_);
    position_ += length;
    skip(padded(length) - length);
    require(text.find('\0') == std::string::npos && text.find('/') == std::string::npos &&
                is_utf8(text),
            "ends a name with a letter that names do not have");
    return text;
  }
  std::string new_name(std::set<std::string>& names) {
    std::string text = name();
    require(names.insert(text).second, "ends a name that occurs twice");
    return text;
  }

  /// The number of entries of a list that begins with a tag.
  std::int64_t list_of(Tag tag, const std::string& what) {
    const std::int64_t found = number(4), entries = count();
    require(found == tag || (found == absent && entries == 0), "does not follow a list of " + what);
    require_left(entries); // each takes a byte at least
    entries_ += entries;
    require(entries_ <= most_entries, "follows a list of more entries than Calotte reads");
    return entries;
  }

  /// The number of bytes of a value of the type that comes next.
  std::int64_t type_size() {
    constexpr std::array<std::int64_t, 12> sizes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    const std::int64_t type = number(4);
    require(type >= 1 && type <= (version_ == 5 ? 11 : 6), "follows a type that there is not");
    return sizes[static_cast<std::size_t>(type)];
  }

  std::int64_t records() {
    const std::int64_t streaming = version_ == 5 ? INT64_MAX : 0xffffffff;
    const std::int64_t found = count();
    require(found < streaming, "follows no number of records");
    return found;
  }

  void read_dimensions() {
    const std::int64_t entries = list_of(dimensions_follow, "dimensions");
    std::set<std::string> names;
    for (std::int64_t d = 0; d < entries; ++d) {
      new_name(names);
      dimensions_.push_back(count());
      require(dimensions_.back() > 0 || std::count(dimensions_.begin(), dimensions_.end(), 0) == 1,
              "follows a second dimension of records");
    }
  }

  void attributes() {
    const std::int64_t entries = list_of(attributes_follow, "attributes");
    std::set<std::string> names;
    for (std::int64_t a = 0; a < entries; ++a) {
      new_name(names);
      const std::int64_t size = type_size(), values = count();
      require_left(values);
      skip(padded(size * values));
    }
  }

  /// Of the next variable, after its name and up to its offset. The size that the file gives is
  /// redundant, and too small for large variables.
  Shape shape() {
    const std::int64_t rank = count();
    require(rank <= NC_MAX_VAR_DIMS, "follows a variable of too many dimensions");
    Shape shape{1, false};
    for (std::int64_t d = 0; d < rank; ++d) {
      const std::int64_t id = count();
      require(id < std::ssize(dimensions_), "follows a dimension that there is not");
      const std::int64_t length = dimensions_[static_cast<std::size_t>(id)];
      require(length > 0 || d == 0, "follows a dimension of records that is not the first");
      shape.of_records |= length == 0;
      if (length > 0 && shape.bytes >= 0 &&
          __builtin_mul_overflow(shape.bytes, length, &shape.bytes))
        shape.bytes = -1;
    }
    attributes();
    if (const std::int64_t size = type_size();
        shape.bytes >= 0 && __builtin_mul_overflow(shape.bytes, size, &shape.bytes))
      shape.bytes = -1;
    count();
    return shape;
  }

  /// Ends are limited to the range of 64 bits, which no file exceeds.
  void add_ends(const std::vector<Shape>& shapes, std::vector<NetcdfExtent>& extents) const {
    std::int64_t record = 0, record_variables = 0;
    bool overflow = false;
    for (const Shape& shape : shapes)
      if (shape.of_records) {
        overflow |= shape.bytes > INT64_MAX - 3 ||
                    __builtin_add_overflow(record, padded(shape.bytes), &record);
        ++record_variables;
      }
    for (std::size_t v = 0; v < extents.size(); ++v) {
      const Shape& shape = shapes[v];
      NetcdfExtent& extent = extents[v];
      std::int64_t before_last = 0;
      if (shape.of_records)
        extent.stride = record_variables == 1 ? shape.bytes : record;
      if (shape.of_records && records_ > 0)
        overflow |= __builtin_mul_overflow(extent.stride, records_ - 1, &before_last);
      overflow |= shape.bytes < 0 ||
                  __builtin_add_overflow(before_last, extent.begin, &before_last) ||
                  __builtin_add_overflow(before_last, shape.bytes, &extent.end);
      if (overflow)
        extent.end = INT64_MAX;
      if (shape.of_records && records_ == 0) // its first byte may be past the end of the file
        extent.end = position_;
    }
  }

  std::string path_;
  std::ifstream in_;
  std::int64_t size_ = 0, position_ = 0, records_ = 0;
  std::int64_t entries_ = 0; ///< of all lists
  int version_ = 0;
  std::vector<std::int64_t> dimensions_; ///< lengths, 0 for that of the records
};

} // namespace

bool is_classic_netcdf(const std::string& path) {
  std::ifstream in = open_input(path);
  char magic[4] = {};
  read_some(in, magic, sizeof magic, path);
  return in && std::memcmp(magic, "CDF", 3) == 0 &&
         (magic[3] == 1 || magic[3] == 2 || magic[3] == 5);
}

NetcdfLayout classic_layout(const std::string& path) { return HeaderWalk(path).layout(); }

bool needs_cdf5(const std::vector<std::int64_t>& variable_bytes) {
  // The header holds a variable's size in 32 bits, rounded up to 4 bytes.
  constexpr std::int64_t most = (std::int64_t{1} << 32) - 4;
  return std::any_of(variable_bytes.begin(), variable_bytes.end(),
                     [](std::int64_t bytes) { return bytes >= most; });
}

} // namespace calotte::io_detail
