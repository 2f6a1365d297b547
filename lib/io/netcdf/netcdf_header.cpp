// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_header.h"

#include "base/message.h"
#include "io/bytes/big_endian.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_reader.h"
#include "io/bytes/utf8.h"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <utility>

namespace calotte::io_detail {
namespace {

enum Tag : std::int64_t {
  absent = 0,
  dimensions_follow = 10,
  variables_follow = 11,
  attributes_follow = 12
};

/// Maximum number of entries of all lists: dimensions, variables and attributes. In memory an entry
/// is larger than in the file.
constexpr std::int64_t most_entries = 200'000;

std::int64_t padded(std::int64_t bytes) { return (bytes + 3) / 4 * 4; }

/// The size of a variable in bytes: of one record, or of all values if it has no records; -1 if it
/// exceeds 64 bits.
struct Shape {
  std::int64_t bytes = 0;
  bool of_records = false;
};

/// Reads the header of a classic file from its first byte on.
class HeaderWalk {
public:
  explicit HeaderWalk(const FileReader& file) : file_(file) {
    char magic[4] = {};
    take(sizeof magic, magic);
    version_ = magic[3];
  }

  NetcdfHeader header() {
    NetcdfHeader header;
    records_ = count_of_records();
    read_dimensions(header.dimensions);
    header.attributes = attributes();
    std::vector<Shape> shapes;
    const std::int64_t variables = take_list_size(variables_follow, "variables");
    std::set<std::string> names;
    for (std::int64_t v = 0; v < variables; ++v) {
      header.variables.push_back({.name = new_name(names)});
      shapes.push_back(read_shape(header.dimensions, header.variables.back()));
      header.variables.back().begin = number(version_ == 1 ? 4 : 8);
    }
    header.bytes = position_;
    add_ends(shapes, header.variables);
    return header;
  }

private:
  [[noreturn]] void fail(const std::string& problem) const {
    fail_file(file_.path(), "{}; make it again", problem);
  }
  [[noreturn]] void damaged(const std::string& what) const {
    fail(message("its header is damaged: byte {} {}", position_, what));
  }
  void require(bool truth, const std::string& what) const {
    if (!truth)
      damaged(what);
  }
  void require_left(std::int64_t bytes) const {
    if (bytes > file_.size() - position_)
      fail("it is cut short: its header is incomplete");
  }

  /// Reads the next bytes. Few bytes come from a window of the file.
  void take(std::int64_t bytes, char* out) {
    constexpr std::int64_t most = 1 << 16;
    require_left(bytes);
    if (bytes > most) {
      file_.read(position_, bytes, out);
    } else {
      if (position_ + bytes > window_begin_ + std::ssize(window_)) {
        window_.resize(static_cast<std::size_t>(std::min(most, file_.size() - position_)));
        file_.read(position_, std::ssize(window_), window_.data());
        window_begin_ = position_;
      }
      window_.copy(out, static_cast<std::size_t>(bytes),
                   static_cast<std::size_t>(position_ - window_begin_));
    }
    position_ += bytes;
  }

  std::int64_t count_size() const { return version_ == 5 ? 8 : 4; }

  /// Reads a number of 4 or 8 bytes.
  std::int64_t number(std::int64_t bytes) {
    std::array<char, 8> text{};
    take(bytes, text.data());
    std::uint64_t value = 0;
    for (std::int64_t i = 0; i < bytes; ++i)
      value = value << 8U | static_cast<unsigned char>(text[static_cast<std::size_t>(i)]);
    require(value <= INT64_MAX, "has a number that is too large");
    return static_cast<std::int64_t>(value);
  }
  std::int64_t count() { return number(count_size()); }

  /// Reads a text and the padding that follows it, up to a multiple of 4 bytes.
  std::string text(std::int64_t bytes) {
    require_left(padded(bytes));
    std::string text(static_cast<std::size_t>(bytes), '\0');
    take(bytes, text.data());
    position_ += padded(bytes) - bytes;
    return text;
  }

