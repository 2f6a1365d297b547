// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_writer.h"

#include "base/message.h"
#include "base/parallel.h"
#include "io/bytes/file.h"
#include "io/bytes/file_reader.h"
#include "io/netcdf/netcdf_header.h"
#include "io/netcdf/netcdf_library.h"
#include "io/netcdf/netcdf_rows.h"

#include <calotte/error.h>

#include <netcdf.h>

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>

namespace calotte::io_detail {
namespace {

static_assert(static_cast<int>(NetcdfType::text) == NC_CHAR &&
              static_cast<int>(NetcdfType::float64) == NC_DOUBLE &&
              static_cast<int>(NetcdfType::uint64) == NC_UINT64);

nc_type code_of(NetcdfType type) { return static_cast<nc_type>(type); }

bool needs_cdf5(NetcdfType type) { return type > NetcdfType::float64; }

int put_attribute(int id, int variable, const NetcdfAttribute& attribute) {
  const char* name = attribute.name.c_str();
  if (const auto* text = std::get_if<std::string>(&attribute.value))
    return nc_put_att_text(id, variable, name, text->size(), text->c_str());
  if (const auto* number = std::get_if<double>(&attribute.value))
    return nc_put_att_double(id, variable, name, NC_DOUBLE, 1, number);
  if (const auto* number = std::get_if<std::int32_t>(&attribute.value))
    return nc_put_att_int(id, variable, name, NC_INT, 1, number);
  if (const auto* values = std::get_if<NetcdfValues>(&attribute.value))
    return nc_put_att(id, variable, name, code_of(values->type),
                      values->bytes.size() / static_cast<std::size_t>(size_of(values->type)),
                      values->bytes.data());
  return nc_put_att_schar(id, variable, name, NC_BYTE, 1,
                          std::get_if<std::int8_t>(&attribute.value));
}

bool needs_cdf5(const NetcdfAttributes& attributes) {
  return std::any_of(attributes.begin(), attributes.end(), [](const NetcdfAttribute& attribute) {
    const auto* values = std::get_if<NetcdfValues>(&attribute.value);
    return values != nullptr && needs_cdf5(values->type);
  });
}

} // namespace

/// The C library writes the header; tasks of this library convert and write the values.
struct NetcdfWriter::State {
  struct Dimension {
    std::string name;
    std::int64_t size;
    bool of_fields = false;
    bool of_records = false;
  };
  struct Variable {
    std::string name;
    NetcdfType type;
    std::vector<int> dimensions;
    NetcdfAttributes attributes;
    std::int64_t rows = 1, row_values = 1; ///< values in a row
    std::int64_t offset = -1;              ///< in the file, after begin()
    std::int64_t stride = 0;               ///< bytes from a record to the next; 0 without records
    bool is_put = false;
    std::int64_t row_bytes() const { return row_values * size_of(type); }
    std::int64_t bytes() const { return rows * row_bytes(); }
    StoredRows stored() const { return {offset, row_values, row_bytes()}; }
  };

  explicit State(const std::string& path) : file(path) {}

  void require(int code) const;
  int format() const;
  void define(int id) const;
  void extend_to_last_record(int id) const;
  template <class T> void put(int variable, const Fill<T>& fill);
  void put(const std::vector<int>& ints, const std::vector<int>& doubles, const GroupFill& fill);
  void put(int variable, std::int64_t piece_bytes, const FillBytes& fill);
  Variable& start(int variable, NetcdfType type);

  OutputFile file;
  ProgressCallback progress; ///< given to the file when its size is known
  std::vector<Dimension> dimensions;
  std::vector<Variable> variables;
  NetcdfAttributes attributes;
};

void NetcdfWriter::State::require(int code) const {
  if (code == NC_ENOMEM)
    throw std::bad_alloc();
  if (code > 0)
    file.fail(code);
  if (code != NC_NOERR)
    throw Error(ErrorCode::internal,
                message("the NetCDF library refuses what Calotte writes ({}); report this as a bug",
                        nc_strerror(code)));
}

void NetcdfWriter::State::define(int id) const {
  require(nc_set_fill(id, NC_NOFILL, nullptr));
  for (const Dimension& dimension : dimensions) {
    int unused;
    const auto size = static_cast<std::size_t>(dimension.size);
    require(nc_def_dim(id, dimension.name.c_str(),
                       size == 0 || dimension.of_records ? NC_UNLIMITED : size, &unused));
  }
  for (const Variable& variable : variables) {
    int v;
    require(nc_def_var(id, variable.name.c_str(), code_of(variable.type),
                       static_cast<int>(variable.dimensions.size()), variable.dimensions.data(),
                       &v));
    for (const NetcdfAttribute& attribute : variable.attributes)
      require(put_attribute(id, v, attribute));
  }
  for (const NetcdfAttribute& attribute : attributes)
    require(put_attribute(id, NC_GLOBAL, attribute));
  require(nc_enddef(id));
}

int NetcdfWriter::State::format() const {
  std::vector<std::int64_t> bytes;
  bool cdf5 = needs_cdf5(attributes);
  for (const Variable& variable : variables) {
    bytes.push_back(variable.bytes());
    cdf5 = cdf5 || needs_cdf5(variable.type) || needs_cdf5(variable.attributes);
  }
  return cdf5 || io_detail::needs_cdf5(bytes) ? NC_64BIT_DATA : NC_64BIT_OFFSET;
}

/// Writes a value of the last record: the library counts records by what is written.
void NetcdfWriter::State::extend_to_last_record(int id) const {
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const Variable& variable = variables[v];
    const bool of_records = !variable.dimensions.empty() &&
                            dimensions[static_cast<std::size_t>(variable.dimensions[0])].of_records;
    if (!of_records || variable.bytes() == 0)
      continue;
    std::vector<std::size_t> last(variable.dimensions.size(), 0);
    last[0] = static_cast<std::size_t>(variable.rows - 1);
    const std::int64_t zero = 0;
    require(nc_put_var1(id, static_cast<int>(v), last.data(), &zero));
    return;
  }
}

