// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace calotte::tools {

/// A file of options as JIGSAW reads it (.jig): a line NAME = VALUE for each, and comments after #.
class JigFile {
public:
  /// \throws Error parse, "PATH line LINE: problem": a line that is none, an option that JIGSAW
  ///         does not have, or that asks for what Calotte does not make; file.
  explicit JigFile(const std::string& path);

  /// The values of options. \throws Error parse, for one that is none of its kind.
  std::optional<std::string> text(const std::string& name) const;
  std::string word(const std::string& name, const std::string& usual) const; ///< in lower case
  std::optional<double> number(const std::string& name) const;               ///< may be infinite
  std::optional<int> whole(const std::string& name) const;

  /// The number of NUMTHREAD; none for all threads.
  std::optional<int> threads() const;

  /// A file that must be given. \throws Error parse.
  std::string file(const std::string& name) const;

  /// \throws Error parse, always, about the value of an option that is given.
  [[noreturn]] void refuse(const std::string& name, const std::string& problem) const;

  /// A line on each option that has no effect here, in the order of the file.
  std::vector<std::string> ignored() const;

private:
  struct Option {
    std::string value;
    std::int64_t line;
  };
  const Option* find(const std::string& name) const;

  std::string path_;
  std::map<std::string, Option> options_; ///< by name in upper case; the last one holds
};

} // namespace calotte::tools
