// SPDX-License-Identifier: GPL-3.0-or-later
#include "netcdf.h"

#include "../elementary.h"
#include "../parallel.h"
#include "netcdf_header.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <mutex>
#include <type_traits>

namespace calotte::detail {
namespace {

/// The C library keeps tables without locks: whoever calls it holds this.
std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

/// The C library takes names like http://... for addresses, and skips leading blanks.
std::string as_path(const std::string& path) {
  std::string plain = path.starts_with('/') ? path : "./" + path;
  const auto doubled = [](char a, char b) { return a == '/' && b == '/'; };
  plain.erase(std::unique(plain.begin(), plain.end(), doubled), plain.end());
  return plain;
}

nc_type type_of(NetcdfType type) {
  switch (type) {
  case NetcdfType::int8:
    return NC_BYTE;
  case NetcdfType::int32:
    return NC_INT;
  default:
    return NC_DOUBLE;
  }
}

std::int64_t size_of(NetcdfType type) {
  switch (type) {
  case NetcdfType::int8:
    return 1;
  case NetcdfType::int32:
    return 4;
  default:
    return 8;
  }
}

template <class T>
constexpr NetcdfType netcdf_type = std::is_same_v<T, double>         ? NetcdfType::float64
                                   : std::is_same_v<T, std::int32_t> ? NetcdfType::int32
                                                                     : NetcdfType::int8;

int put_attribute(int id, int variable, const NetcdfAttribute& attribute) {
  const char* name = attribute.name.c_str();
  if (const auto* text = std::get_if<std::string>(&attribute.value))
    return nc_put_att_text(id, variable, name, text->size(), text->c_str());
  if (const auto* number = std::get_if<double>(&attribute.value))
    return nc_put_att_double(id, variable, name, NC_DOUBLE, 1, number);
  if (const auto* number = std::get_if<std::int32_t>(&attribute.value))
    return nc_put_att_int(id, variable, name, NC_INT, 1, number);
  return nc_put_att_schar(id, variable, name, NC_BYTE, 1,
                          std::get_if<std::int8_t>(&attribute.value));
}

/// Of words of 4 or 8 bytes.
template <class Word>
CALOTTE_INLINE void reverse_words(const char* values, std::int64_t count, char* out) {
  constexpr std::int64_t size = sizeof(Word);
  for (std::int64_t i = 0; i < count; ++i) {
    Word word;
    std::memcpy(&word, values + size * i, size);
    if constexpr (size == 8)
      word = __builtin_bswap64(word);
    else
      word = __builtin_bswap32(word);
    std::memcpy(out + size * i, &word, size);
  }
}

CALOTTE_VECTOR_WIDTHS
void reverse_each_8(const char* values, std::int64_t count, char* out) {
  reverse_words<std::uint64_t>(values, count, out);
}

CALOTTE_VECTOR_WIDTHS
void reverse_each_4(const char* values, std::int64_t count, char* out) {
  reverse_words<std::uint32_t>(values, count, out);
}

/// The classic formats hold numbers with the most significant byte first. \param out need not be
/// aligned.
template <class T> void to_big_endian(const T* values, std::int64_t count, char* out) {
  const auto* const bytes = reinterpret_cast<const char*>(values);
  if constexpr (sizeof(T) == 1 || std::endian::native == std::endian::big)
    std::memcpy(out, bytes, static_cast<std::size_t>(count) * sizeof(T));
  else if constexpr (sizeof(T) == 8)
    reverse_each_8(bytes, count, out);
  else
    reverse_each_4(bytes, count, out);
}

/// body(begin, end) for consecutive ranges of [first, last) of rows of so many bytes each.
template <class Body>
void for_each_rows(std::int64_t first, std::int64_t last, std::int64_t row_bytes,
                   std::int64_t range_bytes, const Body& body) {
  const std::int64_t rows = std::max<std::int64_t>(range_bytes / row_bytes, 1);
  for (std::int64_t begin = first; begin < last; begin += rows)
    body(begin, std::min(last, begin + rows));
}

/// The same for all rows, in blocks that the disk likes, the larger the better, and that are enough
/// for all threads; each a task.
template <class Body>
void for_each_block_of_rows(std::int64_t rows, std::int64_t row_bytes, const Body& body) {
  const std::int64_t block_bytes =
      std::clamp<std::int64_t>(rows * row_bytes / 8, std::int64_t{1} << 20, std::int64_t{1} << 24);
  const std::int64_t block_rows = std::max<std::int64_t>(block_bytes / row_bytes, 1);
  for_each_task((rows + block_rows - 1) / block_rows, [&](std::int64_t block) {
    body(block * block_rows, std::min(rows, (block + 1) * block_rows));
  });
}

/// What is filled at once, in bytes: its conversion finds it in the cache.
constexpr std::int64_t fill_bytes = 1 << 17;

} // namespace

// ---- Writing

/// The C library writes the header. The values are converted and written by tasks of our own: by
/// the library, one thread after the other, a large mesh would take thrice as long.
struct NetcdfWriter::State {
  struct Dimension {
    std::string name;
    std::int64_t size;
  };
  struct Variable {
    std::string name;
    NetcdfType type;
    std::vector<int> dimensions;
    NetcdfAttributes attributes;
    std::int64_t rows = 1, row_values = 1; ///< values in a row
    std::int64_t offset = -1;              ///< in the file, after begin()
    bool is_put = false;
    std::int64_t row_bytes() const { return row_values * size_of(type); }
    std::int64_t bytes() const { return rows * row_bytes(); }
  };

