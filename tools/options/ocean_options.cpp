// SPDX-License-Identifier: GPL-3.0-or-later
#include "options/ocean_options.h"

#include <calotte/read.h>

#include <sstream>

namespace calotte::tools {

std::vector<Points3> read_all_lines(const std::vector<std::string>& files) {
  std::vector<Points3> all;
  for (const std::string& file : files) {
    const std::vector<Points3> lines = read_lines(file);
    all.insert(all.end(), lines.begin(), lines.end());
  }
  return all;
}

Points3 read_seeds(const std::vector<std::string>& words) {
  if (words.empty())
    return {};
  std::string lines;
  for (const std::string& word : words)
    lines += word + "\n";
  std::istringstream in(lines);
  return read_points(in, "--seed", Columns::lonlat);
}

} // namespace calotte::tools
