// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/// Numbers as the files of other programs hold them, made here and not by the library.
namespace calotte::test {

/// All values that the tests write; those of integer types are whole.
using Values = std::vector<double>;

inline std::string ordered(std::string bytes, bool big) {
  if (big == (std::endian::native == std::endian::little))
    std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

template <class T> std::string bytes_as(const Values& values, bool big) {
  std::string bytes;
  for (const double value : values) {
    const T number = static_cast<T>(value);
    bytes += ordered(std::string(reinterpret_cast<const char*>(&number), sizeof number), big);
  }
  return bytes;
}

/// \param type as VTK names it: Float64, UInt8 and so on.
inline std::string bytes_of(const std::string& type, const Values& values, bool big) {
  return type == "Float64"   ? bytes_as<double>(values, big)
         : type == "Float32" ? bytes_as<float>(values, big)
         : type == "Int64"   ? bytes_as<std::int64_t>(values, big)
         : type == "UInt64"  ? bytes_as<std::uint64_t>(values, big)
         : type == "Int32"   ? bytes_as<std::int32_t>(values, big)
         : type == "UInt32"  ? bytes_as<std::uint32_t>(values, big)
         : type == "Int16"   ? bytes_as<std::int16_t>(values, big)
         : type == "UInt16"  ? bytes_as<std::uint16_t>(values, big)
         : type == "Int8"    ? bytes_as<std::int8_t>(values, big)
                             : bytes_as<std::uint8_t>(values, big);
}

/// With the digits that read back to the same bits, some to a line.
inline std::string text_of(const Values& values) {
  std::string text;
  char digits[32];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (value != 0 && value == std::floor(value) && std::abs(value) < 9e18)
      text += std::to_string(static_cast<std::int64_t>(value));
    else
      text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    text += i % 7 == 6 ? "\n" : "  ";
  }
  return text + "\n";
}

inline std::string base64(const std::string& bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

template <class Matrix> Values values_of(const Matrix& matrix) {
  Values values;
  for (Eigen::Index i = 0; i < matrix.size(); ++i)
    values.push_back(static_cast<double>(matrix.data()[i]));
  return values;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  return place == std::string::npos ? "nothing to replace" : text.replace(place, from.size(), to);
}

} // namespace calotte::test
