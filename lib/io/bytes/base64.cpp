// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/base64.h"

#include "io/bytes/scalars.h"

#include <array>

namespace calotte::io_detail {
namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint32_t padding = 64, no_digit = 65;

constexpr std::array<std::uint8_t, 256> digit_values = [] {
  std::array<std::uint8_t, 256> all{};
  for (std::uint8_t& value : all)
    value = no_digit;
  for (std::size_t k = 0; k < digits.size(); ++k)
    all[static_cast<unsigned char>(digits[k])] = static_cast<std::uint8_t>(k);
  all['='] = padding;
  return all;
}();

std::uint32_t value_of(char digit) { return digit_values[static_cast<unsigned char>(digit)]; }

} // namespace

std::int64_t Base64Reader::most() const {
  return end_ - begin_ + 3 * (static_cast<std::int64_t>(rest_.size()) / 4);
}

/// Decodes four digits, of which the last one or two may be padding. Returns false if the text does
/// not continue with four digits.
bool Base64Reader::decode_group() {
  while (!rest_.empty() && is_space(rest_.front()))
    rest_.remove_prefix(1);
  if (rest_.size() < 4)
    return false;
  const std::uint32_t a = value_of(rest_[0]), b = value_of(rest_[1]), c = value_of(rest_[2]),
                      d = value_of(rest_[3]);
  if (a >= padding || b >= padding || c > padding || d > padding || (c == padding && d != padding))
    return false;
  const std::uint32_t bits = a << 18 | b << 12 | (c & 63) << 6 | (d & 63);
  group_[0] = static_cast<unsigned char>(bits >> 16);
  group_[1] = static_cast<unsigned char>(bits >> 8);
  group_[2] = static_cast<unsigned char>(bits);
  begin_ = 0;
  end_ = c == padding ? 1 : d == padding ? 2 : 3;
  rest_.remove_prefix(4);
  return true;
}

void Base64Reader::take(std::int64_t count, std::string& out) {
  while (count > 0 && (begin_ != end_ || decode_group())) {
    out.push_back(static_cast<char>(group_[begin_++]));
    --count;
  }
}

} // namespace calotte::io_detail
