// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/memory_use.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace calotte::tools {
namespace {

constexpr std::int64_t huge_page = std::int64_t{2} << 20;

/// Bytes on huge pages. Where the command keeps its memory, these are all that it ever touched.
std::int64_t bytes_on_huge_pages() {
  std::ifstream in("/proc/self/smaps_rollup"); // in KiB; other systems lack it
  for (std::string word; in >> word;)
    if (std::int64_t kibibytes = 0; word == "AnonHugePages:" && in >> kibibytes)
      return 1024 * kibibytes;
  return 0;
}

} // namespace

nlohmann::ordered_json memory_use() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  constexpr std::int64_t unit = 1; // of ru_maxrss
#else
  constexpr std::int64_t unit = 1024;
#endif
  const std::int64_t on_huge = bytes_on_huge_pages(), small = usage.ru_minflt - on_huge / huge_page;
  return {{"peak_bytes", unit * usage.ru_maxrss},
          {"page_faults", usage.ru_minflt},
          {"touched_bytes", small * sysconf(_SC_PAGESIZE) + on_huge}};
}

} // namespace calotte::tools
