// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_source.h"

#include "io/bytes/big_endian.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_library.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace calotte::io_detail {
namespace {

std::optional<NetcdfType> type_of(nc_type code) {
  switch (code) {
  case NC_CHAR:
    return NetcdfType::text;
  case NC_BYTE:
    return NetcdfType::int8;
  case NC_SHORT:
    return NetcdfType::int16;
  case NC_INT:
    return NetcdfType::int32;
  case NC_FLOAT:
    return NetcdfType::float32;
  case NC_DOUBLE:
    return NetcdfType::float64;
  case NC_UBYTE:
    return NetcdfType::uint8;
  case NC_USHORT:
    return NetcdfType::uint16;
  case NC_UINT:
    return NetcdfType::uint32;
  case NC_INT64:
    return NetcdfType::int64;
  case NC_UINT64:
    return NetcdfType::uint64;
  default:
    return {};
  }
}

std::string joined_strings(int id, int variable, const char* name, std::size_t count) {
  std::vector<char*> strings(count, nullptr);
  std::string text;
  if (count == 0 || nc_get_att_string(id, variable, name, strings.data()) != NC_NOERR)
    return text;
  for (const char* string : strings)
    text.append(text.empty() ? "" : ", ").append(string != nullptr ? string : "");
  nc_free_string(count, strings.data());
  return text;
}

/// The attributes of a variable, or of the file; those of users' types are left out.
NetcdfAttributes attributes_of(int id, int variable, int count) {
  NetcdfAttributes attributes;
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1] = "";
    nc_type code = NC_NAT;
    std::size_t length = 0;
    nc_inq_attname(id, variable, a, name);
    nc_inq_att(id, variable, name, &code, &length);
    const std::optional<NetcdfType> type = type_of(code);
    if (code == NC_STRING)
      attributes.push_back({name, joined_strings(id, variable, name, length)});
    if (!type)
      continue;
    std::string bytes(length * static_cast<std::size_t>(size_of(*type)), '\0');
    nc_get_att(id, variable, name, bytes.data());
    if (type == NetcdfType::text)
      attributes.push_back({name, bytes});
    else
      attributes.push_back({name, NetcdfValues{*type, bytes}});
  }
  return attributes;
}

} // namespace

