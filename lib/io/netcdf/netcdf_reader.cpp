// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_reader.h"

#include "io/bytes/file.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_library.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>

namespace calotte::io_detail {
namespace {

std::string shape_in_words(const std::vector<std::int64_t>& shape) {
  std::string words = "(";
  for (std::size_t d = 0; d < shape.size(); ++d)
    words += (d > 0 ? ", " : "") + (shape[d] < 0 ? "any" : std::to_string(shape[d]));
  return words + ")";
}

bool matches(const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& wanted) {
  return std::equal(shape.begin(), shape.end(), wanted.begin(), wanted.end(),
                    [](std::int64_t size, std::int64_t want) { return want < 0 || size == want; });
}

std::string name_of(int id, int variable) {
  char name[NC_MAX_NAME + 1] = "";
  nc_inq_varname(id, variable, name);
  return name;
}

/// The C library reads zeros where a classic file ends early, and can crash on a damaged header.
/// \returns the variable that the file does not hold as a whole, "" where it holds all.
/// \throws Error parse for a damaged header.
std::string first_cut(const std::string& path, std::int64_t size) {
  if (!is_classic_netcdf(path))
    return "";
  const NetcdfLayout layout = classic_layout(path);
  for (const NetcdfExtent& extent : layout.variables)
    if (extent.begin < layout.header || extent.end > size)
      return extent.name;
  return "";
}

int get_all(int id, int variable, double* values) {
  return nc_get_var_double(id, variable, values);
}
int get_all(int id, int variable, std::int32_t* values) {
  return nc_get_var_int(id, variable, values);
}

int get_some(int id, int variable, const std::size_t* start, const std::size_t* count,
             double* values) {
  return nc_get_vara_double(id, variable, start, count, values);
}
int get_some(int id, int variable, const std::size_t* start, const std::size_t* count,
             std::int32_t* values) {
  return nc_get_vara_int(id, variable, start, count, values);
}

/// \throws Error parse or file, unless the C library read the variable.
void require_read(const NetcdfReader& file, const std::string& name, int code) {
  file.require_whole();
  require_system(file.path(), code);
  if (code == NC_ECHAR)
    file.fail(name + " is text, not numbers; make the file again");
  if (code == NC_ERANGE)
    file.fail(name + " has a number out of range; make the file again");
  if (code != NC_NOERR)
    file.fail(name + " cannot be read (" + nc_strerror(code) + "); make the file again");
}

/// All values of a variable whose shape is that. \throws Error parse.
template <class T>
std::vector<T> get_values(const NetcdfReader& file, int id, const std::string& name,
                          const std::vector<std::int64_t>& shape) {
  std::int64_t count = 1;
  for (const std::int64_t size : shape)
    if (__builtin_mul_overflow(count, size, &count))
      file.fail(name + " is too large; make the file again");
  // What deflate can reach, for a file that stores something of each value.
  constexpr std::int64_t most_compressed = 1032, least = std::int64_t{1} << 24;
  if (count > least && count / most_compressed > file.size() / std::int64_t{sizeof(T)})
    file.fail(name + " has more values than a file of its size can hold; make the file again");
  std::vector<T> values;
  try {
    values = zeros<T>(count);
  } catch (const std::exception&) {
    file.fail(name + " is too large for this machine's memory; read it on a larger one");
  }
  const std::lock_guard lock(netcdf_mutex());
  int variable = -1;
  nc_inq_varid(id, name.c_str(), &variable);
  require_read(file, name, get_all(id, variable, values.data()));
  return values;
}

std::int32_t to_int(const NetcdfReader& file, const std::string& name, double value) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (!(value >= Limits::min() && value <= Limits::max()) || value != std::floor(value))
    file.fail(name + " has a number that is not a 32-bit integer; make the file again");
  return static_cast<std::int32_t>(value);
}

} // namespace

NetcdfReader::NetcdfReader(const std::string& path)
    : path_(path), in_(open_input(path)), size_(static_cast<std::int64_t>(bytes_left(in_))) {
  if (const std::string cut = first_cut(path, size_); !cut.empty())
    fail("it is cut short: " + cut + " is incomplete; make it again");
  const std::lock_guard lock(netcdf_mutex());
  const int code = nc_open(netcdf_path(path).c_str(), NC_NOWRITE, &id_);
  require_system(path, code);
  if (code != NC_NOERR)
    fail("it is not a NetCDF file, or is cut short; give another or make it again");
}

