// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "help/cli_forward.h"

#include <string>
#include <vector>

namespace calotte::tools {

/// What `calotte help` says on a subject, by the words that people have for it.
struct Guide {
  std::string words; ///< separated by blanks, lower case; the first is its name
  std::string text;  ///< lines: what to do, and the commands
  std::string pages; ///< of the manual, separated by blanks
};

const std::vector<Guide>& guides();

/// The text on a word, with the pages of the manual; "" for an unknown word.
/// \param word of any case, with hyphens, singular or plural.
std::string guide_on(const std::string& word);

/// The options of all commands, and the topics, whose texts have a word; "" if there are none.
std::string mentions_of(const CLI::App& app, const std::string& word);

/// Where the manual is: the folder of its pages, or words for where to find it.
std::string manual_folder();

} // namespace calotte::tools