  std::string name() {
    const std::int64_t length = count();
    require(length > 0 && length <= NC_MAX_NAME, "has a name without or with too many letters");
    std::string text = this->text(length);
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

  /// Reads the tag of a list and the number of its entries.
  std::int64_t take_list_size(Tag tag, const std::string& what) {
    const std::int64_t found = number(4), entries = count();
    require(found == tag || (found == absent && entries == 0), "does not follow a list of " + what);
    require_left(entries); // each takes a byte at least
    entries_ += entries;
    require(entries_ <= most_entries, "follows a list of more entries than Calotte reads");
    return entries;
  }

  NetcdfType type() {
    const std::optional<NetcdfType> type = netcdf_type(number(4));
    require(type && (version_ == 5 || *type <= NetcdfType::float64),
            "follows a type that there is not");
    return *type;
  }

  std::int64_t count_of_records() {
    const std::int64_t streaming = version_ == 5 ? INT64_MAX : 0xffffffff;
    const std::int64_t found = count();
    require(found < streaming, "follows no number of records");
    return found;
  }

  void read_dimensions(std::vector<NetcdfDimension>& dimensions) {
    const std::int64_t entries = take_list_size(dimensions_follow, "dimensions");
    std::set<std::string> names;
    bool unlimited = false;
    for (std::int64_t d = 0; d < entries; ++d) {
      dimensions.push_back({.name = new_name(names), .size = count()});
      if (dimensions.back().size > 0)
        continue;
      require(!std::exchange(unlimited, true), "follows a second dimension of records");
      dimensions.back() = {dimensions.back().name, records_, true};
    }
  }

  NetcdfAttributes attributes() {
    const std::int64_t entries = take_list_size(attributes_follow, "attributes");
    std::set<std::string> names;
    NetcdfAttributes attributes;
    for (std::int64_t a = 0; a < entries; ++a) {
      attributes.push_back({new_name(names), {}});
      const NetcdfType type = this->type();
      const std::int64_t values = count(), size = size_of(type);
      require_left(values);
      std::string bytes = text(size * values);
      swap_big_endian(bytes.data(), values, size, bytes.data());
      if (type == NetcdfType::text)
        attributes.back().value = std::move(bytes);
      else
        attributes.back().value = NetcdfValues{type, std::move(bytes)};
    }
    return attributes;
  }

  /// Reads the dimensions, attributes, type and size of a variable. The size in the file is
  /// redundant, and too small for large variables.
  Shape read_shape(const std::vector<NetcdfDimension>& dimensions, NetcdfVariable& variable) {
    const std::int64_t rank = count();
    require(rank <= NC_MAX_VAR_DIMS, "follows a variable of too many dimensions");
    Shape shape{1, false};
    const auto multiply = [&shape](std::int64_t factor) {
      if (shape.bytes >= 0 && __builtin_mul_overflow(shape.bytes, factor, &shape.bytes))
        shape.bytes = -1;
    };
    for (std::int64_t d = 0; d < rank; ++d) {
      const std::int64_t id = count();
      require(id < std::ssize(dimensions), "follows a dimension that there is not");
      const NetcdfDimension& dimension = dimensions[static_cast<std::size_t>(id)];
      require(!dimension.unlimited || d == 0,
              "follows a dimension of records that is not the first");
      variable.dimensions.push_back(static_cast<int>(id));
      shape.of_records |= dimension.unlimited;
      if (!dimension.unlimited)
        multiply(dimension.size);
    }
    variable.attributes = attributes();
    variable.type = type();
    multiply(size_of(*variable.type));
    count();
    return shape;
  }

  /// Sets the ends of the variables, limited to the range of 64 bits, which no file exceeds.
  void add_ends(const std::vector<Shape>& shapes, std::vector<NetcdfVariable>& variables) const {
    std::int64_t record = 0, record_variables = 0;
    bool overflow = false;
    for (const Shape& shape : shapes)
      if (shape.of_records) {
        overflow |= shape.bytes > INT64_MAX - 3 ||
                    __builtin_add_overflow(record, padded(shape.bytes), &record);
        ++record_variables;
      }
    for (std::size_t v = 0; v < variables.size(); ++v) {
      const Shape& shape = shapes[v];
      NetcdfVariable& variable = variables[v];
      std::int64_t before_last = 0;
      if (shape.of_records)
        variable.stride = record_variables == 1 ? shape.bytes : record;
      if (shape.of_records && records_ > 0)
        overflow |= __builtin_mul_overflow(variable.stride, records_ - 1, &before_last);
      overflow |= shape.bytes < 0 ||
                  __builtin_add_overflow(before_last, variable.begin, &before_last) ||
                  __builtin_add_overflow(before_last, shape.bytes, &variable.end);
      if (shape.of_records && records_ == 0) // its first byte may be past the end of the file
        variable.end = position_;
      if (overflow)
        variable.end = INT64_MAX;
    }
  }

  const FileReader& file_;
  std::string window_; ///< bytes of the file
  std::int64_t window_begin_ = 0;
  std::int64_t position_ = 0, records_ = 0;
  std::int64_t entries_ = 0; ///< number of entries of all lists so far
  int version_ = 0;
};

} // namespace

std::optional<NetcdfType> netcdf_type(std::int64_t code) {
  if (code < 1 || code > 11)
    return {};
  return static_cast<NetcdfType>(code);
}

std::int64_t size_of(NetcdfType type) {
  constexpr std::array<std::int64_t, 12> sizes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return sizes[static_cast<std::size_t>(type)];
}

bool is_classic_netcdf(const FileReader& file) {
  char magic[4] = {};
  if (file.size() >= std::ssize(magic))
    file.read(0, sizeof magic, magic);
  return std::memcmp(magic, "CDF", 3) == 0 && (magic[3] == 1 || magic[3] == 2 || magic[3] == 5);
}

NetcdfHeader classic_header(const FileReader& file) { return HeaderWalk(file).header(); }

bool needs_cdf5(const std::vector<std::int64_t>& variable_bytes) {
  // The header holds a variable's size in 32 bits, rounded up to 4 bytes.
  constexpr std::int64_t most = (std::int64_t{1} << 32) - 4;
  return std::any_of(variable_bytes.begin(), variable_bytes.end(),
                     [](std::int64_t bytes) { return bytes >= most; });
}

} // namespace calotte::io_detail
