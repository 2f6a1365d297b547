// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/message.h"

#include <cstdio>
#include <cstdlib>

namespace calotte::base_detail {

std::string shortly(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  if (std::strtod(text, nullptr) != value)
    std::snprintf(text, sizeof text, "%g", value);
  return text;
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