  /// Some rows of a variable on their way to the file.
  template <class T> struct RowBlock {
    RowBlock(OutputFile& file, const Variable& of, std::int64_t begin, std::int64_t end)
        : first(begin), row_values(of.row_values),
          bytes(file.block(of.offset + begin * of.row_bytes(), (end - begin) * of.row_bytes())) {}

    /// For the values of rows begin to end - 1.
    T* room(std::int64_t begin, std::int64_t end) {
      if (const std::int64_t count = (end - begin) * row_values; values.size() < count)
        values = Array<T>(count);
      return values.begin();
    }
    /// Of what stands there.
    void convert(std::int64_t begin, std::int64_t end) {
      to_big_endian(values.begin(), (end - begin) * row_values,
                    bytes.begin() + (begin - first) * row_values * std::int64_t{sizeof(T)});
    }

    std::int64_t first, row_values;
    OutputBlock bytes;
    Array<T> values;
  };

  explicit State(const std::string& path) : file(path) {}

  void require(int code) const;
  void define(int id) const;
  template <class T> void put(int variable, const Fill<T>& fill);
  void put(int ints, int doubles, const PairFill& fill);
  template <class T> Variable& start(int variable);

  OutputFile file;
  std::vector<Dimension> dimensions;
  std::vector<Variable> variables;
  NetcdfAttributes attributes;
};

void NetcdfWriter::State::require(int code) const {
  if (code > 0)
    file.fail(code);
  if (code != NC_NOERR)
    throw Error(ErrorCode::internal,
                std::string("the NetCDF library refuses what Calotte writes (") +
                    nc_strerror(code) + "); report this as a bug");
}

void NetcdfWriter::State::define(int id) const {
  require(nc_set_fill(id, NC_NOFILL, nullptr));
  for (const Dimension& dimension : dimensions) {
    int unused;
    const auto size = static_cast<std::size_t>(dimension.size);
    require(nc_def_dim(id, dimension.name.c_str(), size == 0 ? NC_UNLIMITED : size, &unused));
  }
  for (const Variable& variable : variables) {
    int v;
    require(nc_def_var(id, variable.name.c_str(), type_of(variable.type),
                       static_cast<int>(variable.dimensions.size()), variable.dimensions.data(),
                       &v));
    for (const NetcdfAttribute& attribute : variable.attributes)
      require(put_attribute(id, v, attribute));
  }
  for (const NetcdfAttribute& attribute : attributes)
    require(put_attribute(id, NC_GLOBAL, attribute));
  require(nc_enddef(id));
}

template <class T> NetcdfWriter::State::Variable& NetcdfWriter::State::start(int variable) {
  Variable& of = variables.at(static_cast<std::size_t>(variable));
  if (of.type != netcdf_type<T> || of.offset < 0 || of.is_put)
    throw Error(ErrorCode::internal, of.name + " is put as another type, twice or before begin()");
  of.is_put = true;
  return of;
}

template <class T> void NetcdfWriter::State::put(int variable, const Fill<T>& fill) {
  const Variable& of = start<T>(variable);
  for_each_block_of_rows(of.rows, of.row_bytes(), [&](std::int64_t first, std::int64_t last) {
    RowBlock<T> block(file, of, first, last);
    for_each_rows(first, last, of.row_bytes(), fill_bytes,
                  [&](std::int64_t begin, std::int64_t end) {
                    fill(begin, end, block.room(begin, end));
                    block.convert(begin, end);
                  });
    file.put(std::move(block.bytes));
  });
}

void NetcdfWriter::State::put(int ints, int doubles, const PairFill& fill) {
  const Variable &of_ints = start<std::int32_t>(ints), &of_doubles = start<double>(doubles);
  const std::int64_t row_bytes = of_ints.row_bytes() + of_doubles.row_bytes();
  for_each_block_of_rows(
      of_ints.rows, of_doubles.row_bytes(), [&](std::int64_t first, std::int64_t last) {
        RowBlock<std::int32_t> one(file, of_ints, first, last);
        RowBlock<double> other(file, of_doubles, first, last);
        for_each_rows(first, last, row_bytes, fill_bytes,
                      [&](std::int64_t begin, std::int64_t end) {
                        fill(begin, end, one.room(begin, end), other.room(begin, end));
                        one.convert(begin, end);
                        other.convert(begin, end);
                      });
        file.put(std::move(one.bytes));
        file.put(std::move(other.bytes));
      });
}

NetcdfWriter::NetcdfWriter(const std::string& path) {
  require_regular_output(path);
  state_ = std::make_unique<State>(path);
}

NetcdfWriter::~NetcdfWriter() = default;

int NetcdfWriter::dimension(const std::string& name, std::int64_t size) {
  state_->dimensions.push_back({name, size});
  return static_cast<int>(state_->dimensions.size()) - 1;
}

int NetcdfWriter::variable(const std::string& name, NetcdfType type,
                           const std::vector<int>& dimensions, const NetcdfAttributes& attributes) {
  State::Variable variable{name, type, dimensions, attributes};
  for (std::size_t d = 0; d < dimensions.size(); ++d) {
    const std::int64_t size = state_->dimensions.at(static_cast<std::size_t>(dimensions[d])).size;
    (d == 0 ? variable.rows : variable.row_values) *= size;
  }
  state_->variables.push_back(std::move(variable));
  return static_cast<int>(state_->variables.size()) - 1;
}

void NetcdfWriter::attribute(NetcdfAttribute attribute) {
  state_->attributes.push_back(std::move(attribute));
}

void NetcdfWriter::begin() {
  std::vector<std::int64_t> bytes;
  for (const State::Variable& variable : state_->variables)
    bytes.push_back(variable.bytes());
  const int format = needs_cdf5(bytes) ? NC_64BIT_DATA : NC_64BIT_OFFSET;

  const std::lock_guard lock(library());
  const std::string& path = state_->file.temporary();
  int id = -1;
  state_->require(nc_create(as_path(path).c_str(), NC_CLOBBER | format, &id));
  try {
    state_->define(id);
    state_->require(nc_sync(id));
  } catch (...) {
    nc_abort(id);
    throw;
  }
  const NetcdfLayout layout = classic_layout(id, path);
  state_->require(nc_close(id));
  std::int64_t size = layout.header;
  for (std::size_t v = 0; v < layout.variables.size(); ++v) {
    State::Variable& variable = state_->variables[v];
    variable.offset = layout.variables[v].begin;
    size = std::max(size, variable.offset + variable.bytes());
  }
  state_->file.reserve(size);
}

void NetcdfWriter::put(int variable, const Fill<double>& fill) { state_->put(variable, fill); }
void NetcdfWriter::put(int variable, const Fill<std::int32_t>& fill) {
  state_->put(variable, fill);
}
void NetcdfWriter::put(int variable, const Fill<std::int8_t>& fill) { state_->put(variable, fill); }

void NetcdfWriter::put(int ints, int doubles, const PairFill& fill) {
  state_->put(ints, doubles, fill);
}

void NetcdfWriter::commit() {
  for (const State::Variable& variable : state_->variables)
    if (!variable.is_put)
      throw Error(ErrorCode::internal, variable.name + " is not put");
  state_->file.commit();
}

// ---- Reading

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

/// The library reads zeros where a classic file ends early. \pre nobody else calls it.
/// \returns what the file does not hold as a whole, "" where it holds all.
std::string first_cut(int id, const std::string& path) {
  int format = 0;
  if (nc_inq_format(id, &format) != NC_NOERR ||
      (format != NC_FORMAT_CLASSIC && format != NC_FORMAT_64BIT_OFFSET &&
       format != NC_FORMAT_64BIT_DATA))
    return "";
  const NetcdfLayout layout = classic_layout(id, path);
  std::error_code error; // a size of -1
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (layout.header > size)
    return "its header";
  for (int v = 0; v < std::ssize(layout.variables); ++v) {
    const NetcdfExtent extent = layout.variables[static_cast<std::size_t>(v)];
    if (extent.begin < layout.header || extent.end > size)
      return name_of(id, v);
  }
  return "";
}

int get_all(int id, int variable, double* values) {
  return nc_get_var_double(id, variable, values);
}
int get_all(int id, int variable, std::int32_t* values) {
  return nc_get_var_int(id, variable, values);
}

/// All values of a variable whose shape is that. \throws Error parse.
template <class T>
std::vector<T> get_values(const NetcdfReader& file, int id, const std::string& name,
                          const std::vector<std::int64_t>& shape) {
  std::int64_t count = 1;
  for (const std::int64_t size : shape)
    if (__builtin_mul_overflow(count, size, &count))
      file.fail(name + " is too large; make the file again");
  std::vector<T> values;
  try {
    values.resize(static_cast<std::size_t>(count));
  } catch (const std::exception&) {
    file.fail(name + " is too large for this machine's memory; read it on a larger one");
  }
  const std::lock_guard lock(library());
  int variable = -1;
  nc_inq_varid(id, name.c_str(), &variable);
  const int code = get_all(id, variable, values.data());
  if (code == NC_ECHAR)
    file.fail(name + " is text, not numbers; make the file again");
  if (code == NC_ERANGE)
    file.fail(name + " has a number out of range; make the file again");
  if (code != NC_NOERR)
    file.fail(name + " cannot be read (" + nc_strerror(code) + "); make the file again");
  return values;
}

std::int32_t to_int(const NetcdfReader& file, const std::string& name, double value) {
  using Limits = std::numeric_limits<std::int32_t>;
  if (!(value >= Limits::min() && value <= Limits::max()) || value != std::floor(value))
    file.fail(name + " has a number that is no 32-bit integer; make the file again");
  return static_cast<std::int32_t>(value);
}

} // namespace

