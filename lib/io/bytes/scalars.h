// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/bytes/room.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>

/// The scalar types of VTK and PLY files: numbers as bytes of either order, and as text.
namespace calotte::io_detail {

enum class Scalar {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
};

/// Calls visit with a zero of the type.
template <class Visit> auto with_type(Scalar type, const Visit& visit) {
  switch (type) {
  case Scalar::int8:
    return visit(std::int8_t{});
  case Scalar::uint8:
    return visit(std::uint8_t{});
  case Scalar::int16:
    return visit(std::int16_t{});
  case Scalar::uint16:
    return visit(std::uint16_t{});
  case Scalar::int32:
    return visit(std::int32_t{});
  case Scalar::uint32:
    return visit(std::uint32_t{});
  case Scalar::int64:
    return visit(std::int64_t{});
  case Scalar::uint64:
    return visit(std::uint64_t{});
  case Scalar::float32:
    return visit(float{});
  default:
    return visit(double{});
  }
}

/// Size of a number in bytes.
inline std::int64_t size_of(Scalar type) {
  return with_type(type, [](auto zero) { return static_cast<std::int64_t>(sizeof zero); });
}

inline bool is_float(Scalar type) { return type == Scalar::float32 || type == Scalar::float64; }

/// Converts a number to another type. An integer type gives -1 for a fraction and for a value out
/// of its range: no id, offset or count is negative.
template <class To, class From> To number_as(From value) {
  if constexpr (std::is_floating_point_v<To>) {
    return static_cast<To>(value);
  } else if constexpr (std::is_floating_point_v<From>) {
    constexpr From end = static_cast<From>(std::uint64_t{1} << (8 * sizeof(To) - 1));
    return value >= 0 && value < end && value == std::floor(value) ? static_cast<To>(value)
                                                                   : To{-1};
  } else {
    const bool fits = value >= 0 && static_cast<std::uint64_t>(value) <=
                                        static_cast<std::uint64_t>(std::numeric_limits<To>::max());
    return fits ? static_cast<To>(value) : To{-1};
  }
}

template <class T> T with_bytes_reversed(T value) {
  if constexpr (sizeof(T) == 2)
    return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  else if constexpr (sizeof(T) == 4)
    return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  else if constexpr (sizeof(T) == 8)
    return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  else
    return value;
}

/// Loads a number.
/// \param swapped whether its byte order is not this machine's.
template <class T> T stored(const char* bytes, bool swapped) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return swapped ? with_bytes_reversed(value) : value;
}

/// Loads a number of any type.
template <class To> To stored_as(const char* bytes, Scalar type, bool swapped) {
  return with_type(
      type, [&](auto zero) { return number_as<To>(stored<decltype(zero)>(bytes, swapped)); });
}

/// Loads consecutive numbers of any type.
template <class To>
void copy_numbers(const char* bytes, std::int64_t count, Scalar type, bool swapped, To* out) {
  with_type(type, [&](auto zero) {
    using From = decltype(zero);
    for (std::int64_t i = 0; i < count; ++i)
      out[i] =
          number_as<To>(stored<From>(bytes + i * static_cast<std::int64_t>(sizeof(From)), swapped));
  });
}

// ---- Text

inline bool is_space(char c) { return c == ' ' || ('\t' <= c && c <= '\r'); }

/// Removes the next word from a text. White space separates words. Returns an empty word at the
/// end.
inline std::string_view take_word(std::string_view& text) {
  const auto* const begin = std::find_if_not(text.begin(), text.end(), is_space);
  const auto* const end = std::find_if(begin, text.end(), is_space);
  const std::string_view word(begin, static_cast<std::size_t>(end - begin));
  text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
  return word;
}

/// Parses a whole word as a number of a type. Returns false if it is not one.
template <class To> bool parse_number(std::string_view word, Scalar type, To& out) {
  if (word.size() > 1 && word[0] == '+')
    word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto parse = [&](auto value) {
    const auto read = std::from_chars(word.data(), end, value);
    const bool too_large = read.ec == std::errc::result_out_of_range;
    if (read.ptr != end || (read.ec != std::errc() && !too_large))
      return false;
    out = too_large ? To{-1} : number_as<To>(value);
    return !too_large || !std::is_floating_point_v<To>;
  };
  return std::is_floating_point_v<To> || is_float(type) ? parse(double{}) : parse(std::int64_t{});
}

} // namespace calotte::io_detail
