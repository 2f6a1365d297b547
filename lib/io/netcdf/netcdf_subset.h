// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"
#include "io/netcdf/room.h"

#include <calotte/mesh.h>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/// Files that contain some of the cells, edges and vertices of another.
namespace calotte::io_detail {

/// The items that are kept of n items, in their order. Items are cells, edges or vertices.
struct Kept {
  Array<std::int32_t> old;    ///< by kept item: its 0-based id in the source, ascending
  Array<std::int32_t> number; ///< by item of the source: its new 1-based number; 0 if left out

  std::int64_t count() const { return old.size(); }
};

/// Keeps the items with a flag >= 0.
template <class Flags> Kept select_kept(const Flags& flags) {
  const std::int64_t n = static_cast<std::int64_t>(flags.size());
  Kept kept{{}, Array<std::int32_t>(n)};
  std::int32_t count = 0;
  for (std::int64_t i = 0; i < n; ++i)
    kept.number[i] = flags[static_cast<decltype(flags.size())>(i)] >= 0 ? ++count : 0;
  kept.old = Array<std::int32_t>(count);
  for (std::int64_t i = 0; i < n; ++i)
    if (kept.number[i] > 0)
      kept.old[kept.number[i] - 1] = static_cast<std::int32_t>(i);
  return kept;
}

/// Reads the kept rows begin to end - 1 of a variable in big-endian byte order. They are numbered
/// over the dimensions 0 to `axis`; rows of dimension `axis` are left out.
/// \throws Error parse, file.
void read_kept_rows(const NetcdfReader& source, int variable, std::size_t axis, const Kept& kept,
                    std::int64_t begin, std::int64_t end, char* out);

/// Modifies such rows.
using ChangeRows = std::function<void(std::int64_t begin, std::int64_t end, char* bytes)>;

/// The changes from a file to its subset.
struct NetcdfSubset {
  std::map<std::string, const Kept*> kept;                ///< by name of the dimension
  std::map<std::string, std::vector<ChangeRows>> changes; ///< by variable, in their order
  std::map<std::string, NetcdfAttribute> attributes = {}; ///< replace those of the source
  std::map<std::string, std::string> long_names = {};     ///< by variable
  std::vector<std::string> left_out = {};                 ///< names of variables
  std::vector<std::string> attributes_left_out = {};      ///< names of those of the source

  /// A new variable with one integer for each item of a dimension.
  struct Added {
    std::string name, dimension, long_name;
    std::function<std::int32_t(std::int64_t i)> value;
  };
  std::vector<Added> added = {};
  /// A new variable with one number.
  struct Number {
    std::string name, units, long_name;
    double value = 0;
  };
  std::vector<Number> numbers = {};
  /// New dimensions, unless the source has one of that name.
  std::vector<FieldDimension> dimensions = {};
};

/// Number of values in a row of a variable, as ChangeRows receives it.
std::int64_t row_values(const NetcdfReader& source, const NetcdfSubset& subset, int variable);

/// Writes the variables of a file, some without rows that are left out, to a new file. The caller
/// commits it.
/// \returns the variables that a classic file cannot contain: those of strings and of user-defined
/// types.
/// \throws Error file; parse; invalid_argument for a variable with two of the dimensions; what
/// changes throw.
std::vector<std::string> put_subset(const NetcdfReader& source, const NetcdfSubset& subset,
                                    NetcdfWriter& file);

} // namespace calotte::io_detail
