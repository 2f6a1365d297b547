// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/array.h"
#include "base/parallel.h"
#include "io/cells/room.h"
#include "io/netcdf/netcdf_reader.h"

#include <calotte/mesh_file.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

/// Compares the variables of a file, row by row, with the values that they should have.
namespace calotte::io_detail {

/// Relative differences below this are rounding errors: MpasMeshConverter has single precision.
inline constexpr double rounding_of_others = 1e-6;

/// The differences in a variable, or in a part of it.
struct Differences {
  std::int64_t count = 0;
  /// Values that do not follow a known fault of MpasMeshConverter, whether right or wrong.
  std::int64_t unlike_fault = 0;
  std::int64_t index = -1; ///< index of the largest difference, the first of equal ones
  double largest = 0, stored = 0, derived = 0;

  void note(std::int64_t at, double stored_there, double derived_there, double difference);
  /// Records a pair of values whose relative difference is above the tolerance, or not a number.
  void compare(std::int64_t at, double stored_there, double derived_there, double scale,
               double tolerance);
  /// Records ids that differ.
  void compare(std::int64_t at, std::int32_t stored_there, std::int32_t derived_there) {
    if (stored_there != derived_there)
      note(at, stored_there, derived_there, 1);
  }
  /// Adds the differences of a later part.
  void take(const Differences& later);
};

/// Collects deviations.
class Deviations {
public:
  explicit Deviations(const NetcdfReader& file) : file_(file) {}

  const NetcdfReader& file() const { return file_; }
  std::vector<Deviation> result() && { return std::move(found_); }

  /// Whether the file has a variable of that shape (-1: any size). Another shape is a deviation.
  bool has(const std::string& variable, const std::vector<std::int64_t>& shape);
  /// The length of the rows of a variable; 1 for a variable with one dimension.
  std::int64_t width(const std::string& variable) const;

  /// Calls rule(begin, end, values, differences) for blocks of rows of a variable. `values`
  /// contains rows begin to end - 1; the rule records differences with their indices in the
  /// variable.
  template <class T, class Rule>
  Differences visit_blocks(const std::string& variable, const Rule& rule) const;
  /// Calls rule(row, values, differences) for each row.
  template <class T, class Rule>
  Differences visit_rows(const std::string& variable, const Rule& rule) const;

  /// Adds a deviation if there are differences.
  /// \param rule what the values should be: the text after "are not".
  /// \param fault of MpasMeshConverter; it is reported if all values follow it.
  void add(const std::string& variable, const Differences& differences, const std::string& rule,
           const std::string& fault = {});
  /// Calls visit_rows() and adds a deviation if there are differences.
  /// \param values what they should be.
  template <class T, class Rule>
  void check_rows(const std::string& variable, const std::string& values, const Rule& rule) {
    add(variable, visit_rows<T>(variable, rule), values);
  }
  /// Adds a deviation without values.
  void add(const std::string& variable, const std::string& text, std::int64_t index = -1,
           double difference = 1);

private:
  const NetcdfReader& file_;
  std::vector<Deviation> found_;
};

// ---- Implementation

template <class T, class Rule>
Differences Deviations::visit_blocks(const std::string& variable, const Rule& rule) const {
  constexpr std::int64_t at_once = std::int64_t{1} << 22; // values in memory
  const std::vector<std::int64_t> shape = file_.shape_of(variable);
  const std::int64_t rows = shape.empty() ? 1 : shape[0], length = width(variable);
  const std::int64_t most = std::max<std::int64_t>(at_once / std::max<std::int64_t>(length, 1), 1);
  Array<T> values(std::min(rows, most) * length);
  Differences all;
  for (std::int64_t first = 0; first < rows; first += most) {
    const std::int64_t count = std::min(most, rows - first);
    file_.rows(variable, first, count, values.begin());
    std::vector<Differences> parts(static_cast<std::size_t>(block_count(count)));
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
      rule(first + begin, first + end, values.begin() + begin * length,
           parts[static_cast<std::size_t>(block)]);
    });
    for (const Differences& part : parts)
      all.take(part);
  }
  return all;
}

template <class T, class Rule>
Differences Deviations::visit_rows(const std::string& variable, const Rule& rule) const {
  const std::int64_t length = width(variable);
  return visit_blocks<T>(variable, [&](std::int64_t begin, std::int64_t end, const T* values,
                                       Differences& differences) {
    for (std::int64_t row = begin; row != end; ++row, values += length)
      rule(row, values, differences);
  });
}

} // namespace calotte::io_detail