NetcdfSource::NetcdfSource(const std::string& path) : reader_(path) {
  const std::lock_guard lock(netcdf_mutex());
  const int code = nc_open(netcdf_path(path).c_str(), NC_NOWRITE, &id_);
  require_system(path, code);
  if (code != NC_NOERR)
    reader_.fail("it is not a NetCDF file, or is cut short; give another or make it again");
  read_header();
  if (!is_classic_netcdf(path))
    return;
  for (const NetcdfExtent& extent : classic_layout(path).variables) {
    begins_.push_back(extent.begin);
    strides_.push_back(extent.stride);
  }
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

NetcdfSource::~NetcdfSource() {
  const std::lock_guard lock(netcdf_mutex());
  nc_close(id_);
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

void NetcdfSource::read_header() {
  int dimensions = 0, variables = 0, attributes = 0, unlimited = 0;
  nc_inq(id_, &dimensions, &variables, &attributes, nullptr);
  char name[NC_MAX_NAME + 1] = "";
  for (int d = 0; d < dimensions; ++d) {
    std::size_t size = 0;
    nc_inq_dim(id_, d, name, &size);
    dimensions_.push_back({name, static_cast<std::int64_t>(size)});
  }
  std::vector<int> ids(dimensions_.size());
  nc_inq_unlimdims(id_, &unlimited, ids.data());
  for (int k = 0; k < unlimited; ++k)
    dimensions_[static_cast<std::size_t>(ids[static_cast<std::size_t>(k)])].unlimited = true;
  for (int v = 0; v < variables; ++v) {
    nc_type code = NC_NAT;
    int count = 0, of_variable = 0, dims[NC_MAX_VAR_DIMS];
    nc_inq_var(id_, v, name, &code, &count, dims, &of_variable);
    variables_.push_back(
        {name, type_of(code), {dims, dims + count}, attributes_of(id_, v, of_variable)});
  }
  attributes_ = attributes_of(id_, NC_GLOBAL, attributes);
}

int NetcdfSource::find(const std::string& variable) const {
  const auto found = std::find_if(variables_.begin(), variables_.end(),
                                  [&](const Variable& v) { return v.name == variable; });
  return found == variables_.end() ? -1 : static_cast<int>(found - variables_.begin());
}

std::int64_t NetcdfSource::product(int variable, std::size_t first, std::size_t last) const {
  const std::vector<int>& of = variables_[static_cast<std::size_t>(variable)].dimensions;
  std::int64_t product = 1;
  for (std::size_t d = first; d < last; ++d)
    product *= dimensions_[static_cast<std::size_t>(of[d])].size;
  return product;
}

void NetcdfSource::rows(int variable, std::size_t axis, std::int64_t first, std::int64_t count,
                        char* out) const {
  const Variable& of = variables_[static_cast<std::size_t>(variable)];
  const std::size_t rank = of.dimensions.size();
  const std::int64_t values = product(variable, std::min(axis + 1, rank), rank),
                     size = size_of(*of.type);
  if (descriptor_ >= 0)
    return read_bytes(variable, first * values * size, count * values * size, out);
  std::vector<std::size_t> start(rank, 0), counts(rank, 1);
  std::int64_t rest = first;
  for (std::size_t d = rank; d-- > 0;) {
    const std::int64_t extent = product(variable, d, d + 1);
    if (d > axis)
      counts[d] = static_cast<std::size_t>(extent);
    else
      start[d] = static_cast<std::size_t>(rest % extent), rest /= extent;
  }
  if (rank > 0)
    counts[axis] = static_cast<std::size_t>(count);
  {
    const std::lock_guard lock(netcdf_mutex());
    cache_chunks(variable);
    if (const int code = nc_get_vara(id_, variable, start.data(), counts.data(), out);
        code != NC_NOERR) {
      require_system(reader_.path(), code);
      reader_.fail(of.name + " cannot be read (" + nc_strerror(code) + "); make the file again");
    }
  }
  swap_big_endian(out, count * values, size, out);
}

/// Of a classic file: the variable's bytes, in the order of its values.
void NetcdfSource::read_bytes(int variable, std::int64_t begin, std::int64_t size,
                              char* out) const {
  const auto v = static_cast<std::size_t>(variable);
  const Variable& of = variables_[v];
  const bool records = strides_[v] > 0;
  const std::int64_t record_bytes =
      product(variable, records ? 1 : 0, of.dimensions.size()) * size_of(*of.type);
  while (size > 0) {
    const std::int64_t record = records ? begin / record_bytes : 0,
                       within = begin - record * record_bytes,
                       most = std::min(size, record_bytes - within);
    const ssize_t got = ::pread(descriptor_, out, static_cast<std::size_t>(most),
                                begins_[v] + record * strides_[v] + within);
    if (got < 0 && errno == EINTR)
      continue;
    if (got <= 0)
      throw Error(ErrorCode::file, "cannot read " + reader_.path() + ": " +
                                       (got < 0 ? std::generic_category().message(errno)
                                                : std::string("it became shorter")) +
                                       "; check the disk");
    out += got, begin += got, size -= got;
  }
}

/// Gives the variable a cache for two of its chunks, so that parts of a chunk, read one after
/// another, decompress it once. Two variables at most have one. \pre no other call runs.
void NetcdfSource::cache_chunks(int variable) const {
  constexpr std::size_t slots = 521, least = std::size_t{1} << 20;
  const auto known = std::find(cached_.begin(), cached_.end(), variable);
  if (known != cached_.end()) {
    std::rotate(known, known + 1, cached_.end());
    return;
  }
  const Variable& of = variables_[static_cast<std::size_t>(variable)];
  std::vector<std::size_t> chunk(of.dimensions.size() + 1, 1);
  int storage = NC_CONTIGUOUS;
  nc_inq_var_chunking(id_, variable, &storage, chunk.data());
  if (storage != NC_CHUNKED)
    return;
  std::size_t bytes = static_cast<std::size_t>(size_of(*of.type));
  for (const std::size_t size : chunk)
    bytes *= size;
  if (cached_.size() == 2) {
    nc_set_var_chunk_cache(id_, cached_.front(), least, slots, 0.75F);
    cached_.erase(cached_.begin());
  }
  nc_set_var_chunk_cache(id_, variable, std::max(2 * bytes, std::size_t{16} << 20), slots, 0.75F);
  cached_.push_back(variable);
}

} // namespace calotte::io_detail