NetcdfReader::NetcdfReader(const std::string& path) : path_(path) {
  open_input(path); // says why it cannot be read
  const std::lock_guard lock(library());
  if (nc_open(as_path(path).c_str(), NC_NOWRITE, &id_) != NC_NOERR)
    fail("it is no NetCDF file, or is cut short; give another or make it again");
  const std::string cut = first_cut(id_, path);
  if (cut.empty())
    return;
  nc_close(id_);
  fail("it is cut short: " + cut + " is not whole; make it again");
}

NetcdfReader::~NetcdfReader() {
  const std::lock_guard lock(library());
  nc_close(id_);
}

bool NetcdfReader::has_variable(const std::string& name) const {
  const std::lock_guard lock(library());
  int variable;
  return nc_inq_varid(id_, name.c_str(), &variable) == NC_NOERR;
}

std::vector<std::string> NetcdfReader::variables() const {
  const std::lock_guard lock(library());
  int count = 0;
  nc_inq_nvars(id_, &count);
  std::vector<std::string> names;
  for (int v = 0; v < count; ++v)
    names.push_back(name_of(id_, v));
  return names;
}

std::vector<std::string> NetcdfReader::dimensions_of(const std::string& variable) const {
  const std::lock_guard lock(library());
  int v, count = 0, ids[NC_MAX_VAR_DIMS];
  if (nc_inq_varid(id_, variable.c_str(), &v) != NC_NOERR)
    fail("it has no variable " + variable + "; give a file that has");
  nc_inq_var(id_, v, nullptr, nullptr, &count, ids, nullptr);
  std::vector<std::string> names;
  for (int d = 0; d < count; ++d) {
    char name[NC_MAX_NAME + 1] = "";
    nc_inq_dimname(id_, ids[d], name);
    names.emplace_back(name);
  }
  return names;
}

