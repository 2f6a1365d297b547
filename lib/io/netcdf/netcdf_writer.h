// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/room.h"

#include <calotte/progress.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

/// NetCDF files that are written.
namespace calotte::io_detail {

/// A classic NetCDF file that is being written: 64-bit offsets, or CDF-5 if a variable takes 4 GiB
/// or a type requires it. Define dimensions, variables and attributes first, call begin(), which
/// writes the header, then put each variable once. The path appears at commit(). Every method
/// \throws Error file.
///
/// The C library writes the header alone, because a mesh of 1.2 GB is written 2.7 times as fast as
/// with nc_put_vara on the same blocks, beside the same computation (1.9 times with buffers of 4
/// MiB in the library), and 1.4 times as fast as without O_DIRECT (medians of 6 interleaved rounds
/// on two processors and ext4).
class NetcdfWriter {
public:
  /// \param progress receives the bytes written, as OutputFile::watch() describes.
  explicit NetcdfWriter(const std::string& path, ProgressCallback progress = {});
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;
  ~NetcdfWriter();

  /// \returns its id. A size of 0 makes it unlimited; no variable may have it.
  int dimension(const std::string& name, std::int64_t size);
  /// An unlimited dimension with `records` records, at most one in a file. It is the first
  /// dimension of the variables that have it; they are put as bytes.
  /// \returns its id.
  int record_dimension(const std::string& name, std::int64_t records);
  /// A dimension that fields share, by name and size. An unlimited one gets the size. If the file
  /// has another dimension of that name, the name is extended.
  /// \returns its id.
  int field_dimension(const std::string& name, std::int64_t size);
  /// \param dimensions ids, the slowest first; none for a scalar. \returns its id.
  int variable(const std::string& name, NetcdfType type, const std::vector<int>& dimensions,
               const NetcdfAttributes& attributes = {});
  /// Adds an attribute of the file.
  void attribute(NetcdfAttribute attribute);

  void begin();

  /// fill(begin, end, out) writes rows begin to end - 1 of the variable (its slowest dimension; a
  /// scalar is one row) to out. Several threads call it at once for blocks of rows.
  template <class T> using Fill = std::function<void(std::int64_t begin, std::int64_t end, T* out)>;
  void put(int variable, const Fill<double>& fill);
  void put(int variable, const Fill<std::int32_t>& fill);
  void put(int variable, const Fill<std::int8_t>& fill);

  /// The same for several variables with the same number of rows, whose values are computed
  /// together. Each has its own output; those of ints and of doubles come in the given order.
  using GroupFill = std::function<void(std::int64_t begin, std::int64_t end,
                                       std::int32_t* const* ints, double* const* doubles)>;
  void put(const std::vector<int>& ints, const std::vector<int>& doubles, const GroupFill& fill);

  /// fill(begin, end, out) writes the pieces begin to end - 1 of the variable, in big-endian byte
  /// order. Pieces have the same size and are at most a record. Several threads call it at once.
  using FillBytes = std::function<void(std::int64_t begin, std::int64_t end, char* out)>;
  void put(int variable, std::int64_t piece_bytes, const FillBytes& fill);

  void finish(); ///< as OutputFile::finish()
  void commit();

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace calotte::io_detail
