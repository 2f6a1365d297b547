// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "base/parallel.h"
#include "io/bytes/room.h"

#include <cstdint>
#include <string>
#include <vector>

namespace calotte::io_detail {

enum class Verdict { keeps, breaks, untested };

inline Verdict verdict_of(bool holds) { return holds ? Verdict::keeps : Verdict::breaks; }

/// The items of [0, n) that break a law.
struct Broken {
  std::int64_t count = 0, tested = 0, first = -1;
  bool any() const { return count > 0; }
  /// Whether most tested items keep the law. Then it is a law of this grid.
  bool is_law() const { return 2 * (tested - count) >= tested; }
  /// "3 of 120".
  std::string of_all() const { return message("{} of {}", count, tested); }
};

/// \param verdict_at(i) runs in parallel.
template <class VerdictAt> Broken broken(std::int64_t n, const VerdictAt& verdict_at) {
  std::vector<Broken> parts(static_cast<std::size_t>(block_count(n)));
  for_each_block(n, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    Broken& part = parts[static_cast<std::size_t>(block)];
    for (std::int64_t i = begin; i != end; ++i) {
      const Verdict found = verdict_at(i);
      part.tested += found == Verdict::untested ? 0 : 1;
      if (found != Verdict::breaks)
        continue;
      ++part.count;
      if (part.first < 0)
        part.first = i;
    }
  });
  Broken all;
  for (const Broken& part : parts) {
    all.count += part.count;
    all.tested += part.tested;
    if (all.first < 0)
      all.first = part.first;
  }
  return all;
}

} // namespace calotte::io_detail
