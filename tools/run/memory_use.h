// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace calotte::tools {

/// What this process has used of the memory so far, for reports: `peak_bytes`, the most that it
/// held; `page_faults`, the number of pages that it touched first, huge pages as one;
/// `touched_bytes`, these pages, huge ones whole. Pages of files that the system maps along, such
/// as those of libraries, are in the first only.
nlohmann::ordered_json memory_use();

} // namespace calotte::tools
