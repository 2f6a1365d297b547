// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_reader.h"
#include "io/netcdf/netcdf_writer.h"
#include "io/netcdf/room.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// NetCDF files whose contents go to another file.
namespace calotte::io_detail {

/// An open NetCDF file of any kind: what its header says, and the bytes of its variables. Threads
/// may read at once. The values of a classic file are read past the C library, which would read
/// them one after another. Every method \throws Error parse, file.
class NetcdfSource {
public:
  struct Dimension {
    std::string name;
    std::int64_t size = 0;
    bool unlimited = false;
  };
  struct Variable {
    std::string name;
    std::optional<NetcdfType> type; ///< none for strings and types of users
    std::vector<int> dimensions;    ///< the slowest first
    NetcdfAttributes attributes;    ///< those of numbers and text
  };

  explicit NetcdfSource(const std::string& path);
  NetcdfSource(const NetcdfSource&) = delete;
  NetcdfSource& operator=(const NetcdfSource&) = delete;
  ~NetcdfSource();

  const NetcdfReader& reader() const { return reader_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  const std::vector<Variable>& variables() const { return variables_; }
  const NetcdfAttributes& attributes() const { return attributes_; }
  /// The index of a variable; -1 if there is none of that name.
  int find(const std::string& variable) const;
  /// Product of the sizes of dimensions first to last - 1 of a variable.
  std::int64_t product(int variable, std::size_t first, std::size_t last) const;

  /// Reads rows of a variable, the most significant byte of each value first. A row holds the
  /// values that agree in the dimensions 0 to `axis`; rows are numbered over these.
  /// \pre the rows agree in the dimensions before `axis`; `out` has space for them.
  void rows(int variable, std::size_t axis, std::int64_t first, std::int64_t count,
            char* out) const;

private:
  void read_header();
  void read_bytes(int variable, std::int64_t begin, std::int64_t size, char* out) const;
  void cache_chunks(int variable) const;

  NetcdfReader reader_;
  int id_ = -1;
  int descriptor_ = -1;               ///< of a classic file, else -1
  std::vector<std::int64_t> begins_;  ///< by variable, of a classic file: its first byte
  std::vector<std::int64_t> strides_; ///< bytes from a record to the next; 0 without records
  mutable std::vector<int> cached_;   ///< variables with a large cache of chunks, latest last
  std::vector<Dimension> dimensions_;
  std::vector<Variable> variables_;
  NetcdfAttributes attributes_;
};

} // namespace calotte::io_detail
