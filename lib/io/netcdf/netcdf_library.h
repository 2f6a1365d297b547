// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/room.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

/// The NetCDF C library, which writes headers and reads files of HDF5.
namespace calotte::io_detail {

/// The C library has tables without locks; a caller must hold this lock.
std::mutex& netcdf_mutex();

/// A path in the form that the C library expects: it interprets names like http://... as addresses,
/// and skips leading blanks.
std::string netcdf_path(const std::string& path);

/// A file that the C library has open for reading. Its methods take the lock.
class NetcdfLibraryFile {
public:
  /// \param file the open file. Its size is watched, because the library reads zeros behind the end
  ///        of a truncated file.
  /// \throws Error parse for a file that the library does not read; file.
  explicit NetcdfLibraryFile(const FileReader& file);
  NetcdfLibraryFile(const NetcdfLibraryFile&) = delete;
  NetcdfLibraryFile& operator=(const NetcdfLibraryFile&) = delete;
  ~NetcdfLibraryFile();

  /// \throws Error parse, file.
  NetcdfHeader header() const;

  /// Reads the part of a variable that starts at the indices `start` and has `count` entries along
  /// each dimension. Values are converted; as bytes they keep the type of the file, in the byte
  /// order of the machine.
  /// \throws Error parse, file.
  void get(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, double* out) const;
  void get(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, std::int32_t* out) const;
  void get(int variable, const std::vector<std::size_t>& start,
           const std::vector<std::size_t>& count, char* out) const;

private:
  void require(int code) const;
  bool is_found(int code) const;
  void require_values(int variable, int code) const;
  std::vector<NetcdfDimension> read_dimensions(std::vector<int>& ids) const;
  NetcdfAttributes read_attributes(int variable, int count) const;
  std::vector<std::string> read_groups() const;
  std::string joined_strings(int variable, const char* name, std::size_t count) const;
  void cache_chunks(int variable) const;

  const FileReader& file_;
  int id_ = -1;
  mutable std::vector<int> cached_; ///< variables with a large cache of chunks, latest last
};

} // namespace calotte::io_detail
