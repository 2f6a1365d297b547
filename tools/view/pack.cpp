// SPDX-License-Identifier: GPL-3.0-or-later
#include "view/pack.h"

#include "text/text.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>

namespace calotte::tools {
namespace {

constexpr int bits_of_byte = 8;

std::string base64_of(const std::vector<unsigned char>& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8U | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? digits[word >> (18U - 6U * k) & 63U] : '=';
  }
  return text;
}

std::vector<unsigned char> compressed(const std::vector<unsigned char>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<unsigned char> result(size);
  constexpr int level = 6;
  if (compress2(result.data(), &size, bytes.data(), bytes.size(), level) != Z_OK)
    refuse("the page's data do not fit in memory; view a smaller mesh");
  result.resize(size);
  return result;
}

/// 0, 1, 2, 3, ... for 0, -1, 1, -2, ...
std::uint32_t zigzag(std::uint32_t difference) {
  return difference << 1U ^ (0U - (difference >> 31U));
}

int bytes_for(std::uint32_t greatest) {
  return std::max(1,
                  (static_cast<int>(std::bit_width(greatest)) + bits_of_byte - 1) / bits_of_byte);
}

/// Whether single precision has a number, up to its rounding.
bool fits_float(double number) {
  using Limits = std::numeric_limits<float>;
  const double size = std::abs(number);
  return !std::isfinite(number) || size == 0 ||
         (size >= Limits::min() && size <= Limits::max() / 2);
}

/// Rounds the mantissa to 15 bits.
std::uint32_t shortened(double number) {
  constexpr std::uint32_t half = 0x80, dropped = 0xff;
  const auto word = std::bit_cast<std::uint32_t>(static_cast<float>(number));
  return std::isfinite(number) ? (word + half) & ~dropped : word;
}

/// The higher half of a double: 20 bits of the mantissa.
std::uint32_t higher_half(double number) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(number) >> 32U);
}

} // namespace

nlohmann::ordered_json Blocks::add(const std::vector<std::uint32_t>& words, int width,
                                   const char* type, int delta) {
  const std::size_t n = words.size();
  std::vector<unsigned char> planes(n * static_cast<std::size_t>(width));
  for (std::size_t plane = 0; plane < static_cast<std::size_t>(width); ++plane)
    for (std::size_t i = 0; i < n; ++i)
      planes[plane * n + i] = static_cast<unsigned char>(words[i] >> (bits_of_byte * plane));
  base64_.push_back(base64_of(compressed(planes)));
  return {
      {"id", base64_.size() - 1}, {"type", type}, {"count", n}, {"width", width}, {"delta", delta}};
}

nlohmann::ordered_json Blocks::add(const std::vector<std::int32_t>& numbers, int delta) {
  std::vector<std::uint32_t> words(numbers.begin(), numbers.end());
  if (delta > 0) {
    const auto step = static_cast<std::size_t>(delta);
    for (std::size_t i = words.size(); i-- > 0;)
      words[i] = zigzag(words[i] - (i < step ? 0 : words[i - step]));
  }
  const std::uint32_t greatest = words.empty() ? 0 : *std::max_element(words.begin(), words.end());
  return add(words, bytes_for(greatest), "int", delta);
}

nlohmann::ordered_json Blocks::add(const DoubleVector& numbers) {
  const bool narrow = std::all_of(numbers.begin(), numbers.end(), fits_float);
  std::vector<std::uint32_t> words;
  words.reserve(static_cast<std::size_t>(numbers.size()));
  for (const double number : numbers)
    words.push_back(narrow ? shortened(number) : higher_half(number));
  return add(words, 4, narrow ? "float" : "double", 0);
}

} // namespace calotte::tools
