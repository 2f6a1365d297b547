// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "io/netcdf/room.h"

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

/// The header of a NetCDF file.
namespace calotte::io_detail {

class FileReader;

/// The types of the classic formats. The values are the codes in files. The last five types exist
/// in CDF-5 only.
enum class NetcdfType {
  int8 = 1,
  text, ///< characters
  int16,
  int32,
  float32,
  float64,
  uint8,
  uint16,
  uint32,
  int64,
  uint64
};

/// The type with a code; none for other codes, which HDF5 files have.
std::optional<NetcdfType> netcdf_type(std::int64_t code);

/// Size of a value in bytes.
std::int64_t size_of(NetcdfType type);

/// The NetCDF type of double, std::int32_t or std::int8_t.
template <class T>
inline constexpr NetcdfType type_in_memory = std::is_same_v<T, double>         ? NetcdfType::float64
                                             : std::is_same_v<T, std::int32_t> ? NetcdfType::int32
                                                                               : NetcdfType::int8;

/// Several numbers of one type, in the machine's order of bytes.
struct NetcdfValues {
  NetcdfType type;
  std::string bytes;
};

struct NetcdfAttribute {
  std::string name;
  std::variant<std::string, double, std::int32_t, std::int8_t, NetcdfValues> value;
};
using NetcdfAttributes = std::vector<NetcdfAttribute>;

struct NetcdfDimension {
  std::string name;
  std::int64_t size = 0;
  bool unlimited = false;
};

struct NetcdfVariable {
  std::string name;
  std::optional<NetcdfType> type = {}; ///< none for strings and user-defined types
  std::vector<int> dimensions = {};    ///< the slowest first
  NetcdfAttributes attributes = {};    ///< only attributes of numbers or text

  // In a classic file:
  std::int64_t begin = 0;  ///< the offset of its first byte
  std::int64_t end = 0;    ///< the offset behind its last byte
  std::int64_t stride = 0; ///< bytes from a record to the next; 0 without records
};

/// Attributes that were read are text or NetcdfValues; strings are text.
struct NetcdfHeader {
  std::vector<NetcdfDimension> dimensions;
  std::vector<NetcdfVariable> variables;
  NetcdfAttributes attributes;          ///< of the file
  std::int64_t bytes = 0;               ///< size of a classic file's header
  std::vector<std::string> groups = {}; ///< names of groups in an HDF5 file, which are not read
};

/// Whether a file begins as CDF-1, -2 or -5 does. \throws Error file.
bool is_classic_netcdf(const FileReader& file);

/// Reads the header of a classic file (NetCDF Classic Format Specification, Unidata). Does not
/// check that the file contains all values.
/// \pre is_classic_netcdf().
/// \throws Error parse for a header that is cut short or damaged, with its byte; file.
NetcdfHeader classic_header(const FileReader& file);

/// Whether a variable is too large for the 64-bit offset format.
/// \param variable_bytes sizes of the variables in bytes.
bool needs_cdf5(const std::vector<std::int64_t>& variable_bytes);

} // namespace calotte::io_detail