NetcdfReader::~NetcdfReader() {
  const std::lock_guard lock(netcdf_mutex());
  nc_close(id_);
}

bool NetcdfReader::is_found(int code) const {
  require_system(path_, code);
  return code == NC_NOERR;
}

bool NetcdfReader::has_variable(const std::string& name) const {
  const std::lock_guard lock(netcdf_mutex());
  int variable;
  return is_found(nc_inq_varid(id_, name.c_str(), &variable));
}

std::vector<std::string> NetcdfReader::variables() const {
  const std::lock_guard lock(netcdf_mutex());
  int count = 0;
  nc_inq_nvars(id_, &count);
  std::vector<std::string> names;
  for (int v = 0; v < count; ++v)
    names.push_back(name_of(id_, v));
  return names;
}

std::vector<int> NetcdfReader::dimension_ids(const std::string& variable) const {
  int v, count = 0, ids[NC_MAX_VAR_DIMS];
  if (!is_found(nc_inq_varid(id_, variable.c_str(), &v)))
    fail("it has no variable " + variable + "; give a file that has");
  nc_inq_var(id_, v, nullptr, nullptr, &count, ids, nullptr);
  return {ids, ids + count};
}

std::vector<std::string> NetcdfReader::dimensions_of(const std::string& variable) const {
  const std::lock_guard lock(netcdf_mutex());
  std::vector<std::string> names;
  for (const int id : dimension_ids(variable)) {
    char name[NC_MAX_NAME + 1] = "";
    nc_inq_dimname(id_, id, name);
    names.emplace_back(name);
  }
  return names;
}

std::vector<std::int64_t> NetcdfReader::shape_of(const std::string& variable) const {
  const std::lock_guard lock(netcdf_mutex());
  std::vector<std::int64_t> shape;
  for (const int id : dimension_ids(variable)) {
    std::size_t size = 0;
    nc_inq_dimlen(id_, id, &size);
    shape.push_back(static_cast<std::int64_t>(size));
  }
  return shape;
}

std::int64_t NetcdfReader::dimension(const std::string& name) const {
  const std::lock_guard lock(netcdf_mutex());
  int d;
  std::size_t size = 0;
  if (!is_found(nc_inq_dimid(id_, name.c_str(), &d)))
    return -1;
  nc_inq_dimlen(id_, d, &size);
  return static_cast<std::int64_t>(size);
}

int NetcdfReader::type_of(const std::string& variable) const {
  const std::lock_guard lock(netcdf_mutex());
  int v = -1;
  nc_type type = NC_NAT;
  nc_inq_varid(id_, variable.c_str(), &v);
  nc_inq_vartype(id_, v, &type);
  return type;
}

bool NetcdfReader::is_numeric(const std::string& variable) const {
  const int type = type_of(variable);
  return type != NC_CHAR && type != NC_STRING && type >= NC_BYTE && type <= NC_UINT64;
}

bool NetcdfReader::is_integer(const std::string& variable) const {
  const int type = type_of(variable);
  return is_numeric(variable) && type != NC_FLOAT && type != NC_DOUBLE;
}

bool NetcdfReader::is_float(const std::string& variable) const {
  return type_of(variable) == NC_FLOAT;
}

std::string NetcdfReader::text(const std::string& variable, const std::string& attribute) const {
  const std::lock_guard lock(netcdf_mutex());
  int v = NC_GLOBAL;
  nc_type type = NC_CHAR;
  std::size_t length = 0;
  if ((!variable.empty() && !is_found(nc_inq_varid(id_, variable.c_str(), &v))) ||
      !is_found(nc_inq_att(id_, v, attribute.c_str(), &type, &length)))
    return "";
  std::string text;
  if (type == NC_CHAR) {
    text.resize(length);
    nc_get_att_text(id_, v, attribute.c_str(), text.data());
  } else if (type == NC_STRING && length == 1) {
    char* string = nullptr;
    if (nc_get_att_string(id_, v, attribute.c_str(), &string) == NC_NOERR && string != nullptr)
      text = string;
    nc_free_string(1, &string);
  }
  return text.substr(0, text.find('\0'));
}

