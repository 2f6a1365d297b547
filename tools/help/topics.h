// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace calotte::tools {

/// A text of `calotte help NAME` about what several commands share.
struct Topic {
  std::string name, summary, text;
};

const std::vector<Topic>& topics();

/// The text of the topic exit-codes.
std::string exit_codes();

} // namespace calotte::tools
