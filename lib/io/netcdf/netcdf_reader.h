// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "base/message.h"
#include "io/bytes/file_reader.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_library.h"
#include "io/netcdf/room.h"

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

/// NetCDF files that are read.
namespace calotte::io_detail {

/// A shape, or an index in it, as messages show it: "(3, 120)"; "any" stands for a negative size.
std::string in_words(const std::vector<std::int64_t>& shape);

/// An open NetCDF file of any kind. The header is read once; it is then available without a lock.
/// Several threads may read values at once: values of a classic file come from the file itself,
/// because the C library would serialise the calls; those of HDF5 come from the C library.
/// Arguments are names in the file; messages contain the path and the variable. Every method
/// \throws Error parse, file.
///
/// Through the C library, `calotte check` of an MPAS file of 655 362 cells takes 1.18 times as
/// long, `info` 1.10, `convert` 1.03 (two cores, medians of three interleaved runs).
///
///     const NetcdfReader file("mesh.nc");
///     const std::int64_t n = file.dimension("nCells");
///     const std::vector<double> x = file.doubles("xCell", {n});
class NetcdfReader {
public:
  explicit NetcdfReader(const std::string& path);

  const std::string& path() const { return file_.path(); }
  [[noreturn]] void fail(const std::string& problem) const; ///< parse, "PATH: problem"
  /// The same with a pattern, as in message().
  template <class Value, class... Values>
  [[noreturn]] void fail(std::type_identity_t<Pattern<Value, Values...>> pattern,
                         const Value& value, const Values&... values) const {
    fail(message(pattern, value, values...));
  }

  // ---- The header

  const std::vector<NetcdfDimension>& dimensions() const { return header_.dimensions; }
  const std::vector<NetcdfVariable>& variables() const { return header_.variables; }
  const NetcdfAttributes& attributes() const { return header_.attributes; }

  /// The index of a variable; -1 if there is none of that name.
  int find(const std::string& variable) const;
  /// The same.
  /// \throws Error parse if there is none, with the remedy; files with groups have a remedy of
  /// their own.
  int require_variable(const std::string& name,
                       const std::string& remedy = "give a file that has") const;
  std::vector<std::string> variable_names() const;
  bool has_variable(const std::string& name) const { return find(name) >= 0; }
  std::vector<std::string> dimensions_of(const std::string& variable) const;
  std::vector<std::int64_t> shape_of(const std::string& variable) const;
  /// Product of the sizes of dimensions first to last - 1 of a variable.
  std::int64_t product(int variable, std::size_t first, std::size_t last) const;
  /// The size of a dimension, -1 where the file has none of that name.
  std::int64_t dimension(const std::string& name) const;
  bool is_unlimited(const std::string& dimension) const; ///< false where it has none of that name
  /// Whether a variable has numbers, and not characters or strings. \pre it exists.
  bool is_numeric(const std::string& variable) const;
  /// Whether a variable has integers of any size. \pre it exists.
  bool is_integer(const std::string& variable) const;
  /// Whether a variable's numbers have fewer digits than doubles: NC_FLOAT. \pre it exists.
  bool is_float(const std::string& variable) const;
  /// A text attribute of a variable, or of the file if the name is ""; "" without one.
  std::string text(const std::string& variable, const std::string& attribute) const;
  /// All numbers of an attribute of a variable or of the file; none without one.
  std::vector<double> numbers(const std::string& variable, const std::string& attribute) const;
  /// The number of an attribute that has exactly one, else the fallback.
  double number(const std::string& variable, const std::string& attribute, double fallback) const;
  /// The attribute start_index of a variable of ids, the lowest id: 0 or 1.
  std::int32_t start_index(const std::string& variable, std::int32_t fallback) const;

  // ---- Values

  /// Reads a whole variable, converted. Its shape must be the one given (-1: any size).
  std::vector<double> doubles(const std::string& variable,
                              const std::vector<std::int64_t>& shape) const;
  std::vector<std::int32_t> ints(const std::string& variable,
                                 const std::vector<std::int64_t>& shape) const;
  /// Reads the part of a variable that starts at the indices `start` and has `count` entries along
  /// each dimension, converted. \pre it is within the variable.
  std::vector<double> part(const std::string& variable, const std::vector<std::int64_t>& start,
                           const std::vector<std::int64_t>& count) const;
  /// Reads rows first to first + count - 1 of a variable, converted. Row i has all values whose
  /// first index is i. A variable without dimensions is one row.
  /// \pre the rows exist, and `out` has space for them.
  void rows(const std::string& variable, std::int64_t first, std::int64_t count, double* out) const;
  void rows(const std::string& variable, std::int64_t first, std::int64_t count,
            std::int32_t* out) const;

  /// Reads rows of a variable in big-endian byte order, as classic files store them. A row has the
  /// values with the same indices in the dimensions 0 to `axis`; rows are numbered over these
  /// dimensions.
  /// \pre the rows have the same indices in the dimensions before `axis`; `out` has space for them.
  void stored_rows(int variable, std::size_t axis, std::int64_t first, std::int64_t count,
                   char* out) const;

private:
  const NetcdfDimension* find_dimension(const std::string& name) const;
  [[noreturn]] void fail_for_groups(const std::string& problem) const;
  std::optional<NetcdfType> type_of(const std::string& variable) const;
  const NetcdfAttribute* find_attribute(const std::string& variable,
                                        const std::string& attribute) const;
  std::int64_t record_bytes(int variable) const;
  void require_values() const;
  void require_sizes() const;
  void require_converted(const NetcdfVariable& variable, const char* problem) const;
  template <class T> std::vector<T> room_for(const std::string& variable, std::int64_t count) const;
  template <class T>
  std::vector<T> get_all(const std::string& variable, const std::vector<std::int64_t>& shape) const;
  template <class T>
  void get_rows(int variable, std::int64_t first, std::int64_t count, T* out) const;
  template <class T>
  void get_values(int variable, std::int64_t first, std::int64_t count, T* out) const;
  void read_bytes(int variable, std::int64_t begin, std::int64_t size, char* out) const;

  FileReader file_;                          ///< for HDF5 only used to watch the size
  std::optional<NetcdfLibraryFile> library_; ///< none for a classic file
  NetcdfHeader header_;
  std::vector<int> by_name_; ///< indices of the variables, sorted by name
};

} // namespace calotte::io_detail