NetcdfWriter::State::Variable& NetcdfWriter::State::start(int variable, NetcdfType type) {
  Variable& of = variables.at(static_cast<std::size_t>(variable));
  if (of.type != type || of.offset < 0 || of.is_put)
    throw Error(ErrorCode::internal,
                message("{} is put as another type, twice or before begin()", of.name));
  of.is_put = true;
  return of;
}

template <class T> void NetcdfWriter::State::put(int variable, const Fill<T>& fill) {
  const Variable& of = start(variable, type_in_memory<T>);
  for_each_block_of_rows(of.rows, of.row_bytes(), [&](std::int64_t first, std::int64_t last) {
    RowBlock<T> block(file, of.stored(), first, last);
    for_each_rows(first, last, of.row_bytes(), fill_bytes,
                  [&](std::int64_t begin, std::int64_t end) {
                    fill(begin, end, block.room(begin, end));
                    block.convert(begin, end);
                  });
    file.put(std::move(block.bytes));
  });
}

void NetcdfWriter::State::put(const std::vector<int>& ints, const std::vector<int>& doubles,
                              const GroupFill& fill) {
  std::int64_t rows = 0, row_bytes = 0;
  const auto start_all = [&](const std::vector<int>& ids, NetcdfType type) {
    std::vector<StoredRows> all;
    for (const int id : ids) {
      const Variable& of = start(id, type);
      all.push_back(of.stored());
      rows = of.rows;
      row_bytes += of.row_bytes();
    }
    return all;
  };
  const std::vector<StoredRows> of_ints = start_all(ints, NetcdfType::int32),
                                of_doubles = start_all(doubles, NetcdfType::float64);
  for_each_block_of_rows(rows, row_bytes, [&](std::int64_t first, std::int64_t last) {
    RowBlocks<std::int32_t> some(file, of_ints, first, last);
    RowBlocks<double> others(file, of_doubles, first, last);
    for_each_rows(first, last, row_bytes, fill_bytes, [&](std::int64_t begin, std::int64_t end) {
      fill(begin, end, some.room(begin, end), others.room(begin, end));
      some.convert(begin, end);
      others.convert(begin, end);
    });
    some.put(file);
    others.put(file);
  });
}

void NetcdfWriter::State::put(int variable, std::int64_t piece_bytes, const FillBytes& fill) {
  const Variable& of = start(variable, variables.at(static_cast<std::size_t>(variable)).type);
  if (of.bytes() == 0)
    return;
  const std::int64_t records = of.stride > 0 ? of.rows : 1, bytes = of.bytes() / records,
                     pieces = bytes / piece_bytes;
  for (std::int64_t record = 0; record < records; ++record)
    for_each_block_of_rows(pieces, piece_bytes, [&](std::int64_t begin, std::int64_t end) {
      OutputBlock block = file.block(of.offset + record * of.stride + begin * piece_bytes,
                                     (end - begin) * piece_bytes);
      fill(record * pieces + begin, record * pieces + end, block.begin());
      file.put(std::move(block));
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

int NetcdfWriter::record_dimension(const std::string& name, std::int64_t records) {
  state_->dimensions.push_back({.name = name, .size = records, .of_records = true});
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
  const std::lock_guard lock(netcdf_mutex());
  const std::string& path = state_->file.temporary();
  int id = -1;
  state_->require(nc_create(netcdf_path(path).c_str(), NC_CLOBBER | state_->format(), &id));
  try {
    state_->define(id);
    state_->extend_to_last_record(id);
    state_->require(nc_sync(id));
  } catch (...) {
    nc_abort(id);
    throw;
  }
  state_->require(nc_close(id));
  const NetcdfHeader header = classic_header(FileReader(path));
  std::int64_t size = header.bytes;
  for (std::size_t v = 0; v < header.variables.size(); ++v) {
    State::Variable& variable = state_->variables[v];
    variable.offset = header.variables[v].begin;
    variable.stride = header.variables[v].stride;
    size = std::max(size, header.variables[v].end);
  }
  state_->file.reserve(size);
  state_->file.watch(std::move(state_->progress), size);
}

void NetcdfWriter::put(int variable, const Fill<double>& fill) { state_->put(variable, fill); }
void NetcdfWriter::put(int variable, const Fill<std::int32_t>& fill) {
  state_->put(variable, fill);
}
void NetcdfWriter::put(int variable, const Fill<std::int8_t>& fill) { state_->put(variable, fill); }

void NetcdfWriter::put(const std::vector<int>& ints, const std::vector<int>& doubles,
                       const GroupFill& fill) {
  state_->put(ints, doubles, fill);
}

void NetcdfWriter::put(int variable, std::int64_t piece_bytes, const FillBytes& fill) {
  state_->put(variable, piece_bytes, fill);
}

void NetcdfWriter::finish() {
  for (const State::Variable& variable : state_->variables)
    if (!variable.is_put)
      throw Error(ErrorCode::internal, message("{} is not put", variable.name));
  state_->file.finish();
}

void NetcdfWriter::commit() {
  finish();
  state_->file.commit();
}

} // namespace calotte::io_detail
