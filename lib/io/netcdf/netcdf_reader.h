// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/room.h"

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

/// NetCDF files read through the C library, whose codes become this library's errors.
namespace calotte::io_detail {

/// An open NetCDF file of any kind. Names are the file's; messages name path and variable.
/// Every method \throws Error parse, file.
class NetcdfReader {
public:
  explicit NetcdfReader(const std::string& path);
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;
  ~NetcdfReader();

  bool has_variable(const std::string& name) const;
  std::vector<std::string> variables() const;
  std::vector<std::string> dimensions_of(const std::string& variable) const;
  std::vector<std::int64_t> shape_of(const std::string& variable) const;
  /// The size of a dimension, -1 where the file has none of that name.
  std::int64_t dimension(const std::string& name) const;
  /// Whether a variable holds numbers; characters and strings are none. \pre it exists.
  bool is_numeric(const std::string& variable) const;
  /// Whether a variable holds integers of any size. \pre it exists.
  bool is_integer(const std::string& variable) const;
  /// Whether a variable's numbers have fewer digits than doubles: NC_FLOAT. \pre it exists.
  bool is_float(const std::string& variable) const;
  /// A text attribute of a variable, or with "" of the file; "" where there is none.
  std::string text(const std::string& variable, const std::string& attribute) const;
  /// A number attribute of the same, else the fallback.
  double number(const std::string& variable, const std::string& attribute, double fallback) const;
  /// The attribute start_index of a variable with ids, the least of them: 0 or 1.
  std::int32_t start_index(const std::string& variable, std::int32_t fallback) const;

  /// All of a variable, converted. Its shape must be the one given (-1: any size).
  std::vector<double> doubles(const std::string& variable,
                              const std::vector<std::int64_t>& shape) const;
  std::vector<std::int32_t> ints(const std::string& variable,
                                 const std::vector<std::int64_t>& shape) const;
  /// Rows first to first + count - 1 of a variable, converted: row i holds all whose first index is
  /// i. A variable without dimensions is one row. \pre the rows exist, and `out` has space for
  /// them.
  void rows(const std::string& variable, std::int64_t first, std::int64_t count, double* out) const;
  void rows(const std::string& variable, std::int64_t first, std::int64_t count,
            std::int32_t* out) const;

  /// \throws Error file if the file is smaller than when it was opened: the C library reads zeros
  /// where it ends. \pre the caller locks netcdf_mutex().
  void require_whole() const;

  std::int64_t size() const { return size_; } ///< bytes when it was opened
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const std::string& problem) const; ///< parse, "PATH: problem"

private:
  /// True for a result code of success, false where what was asked for is not there.
  /// \throws std::bad_alloc; Error file.
  bool is_found(int code) const;
  template <class T>
  void get_rows(const std::string& variable, std::int64_t first, std::int64_t count, T* out) const;
  int type_of(const std::string& variable) const; ///< nc_type
  /// \pre the caller locks netcdf_mutex().
  std::vector<int> dimension_ids(const std::string& variable) const;

  std::string path_;
  mutable std::ifstream in_; ///< only to watch the size; the file's name may be gone
  std::int64_t size_ = 0;
  int id_ = -1;
};

} // namespace calotte::io_detail
