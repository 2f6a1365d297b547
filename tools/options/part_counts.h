// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// The numbers of parts that calotte partition is asked for.
namespace calotte::tools {

/// first, first + step, ... up to last.
struct PartCounts {
  std::int64_t first = 1, last = 1, step = 1; ///< 1 <= first <= last, step >= 1
};

/// Reads words such as "16", "16,32" and "16:512:16".
/// \throws Error invalid_argument, naming the word. \pre there is one
std::vector<PartCounts> part_counts(const std::vector<std::string>& words);

/// All numbers, ascending, each once.
/// \param mesh file for messages.
/// \throws Error invalid_argument for more parts than cells.
std::vector<std::int64_t> counts_of(const std::vector<PartCounts>& ranges, std::int64_t cells,
                                    const std::string& mesh);

} // namespace calotte::tools