double NetcdfReader::number(const std::string& variable, const std::string& attribute,
                            double fallback) const {
  const std::lock_guard lock(netcdf_mutex());
  int v = NC_GLOBAL;
  std::size_t length = 0;
  double value = fallback;
  if ((!variable.empty() && !is_found(nc_inq_varid(id_, variable.c_str(), &v))) ||
      !is_found(nc_inq_attlen(id_, v, attribute.c_str(), &length)) || length != 1 ||
      !is_found(nc_get_att_double(id_, v, attribute.c_str(), &value)))
    return fallback;
  return value;
}

std::int32_t NetcdfReader::start_index(const std::string& variable, std::int32_t fallback) const {
  const double start = number(variable, "start_index", fallback);
  if (start != 0 && start != 1)
    fail("the attribute start_index of " + variable + " is neither 0 nor 1; correct it");
  return static_cast<std::int32_t>(start);
}

std::vector<double> NetcdfReader::doubles(const std::string& variable,
                                          const std::vector<std::int64_t>& shape) const {
  const std::vector<std::int64_t> has = shape_of(variable);
  if (!matches(has, shape))
    fail(variable + " has the shape " + shape_in_words(has) + " instead of " +
         shape_in_words(shape) + "; make the file again");
  return get_values<double>(*this, id_, variable, has);
}

std::vector<std::int32_t> NetcdfReader::ints(const std::string& variable,
                                             const std::vector<std::int64_t>& shape) const {
  const std::vector<std::int64_t> has = shape_of(variable);
  const int type = type_of(variable);
  // The library would cut off fractions, and knows no integer for NaN.
  if (matches(has, shape) && type != NC_FLOAT && type != NC_DOUBLE)
    return get_values<std::int32_t>(*this, id_, variable, has);
  const std::vector<double> values = doubles(variable, shape);
  std::vector<std::int32_t> ints(values.size());
  std::transform(values.begin(), values.end(), ints.begin(),
                 [&](double value) { return to_int(*this, variable, value); });
  return ints;
}

template <class T>
void NetcdfReader::get_rows(const std::string& variable, std::int64_t first, std::int64_t count,
                            T* out) const {
  const std::vector<std::int64_t> shape = shape_of(variable);
  std::vector<std::size_t> start(shape.size(), 0), counts(shape.begin(), shape.end());
  if (!shape.empty()) {
    start[0] = static_cast<std::size_t>(first);
    counts[0] = static_cast<std::size_t>(count);
  }
  const std::lock_guard lock(netcdf_mutex());
  int v = -1;
  nc_inq_varid(id_, variable.c_str(), &v);
  require_read(*this, variable, get_some(id_, v, start.data(), counts.data(), out));
}

void NetcdfReader::rows(const std::string& variable, std::int64_t first, std::int64_t count,
                        double* out) const {
  get_rows(variable, first, count, out);
}

void NetcdfReader::rows(const std::string& variable, std::int64_t first, std::int64_t count,
                        std::int32_t* out) const {
  const int type = type_of(variable);
  if (type != NC_FLOAT && type != NC_DOUBLE)
    return get_rows(variable, first, count, out);
  std::int64_t size = count; // as ints()
  const std::vector<std::int64_t> shape = shape_of(variable);
  for (std::size_t d = 1; d < shape.size(); ++d)
    size *= shape[d];
  std::vector<double> values(static_cast<std::size_t>(size));
  get_rows(variable, first, count, values.data());
  std::transform(values.begin(), values.end(), out,
                 [&](double value) { return to_int(*this, variable, value); });
}

void NetcdfReader::require_whole() const {
  in_.seekg(0);
  io_detail::require_whole(bytes_left(in_), static_cast<std::size_t>(size_), path_);
}

void NetcdfReader::fail(const std::string& problem) const {
  throw Error(ErrorCode::parse, path_ + ": " + problem);
}

} // namespace calotte::io_detail
