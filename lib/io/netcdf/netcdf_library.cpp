// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_library.h"

#include "base/message.h"
#include "io/bytes/file_error.h"
#include "io/bytes/file_reader.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <cerrno>
#include <new>

namespace calotte::io_detail {
namespace {

/// Throws for a result code that reports an error of the system. Returns for success and for a
/// damaged file.
/// \throws Error file for an error of the system; std::bad_alloc without memory.
void require_system(const std::string& path, int code) {
  if (code == NC_ENOMEM || code == ENOMEM)
    throw std::bad_alloc();
  if (code > 0)
    fail_disk(path, code);
}

} // namespace

std::mutex& netcdf_mutex() {
  static std::mutex mutex;
  return mutex;
}

std::string netcdf_path(const std::string& path) {
  std::string plain = path.starts_with('/') ? path : "./" + path;
  const auto doubled = [](char a, char b) { return a == '/' && b == '/'; };
  plain.erase(std::unique(plain.begin(), plain.end(), doubled), plain.end());
  return plain;
}

NetcdfLibraryFile::NetcdfLibraryFile(const FileReader& file) : file_(file) {
  const std::lock_guard lock(netcdf_mutex());
  require(nc_open(netcdf_path(file.path()).c_str(), NC_NOWRITE, &id_));
}

NetcdfLibraryFile::~NetcdfLibraryFile() {
  const std::lock_guard lock(netcdf_mutex());
  nc_close(id_);
}

/// Requires success of calls that open the file or read its dimensions and variables.
void NetcdfLibraryFile::require(int code) const {
  if (!is_found(code))
    fail_file(file_.path(),
              "it is not a NetCDF file, or is cut short; give another or make it again");
}

/// Whether a result code reports success. False if the requested item does not exist.
/// \throws std::bad_alloc; Error file.
bool NetcdfLibraryFile::is_found(int code) const {
  require_system(file_.path(), code);
  return code == NC_NOERR;
}

// ---- The header

NetcdfHeader NetcdfLibraryFile::header() const {
  const std::lock_guard lock(netcdf_mutex());
  int variables = 0, attributes = 0;
  require(nc_inq(id_, nullptr, &variables, &attributes, nullptr));
  NetcdfHeader header;
  std::vector<int> ids;
  header.dimensions = read_dimensions(ids);
  for (int v = 0; v < variables; ++v) {
    char name[NC_MAX_NAME + 1] = "";
    nc_type code = NC_NAT;
    int rank = 0, of_variable = 0, dims[NC_MAX_VAR_DIMS];
    require(nc_inq_var(id_, v, name, &code, &rank, dims, &of_variable));
    header.variables.push_back({name, netcdf_type(code), {}, read_attributes(v, of_variable)});
    for (int d = 0; d < rank; ++d) {
      const auto known = std::find(ids.begin(), ids.end(), dims[d]);
      require(known == ids.end() ? NC_EBADDIM : NC_NOERR);
      header.variables.back().dimensions.push_back(static_cast<int>(known - ids.begin()));
    }
  }
  header.attributes = read_attributes(NC_GLOBAL, attributes);
  header.groups = read_groups();
  return header;
}

std::vector<std::string> NetcdfLibraryFile::read_groups() const {
  int count = 0;
  require(nc_inq_grps(id_, &count, nullptr));
  std::vector<int> ids(static_cast<std::size_t>(count));
  require(nc_inq_grps(id_, &count, ids.data()));
  std::vector<std::string> names;
  for (const int id : ids) {
    char name[NC_MAX_NAME + 1] = "";
    require(nc_inq_grpname(id, name));
    names.emplace_back(name);
  }
  return names;
}

/// \param ids receives the library's ids, which are not consecutive: dimensions of groups are left
///        out.
std::vector<NetcdfDimension> NetcdfLibraryFile::read_dimensions(std::vector<int>& ids) const {
  int count = 0, unlimited = 0;
  require(nc_inq_dimids(id_, &count, nullptr, 0));
  ids.resize(static_cast<std::size_t>(count));
  require(nc_inq_dimids(id_, &count, ids.data(), 0));
  std::vector<NetcdfDimension> dimensions;
  for (const int id : ids) {
    char name[NC_MAX_NAME + 1] = "";
    std::size_t size = 0;
    require(nc_inq_dim(id_, id, name, &size));
    dimensions.push_back({name, static_cast<std::int64_t>(size)});
  }
  std::vector<int> endless(ids.size());
  require(nc_inq_unlimdims(id_, &unlimited, endless.data()));
  endless.resize(static_cast<std::size_t>(unlimited));
  for (std::size_t d = 0; d < ids.size(); ++d)
    dimensions[d].unlimited = std::find(endless.begin(), endless.end(), ids[d]) != endless.end();
  return dimensions;
}

/// Reads the attributes of a variable, or of the file. Leaves out attributes of user-defined types
/// and those that cannot be read.
NetcdfAttributes NetcdfLibraryFile::read_attributes(int variable, int count) const {
  NetcdfAttributes attributes;
  for (int a = 0; a < count; ++a) {
    char name[NC_MAX_NAME + 1] = "";
    nc_type code = NC_NAT;
    std::size_t length = 0;
    if (!is_found(nc_inq_attname(id_, variable, a, name)) ||
        !is_found(nc_inq_att(id_, variable, name, &code, &length)))
      continue;
    const std::optional<NetcdfType> type = netcdf_type(code);
    if (code == NC_STRING)
      attributes.push_back({name, joined_strings(variable, name, length)});
    if (!type)
      continue;
    std::string bytes(length * static_cast<std::size_t>(size_of(*type)), '\0');
    if (!is_found(nc_get_att(id_, variable, name, bytes.data())))
      continue;
    if (type == NetcdfType::text)
      attributes.push_back({name, bytes});
    else
      attributes.push_back({name, NetcdfValues{*type, bytes}});
  }
  return attributes;
}

std::string NetcdfLibraryFile::joined_strings(int variable, const char* name,
                                              std::size_t count) const {
  std::vector<char*> strings(count, nullptr);
  std::string text;
  if (count == 0 || !is_found(nc_get_att_string(id_, variable, name, strings.data())))
    return text;
  for (const char* string : strings)
    text.append(text.empty() ? "" : ", ").append(string != nullptr ? string : "");
  nc_free_string(count, strings.data());
  return text;
}

// ---- Values

void NetcdfLibraryFile::require_values(int variable, int code) const {
  file_.require_whole();
  require_system(file_.path(), code);
  if (code == NC_NOERR)
    return;
  char name[NC_MAX_NAME + 1] = "";
  nc_inq_varname(id_, variable, name);
  const std::string problem = code == NC_ECHAR ? "is text, not numbers"
                              : code == NC_ERANGE
                                  ? "has a number out of range"
                                  : message("cannot be read ({})", nc_strerror(code));
  fail_file(file_.path(), "{} {}; make the file again", name, problem);
}

void NetcdfLibraryFile::get(int variable, const std::vector<std::size_t>& start,
                            const std::vector<std::size_t>& count, double* out) const {
  const std::lock_guard lock(netcdf_mutex());
  require_values(variable, nc_get_vara_double(id_, variable, start.data(), count.data(), out));
}

void NetcdfLibraryFile::get(int variable, const std::vector<std::size_t>& start,
                            const std::vector<std::size_t>& count, std::int32_t* out) const {
  const std::lock_guard lock(netcdf_mutex());
  require_values(variable, nc_get_vara_int(id_, variable, start.data(), count.data(), out));
}

void NetcdfLibraryFile::get(int variable, const std::vector<std::size_t>& start,
                            const std::vector<std::size_t>& count, char* out) const {
  const std::lock_guard lock(netcdf_mutex());
  cache_chunks(variable);
  require_values(variable, nc_get_vara(id_, variable, start.data(), count.data(), out));
}

/// Gives the variable a cache for two of its chunks, so that parts of a chunk, read one after
/// another, decompress it once. Two variables at most have one.
void NetcdfLibraryFile::cache_chunks(int variable) const {
  constexpr std::size_t slots = 521, least = std::size_t{1} << 20;
  const auto known = std::find(cached_.begin(), cached_.end(), variable);
  if (known != cached_.end()) {
    std::rotate(known, known + 1, cached_.end());
    return;
  }
  int rank = 0, storage = NC_CONTIGUOUS;
  nc_type type = NC_NAT;
  std::size_t bytes = 0;
  nc_inq_var(id_, variable, nullptr, &type, &rank, nullptr, nullptr);
  nc_inq_type(id_, type, nullptr, &bytes);
  std::vector<std::size_t> chunk(static_cast<std::size_t>(rank) + 1, 1);
  nc_inq_var_chunking(id_, variable, &storage, chunk.data());
  if (storage != NC_CHUNKED)
    return;
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
