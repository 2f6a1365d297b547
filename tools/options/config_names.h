// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace calotte::tools {

/// A name of MPI-SCVT's for an option that has another name here.
struct BorrowedName {
  std::string name;
  std::string option; ///< its long name here

  /// A value of MPI-SCVT's.
  struct Value {
    std::string number; ///< that stands for it there, or ""
    std::string word;   ///< that may stand for it in its place
    std::string ours;   ///< the value of the option here
  };
  std::vector<Value> values; ///< empty: values are unchanged

  /// The option's value for a value of MPI-SCVT's; "" if there is none.
  std::string ours(const std::string& value) const;
  /// "0 (centroid), ...": all valid values.
  std::string known() const;
};

/// The names of MPI-SCVT that mean the same here (Jacobsen et al.'s MPI-SCVT, the keys of its
/// config.xml). bisections has the same name here.
const std::vector<BorrowedName>& borrowed_names();

} // namespace calotte::tools
