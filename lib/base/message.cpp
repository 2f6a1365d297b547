// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"

#include <charconv>

namespace calotte::base_detail {

std::string shortly(double value) {
  const auto with = [value](int digits) {
    char text[32]; // to_chars() is the same in any locale
    const auto end =
        std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
    return std::string(text, end.ptr);
  };
  const std::string nine = with(9);
  double read = 0;
  std::from_chars(nine.data(), nine.data() + nine.size(), read);
  return read == value ? nine : with(6);
}

std::string filled(std::string_view pattern, std::initializer_list<std::string> texts) {
  std::string all;
  for (const std::string& text : texts) {
    const std::size_t place = pattern.find("{}");
    all.append(pattern.substr(0, place)).append(text);
    pattern.remove_prefix(place + 2);
  }
  return all.append(pattern);
}

} // namespace calotte::base_detail
