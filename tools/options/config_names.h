// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace calotte::tools {

/// A name of MPI-SCVT's for what options here are called otherwise.
struct BorrowedName {
  std::string name;
  std::vector<std::string> options; ///< the long names of those that it sets

  /// A value of MPI-SCVT's.
  struct Value {
    std::string number; ///< that stands for it there, or ""
    std::string word;   ///< that may stand for it in its place
    std::string ours;   ///< what the options here have for it
  };
  std::vector<Value> values; ///< none: as they are
  std::string others;        ///< what there is to say of further values, or ""

  /// What the options have for a value, "" for none.
  std::string ours(const std::string& value) const;
  /// "0 (centroid), ...": all that may be given.
  std::string known() const;
};

/// Those of its names that mean the same here (Jacobsen et al.'s MPI-SCVT, the keys of its
/// config.xml). bisections has the same name here. So has triangle_divisions, but not the same
/// number: MPI-SCVT's n halves the sides n times, where 2^n here cuts them into so many.
const std::vector<BorrowedName>& borrowed_names();

/// With hyphens, as the command line has names.
std::string hyphenated(std::string name);

/// How many letters must be changed, added or left out to make one of the other (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The nearest of the names, "" where all are so far that hardly one is meant.
std::string nearest_name(const std::string& name, const std::vector<std::string>& names);

} // namespace calotte::tools