std::vector<std::int64_t> NetcdfReader::shape_of(const std::string& variable) const {
  std::vector<std::int64_t> shape;
  for (const std::string& name : dimensions_of(variable))
    shape.push_back(dimension(name));
  return shape;
}

std::int64_t NetcdfReader::dimension(const std::string& name) const {
  const std::lock_guard lock(library());
  int d;
  std::size_t size = 0;
  if (nc_inq_dimid(id_, name.c_str(), &d) != NC_NOERR)
    return -1;
  nc_inq_dimlen(id_, d, &size);
  return static_cast<std::int64_t>(size);
}

std::string NetcdfReader::text(const std::string& variable, const std::string& attribute) const {
  const std::lock_guard lock(library());
  int v = NC_GLOBAL;
  nc_type type = NC_CHAR;
  std::size_t length = 0;
  if ((!variable.empty() && nc_inq_varid(id_, variable.c_str(), &v) != NC_NOERR) ||
      nc_inq_att(id_, v, attribute.c_str(), &type, &length) != NC_NOERR)
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
  const std::lock_guard lock(library());
  int v = NC_GLOBAL;
  std::size_t length = 0;
  double value = fallback;
  if ((!variable.empty() && nc_inq_varid(id_, variable.c_str(), &v) != NC_NOERR) ||
      nc_inq_attlen(id_, v, attribute.c_str(), &length) != NC_NOERR || length != 1 ||
      nc_get_att_double(id_, v, attribute.c_str(), &value) != NC_NOERR)
    return fallback;
  return value;
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
  nc_type type = NC_INT;
  {
    const std::lock_guard lock(library());
    int v = -1;
    nc_inq_varid(id_, variable.c_str(), &v);
    nc_inq_vartype(id_, v, &type);
  }
  // The library would cut off fractions, and knows no integer for NaN.
  if (matches(has, shape) && type != NC_FLOAT && type != NC_DOUBLE)
    return get_values<std::int32_t>(*this, id_, variable, has);
  const std::vector<double> values = doubles(variable, shape);
  std::vector<std::int32_t> ints(values.size());
  std::transform(values.begin(), values.end(), ints.begin(),
                 [&](double value) { return to_int(*this, variable, value); });
  return ints;
}

void NetcdfReader::fail(const std::string& problem) const {
  throw Error(ErrorCode::parse, path_ + ": " + problem);
}

} // namespace calotte::detail
