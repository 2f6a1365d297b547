// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/vtk_legacy.h"

#include "io/bytes/file_error.h"
#include "io/bytes/text.h"

#include <array>
#include <bit>
#include <cctype>
#include <utility>

namespace calotte::io_detail {
namespace {

constexpr bool swapped = std::endian::native == std::endian::little;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool equal_but_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// `bit` and `string` have values of other sizes.
constexpr std::array<std::pair<std::string_view, Scalar>, 15> legacy_types{
    {{"char", Scalar::int8},
     {"signed_char", Scalar::int8},
     {"unsigned_char", Scalar::uint8},
     {"short", Scalar::int16},
     {"unsigned_short", Scalar::uint16},
     {"int", Scalar::int32},
     {"unsigned_int", Scalar::uint32},
     {"long", Scalar::int64},
     {"unsigned_long", Scalar::uint64},
     {"vtkidtype", Scalar::int32}, // VTK writes it as an int
     {"vtktypeint64", Scalar::int64},
     {"vtktypeuint64", Scalar::uint64},
     {"vtktypeint32", Scalar::int32},
     {"float", Scalar::float32},
     {"double", Scalar::float64}}};

std::optional<char> hex_value(std::string_view digits) {
  unsigned value = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 2 || read.ptr != digits.data() + 2)
    return std::nullopt;
  return static_cast<char>(value);
}

} // namespace

void require_legacy_vtk(std::string_view start, const std::string& name) {
  if (!start.starts_with("# vtk DataFile Version "))
    fail_file(name,
              "it does not start with \"# vtk DataFile Version\", so it is no legacy VTK file");
}

LegacyText::LegacyText(std::string_view content, std::string name)
    : rest_(content), name_(std::move(name)) {
  line();
  line(); // the title
  const std::string_view encoding = word();
  binary_ = equal_but_case(encoding, "BINARY");
  if (!binary_ && !equal_but_case(encoding, "ASCII"))
    fail_damaged(name_, "its third line is {}, not ASCII or BINARY", in_quotes(encoding));
}

std::string_view LegacyText::word() { return take_word(rest_); }

std::string_view LegacyText::word_of_line() {
  while (!rest_.empty() && rest_.front() != '\n' && is_space(rest_.front()))
    rest_.remove_prefix(1);
  return rest_.empty() || rest_.front() == '\n' ? std::string_view() : word();
}

bool LegacyText::take(std::string_view keyword) {
  std::string_view after = rest_;
  if (!equal_but_case(take_word(after), keyword))
    return false;
  rest_ = after;
  return true;
}

std::string_view LegacyText::line() {
  const std::size_t size = std::min(rest_.find('\n'), rest_.size());
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(std::min(size + 1, rest_.size()));
  return taken;
}

std::int64_t LegacyText::count(const std::string& what) {
  const std::string_view text = word();
  std::int32_t count = -1;
  if (!parse_number(text, Scalar::int64, count) || count < 0)
    fail_damaged(name_, "{} is not the number of {}, from 0 to 2147483647", in_quotes(text), what);
  return count;
}

std::string LegacyText::decoded_name() {
  std::string_view coded = word();
  std::string name;
  while (!coded.empty()) {
    const std::optional<char> value =
        coded.front() == '%' ? hex_value(coded.substr(1, 2)) : std::nullopt;
    name += value.value_or(coded.front());
    coded.remove_prefix(value ? 3 : 1);
  }
  return name;
}

LegacyText::Type LegacyText::type() {
  Type type;
  for (const char c : word())
    type.name += lower(c);
  for (const auto& [name, scalar] : legacy_types)
    if (name == type.name)
      type.scalar = scalar;
  if (!type.scalar && type.name != "bit" && type.name != "string")
    fail_damaged(name_, "{} is not a type of legacy VTK files", in_quotes(type.name));
  return type;
}

/// Skips to the end of the line, where bytes start.
void LegacyText::start_numbers() {
  if (binary_)
    line();
}

template <class T>
Column<T> LegacyText::numbers(const std::string& array, Scalar type, std::int64_t count) {
  start_numbers();
  const auto size = static_cast<std::int64_t>(rest_.size());
  if (count >
      (binary_ ? size / size_of(type) : (size + 1) / 2)) // at least a digit and white space each
    fail_damaged(in_array(name_, array), "the file ends before its {} numbers", count);
  Column<T> numbers(count);
  if (binary_) {
    copy_numbers(rest_.data(), count, type, swapped, numbers.data());
    rest_.remove_prefix(static_cast<std::size_t>(count * size_of(type)));
    return numbers;
  }
  for (std::int64_t i = 0; i < count; ++i)
    if (const std::string_view text = word(); !parse_number(text, type, numbers[i]))
      fail_file(in_array(name_, array),
                "{} at place {} of {} is not a number of its type; correct it", in_quotes(text), i,
                count);
  return numbers;
}

template Column<double> LegacyText::numbers(const std::string&, Scalar, std::int64_t);
template Column<std::int32_t> LegacyText::numbers(const std::string&, Scalar, std::int64_t);
template Column<std::int64_t> LegacyText::numbers(const std::string&, Scalar, std::int64_t);

void LegacyText::skip_bytes(const std::string& array, std::int64_t count) {
  if (count > static_cast<std::int64_t>(rest_.size()))
    fail_damaged(in_array(name_, array), "the file ends before its data");
  rest_.remove_prefix(static_cast<std::size_t>(count));
}

/// Skips a string: a length, whose first two bits encode its number of bytes, then the characters.
void LegacyText::skip_string(const std::string& array) {
  const auto first =
      rest_.empty() ? 0U : static_cast<unsigned>(static_cast<unsigned char>(rest_[0]));
  const std::int64_t width = std::int64_t{8} >> (first >> 6);
  if (width > static_cast<std::int64_t>(rest_.size()))
    skip_bytes(array, width);
  std::uint64_t length = first & 63U;
  for (std::int64_t k = 1; k < width; ++k)
    length = length << 8 | static_cast<unsigned char>(rest_[static_cast<std::size_t>(k)]);
  skip_bytes(array, width);
  skip_bytes(array, number_as<std::int64_t>(std::min<std::uint64_t>(length, rest_.size() + 1)));
}

void LegacyText::skip(const std::string& array, const Type& type, std::int64_t count) {
  start_numbers();
  if (count > 8 * (static_cast<std::int64_t>(rest_.size()) + 1)) // at least a bit each
    skip_bytes(array, count);
  if (!binary_ && type.name == "string") {
    line();
    for (std::int64_t i = 0; i < count && !rest_.empty(); ++i)
      line();
  } else if (!binary_) {
    for (std::int64_t i = 0; i < count; ++i)
      if (word().empty())
        fail_damaged(in_array(name_, array), "the file ends before its data");
  } else if (type.scalar) {
    skip_bytes(array, count * size_of(*type.scalar));
  } else if (type.name == "bit") {
    skip_bytes(array, (count + 7) / 8);
  } else {
    for (std::int64_t i = 0; i < count; ++i)
      skip_string(array);
  }
}

void LegacyText::skip_metadata() {
  line();
  while (!rest_.empty()) {
    std::string_view text = line();
    if (take_word(text).empty())
      return;
  }
}

} // namespace calotte::io_detail
