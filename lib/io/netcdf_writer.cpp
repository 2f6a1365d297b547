// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf_writer.h"

#include "base/elementary.h"
#include "base/parallel.h"
#include "io/file.h"
#include "io/netcdf_header.h"
#include "io/netcdf_library.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <mutex>
#include <type_traits>
#include <utility>

namespace calotte::io_detail {
namespace {

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

/// The classic formats store numbers with the most significant byte first.
/// \param out need not be aligned.
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

/// The same for all rows, each block in its own task. Blocks are large, which suits the disk, but
/// numerous enough for all threads.
template <class Body>
void for_each_block_of_rows(std::int64_t rows, std::int64_t row_bytes, const Body& body) {
  const std::int64_t block_bytes =
      std::clamp<std::int64_t>(rows * row_bytes / 8, std::int64_t{1} << 20, std::int64_t{1} << 24);
  const std::int64_t block_rows = std::max<std::int64_t>(block_bytes / row_bytes, 1);
  for_each_task((rows + block_rows - 1) / block_rows, [&](std::int64_t block) {
    body(block * block_rows, std::min(rows, (block + 1) * block_rows));
  });
}

/// Number of bytes filled at once, so that their conversion finds them in the cache.
constexpr std::int64_t fill_bytes = 1 << 17;

} // namespace

/// The C library writes the header; tasks of this library convert and write the values. The library
/// would do it serially and take three times as long for a large mesh.
struct NetcdfWriter::State {
  struct Dimension {
    std::string name;
    std::int64_t size;
    bool of_fields = false;
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

  /// Rows of a variable on their way to the file.
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
  ProgressCallback progress; ///< given to the file when its size is known
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

NetcdfWriter::NetcdfWriter(const std::string& path, ProgressCallback progress) {
  require_regular_output(path);
  state_ = std::make_unique<State>(path);
  state_->progress = std::move(progress);
}

NetcdfWriter::~NetcdfWriter() = default;

int NetcdfWriter::dimension(const std::string& name, std::int64_t size) {
  state_->dimensions.push_back({.name = name, .size = size});
  return static_cast<int>(state_->dimensions.size()) - 1;
}

int NetcdfWriter::field_dimension(const std::string& name, std::int64_t size) {
  std::vector<State::Dimension>& all = state_->dimensions;
  for (std::string free = name;; free.append(1, '_').append(std::to_string(size))) {
    const auto known = std::find_if(all.begin(), all.end(),
                                    [&](const State::Dimension& d) { return d.name == free; });
    if (known == all.end()) {
      all.push_back({.name = free, .size = size, .of_fields = true});
      return static_cast<int>(all.size()) - 1;
    }
    if (known->size == 0)
      *known = {.name = free, .size = size, .of_fields = true};
    if (known->of_fields && known->size == size)
      return static_cast<int>(known - all.begin());
  }
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

  const std::lock_guard lock(netcdf_mutex());
  const std::string& path = state_->file.temporary();
  int id = -1;
  state_->require(nc_create(netcdf_path(path).c_str(), NC_CLOBBER | format, &id));
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
  state_->file.watch(std::move(state_->progress), size);
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

} // namespace calotte::io_detail
