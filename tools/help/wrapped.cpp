// SPDX-License-Identifier: GPL-3.0-or-later
#include "help/wrapped.h"

#include <sstream>

namespace calotte::tools {

std::string wrapped(const std::string& head, std::size_t indent, const std::string& text) {
  constexpr std::size_t columns = 100;
  const std::string margin(indent, ' ');
  std::string lines = head, line = head;
  if (head.size() + 2 > indent && indent > 0) {
    lines += "\n" + margin;
    line = margin;
  } else {
    lines.resize(indent, ' ');
    line.resize(indent, ' ');
  }
  std::istringstream words(text);
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (!first && line.size() + 1 + word.size() > columns) {
      lines += "\n" + margin;
      line = margin;
    } else if (!first) {
      lines += " ";
      line += " ";
    }
    lines += word;
    line += word;
  }
  return lines + "\n";
}

} // namespace calotte::tools
