// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_subset.h"

#include "io/bytes/file_error.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>

namespace calotte::io_detail {
namespace {

// ---- Rows

/// The largest gap between kept rows that is read: reading so many bytes costs less than another
/// call.
constexpr std::int64_t widest_gap = 1 << 15;
/// Maximum number of bytes that are read at once.
constexpr std::int64_t most_read = 1 << 20;

void copy_row(const char* from, std::int64_t bytes, char* to) {
  if (bytes == 8)
    std::memcpy(to, from, 8);
  else if (bytes == 4)
    std::memcpy(to, from, 4);
  else
    std::memcpy(to, from, static_cast<std::size_t>(bytes));
}

/// The end of the range of kept rows from `begin` on that one call reads.
std::int64_t find_read_end(const Kept& kept, std::int64_t begin, std::int64_t end,
                           std::int64_t row_bytes) {
  std::int64_t last = begin + 1;
  while (last < end && (kept.old[last] - kept.old[last - 1] - 1) * row_bytes <= widest_gap &&
         (kept.old[last] - kept.old[begin] + 1) * row_bytes <= most_read)
    ++last;
  return last;
}

/// A variable, the dimension whose rows are left out, and the size of a row in bytes.
struct Rows {
  const NetcdfReader& source;
  int variable;
  std::size_t axis;
  std::int64_t row_bytes;
};

/// Reads kept rows that have the same indices in the dimensions before the axis. Their rows start
/// at `base`.
void read_slab(const Rows& rows, std::int64_t base, const Kept& kept, std::int64_t begin,
               std::int64_t end, char* out) {
  Array<char> buffer;
  for (std::int64_t k = begin; k < end;) {
    const std::int64_t last = find_read_end(kept, k, end, rows.row_bytes), first = kept.old[k],
                       count = kept.old[last - 1] - first + 1;
    const bool whole = count == last - k;
    if (!whole && buffer.size() < count * rows.row_bytes)
      buffer = Array<char>(std::max(count * rows.row_bytes, most_read));
    rows.source.stored_rows(rows.variable, rows.axis, base + first, count,
                            whole ? out : buffer.begin());
    for (std::int64_t j = k; j < last && !whole; ++j)
      copy_row(buffer.begin() + (kept.old[j] - first) * rows.row_bytes, rows.row_bytes,
               out + (j - k) * rows.row_bytes);
    out += (last - k) * rows.row_bytes;
    k = last;
  }
}

std::int64_t row_size(const NetcdfReader& source, int variable, std::size_t axis) {
  const NetcdfVariable& of = source.variables()[static_cast<std::size_t>(variable)];
  const std::size_t rank = of.dimensions.size();
  return source.product(variable, std::min(axis + 1, rank), rank) * size_of(*of.type);
}

// ---- Dimensions

/// Finds the dimension of a variable whose rows are left out; none if there is none.
std::optional<std::size_t> find_axis(const NetcdfReader& source, const NetcdfSubset& subset,
                                     const NetcdfVariable& variable) {
  std::optional<std::size_t> axis;
  for (std::size_t d = 0; d < variable.dimensions.size(); ++d) {
    const auto id = static_cast<std::size_t>(variable.dimensions[d]);
    if (!subset.kept.contains(source.dimensions()[id].name))
      continue;
    if (axis)
      refuse_path(source.path(),
                  "{} has two dimensions of cells, edges or vertices; remove the variable",
                  variable.name);
    axis = d;
  }
  return axis;
}

/// The unlimited dimension of the new file: the first unlimited one that is the first dimension of
/// every variable with it; -1 for none.
int record_dimension(const NetcdfReader& source, const NetcdfSubset& subset) {
  for (std::size_t id = 0; id < source.dimensions().size(); ++id) {
    const NetcdfDimension& dimension = source.dimensions()[id];
    if (!dimension.unlimited || subset.kept.contains(dimension.name))
      continue;
    bool first = true;
    for (const NetcdfVariable& variable : source.variables())
      for (std::size_t d = 1; d < variable.dimensions.size(); ++d)
        first = first && variable.dimensions[d] != static_cast<int>(id);
    if (first)
      return static_cast<int>(id);
  }
  return -1;
}

/// Defines the new dimensions. \returns the new id of each dimension of the source; -1 for one of
/// size 0, which classic formats do not have.
std::vector<int> define_dimensions(const NetcdfReader& source, const NetcdfSubset& subset,
                                   NetcdfWriter& file) {
  const int records = record_dimension(source, subset);
  std::vector<int> ids;
  for (const NetcdfDimension& dimension : source.dimensions()) {
    const auto kept = subset.kept.find(dimension.name);
    const std::int64_t size = kept == subset.kept.end() ? dimension.size : kept->second->count();
    if (std::ssize(ids) == records)
      ids.push_back(file.record_dimension(dimension.name, size));
    else
      ids.push_back(size > 0 ? file.dimension(dimension.name, size) : -1);
  }
  for (const FieldDimension& added : subset.dimensions)
    if (std::none_of(source.dimensions().begin(), source.dimensions().end(),
                     [&](const auto& dimension) { return dimension.name == added.name; }))
      file.dimension(added.name, added.size);
  return ids;
}

// ---- Variables

/// A variable that is copied from the source to the new file.
struct CopiedVariable {
  int variable = 0, id = 0; ///< in the source and in the new file
  std::optional<std::size_t> axis;
  std::vector<ChangeRows> changes;
};

void put_copied(const NetcdfReader& source, const NetcdfSubset& subset,
                const CopiedVariable& copied, NetcdfWriter& file) {
  const NetcdfVariable& variable = source.variables()[static_cast<std::size_t>(copied.variable)];
  const std::size_t axis = copied.axis.value_or(0);
  const std::int64_t row_bytes = row_size(source, copied.variable, axis);
  const Kept* kept = nullptr;
  if (copied.axis)
    kept = subset.kept.at(
        source.dimensions()[static_cast<std::size_t>(variable.dimensions[axis])].name);
  file.put(copied.id, row_bytes, [&](std::int64_t begin, std::int64_t end, char* out) {
    if (kept != nullptr)
      read_kept_rows(source, copied.variable, axis, *kept, begin, end, out);
    else
      source.stored_rows(copied.variable, axis, begin, end - begin, out);
    for (const ChangeRows& change : copied.changes)
      change(begin, end, out);
  });
}

bool is_left_out(const NetcdfSubset& subset, const std::string& name) {
  return std::find(subset.left_out.begin(), subset.left_out.end(), name) != subset.left_out.end();
}

/// The attributes of a variable in the new file.
NetcdfAttributes make_attributes(const NetcdfSubset& subset, const NetcdfVariable& variable) {
  NetcdfAttributes attributes = variable.attributes;
  if (const auto name = subset.long_names.find(variable.name); name != subset.long_names.end()) {
    std::erase_if(attributes, [](const NetcdfAttribute& of) { return of.name == "long_name"; });
    attributes.push_back({"long_name", name->second});
  }
  return attributes;
}

/// Defines the variables of the source in the new file.
/// \param refused receives the names of those that it cannot have.
std::vector<CopiedVariable> define_variables(const NetcdfReader& source, const NetcdfSubset& subset,
                                             const std::vector<int>& dimensions, NetcdfWriter& file,
                                             std::vector<std::string>& refused) {
  std::vector<CopiedVariable> copies;
  for (int v = 0; v < std::ssize(source.variables()); ++v) {
    const NetcdfVariable& variable = source.variables()[static_cast<std::size_t>(v)];
    if (is_left_out(subset, variable.name))
      continue;
    std::vector<int> ids;
    for (const int d : variable.dimensions)
      ids.push_back(dimensions[static_cast<std::size_t>(d)]);
    if (!variable.type || std::find(ids.begin(), ids.end(), -1) != ids.end()) {
      refused.push_back(variable.name);
      continue;
    }
    const auto changes = subset.changes.find(variable.name);
    copies.push_back(
        {v, file.variable(variable.name, *variable.type, ids, make_attributes(subset, variable)),
         find_axis(source, subset, variable),
         changes == subset.changes.end() ? std::vector<ChangeRows>{} : changes->second});
  }
  return copies;
}

std::int32_t find_dimension(const NetcdfReader& source, const std::vector<int>& dimensions,
                            const std::string& name) {
  for (std::size_t d = 0; d < dimensions.size(); ++d)
    if (source.dimensions()[d].name == name)
      return dimensions[d];
  return -1;
}

NetcdfAttributes described_by(const std::string& units, const std::string& long_name) {
  return {{"units", units}, {"long_name", long_name}};
}

/// Defines the attributes of the file: those of the source without some, some with a new value,
/// then new ones.
void define_attributes(const NetcdfReader& source, const NetcdfSubset& subset, NetcdfWriter& file) {
  auto left = subset.attributes;
  for (const NetcdfAttribute& attribute : source.attributes()) {
    if (std::ranges::find(subset.attributes_left_out, attribute.name) !=
        subset.attributes_left_out.end())
      continue;
    const auto replaced = left.find(attribute.name);
    file.attribute(replaced == left.end() ? attribute : replaced->second);
    if (replaced != left.end())
      left.erase(replaced);
  }
  for (const auto& [name, attribute] : left)
    file.attribute(attribute);
}

} // namespace

void read_kept_rows(const NetcdfReader& source, int variable, std::size_t axis, const Kept& kept,
                    std::int64_t begin, std::int64_t end, char* out) {
  const Rows rows{source, variable, axis, row_size(source, variable, axis)};
  const std::int64_t all = source.product(variable, axis, axis + 1);
  while (begin < end) {
    const std::int64_t slab = begin / kept.count(), first = begin - slab * kept.count(),
                       last = std::min(kept.count(), first + end - begin);
    read_slab(rows, slab * all, kept, first, last, out);
    out += (last - first) * rows.row_bytes;
    begin += last - first;
  }
}

std::int64_t row_values(const NetcdfReader& source, const NetcdfSubset& subset, int variable) {
  const NetcdfVariable& of = source.variables()[static_cast<std::size_t>(variable)];
  return row_size(source, variable, find_axis(source, subset, of).value_or(0)) / size_of(*of.type);
}

std::vector<std::string> put_subset(const NetcdfReader& source, const NetcdfSubset& subset,
                                    NetcdfWriter& file) {
  std::vector<std::string> refused;
  const std::vector<int> dimensions = define_dimensions(source, subset, file);
  const std::vector<CopiedVariable> copies =
      define_variables(source, subset, dimensions, file, refused);
  std::vector<int> added, numbers;
  for (const NetcdfSubset::Added& of : subset.added)
    added.push_back(file.variable(of.name, NetcdfType::int32,
                                  {find_dimension(source, dimensions, of.dimension)},
                                  described_by("1", of.long_name)));
  for (const NetcdfSubset::Number& of : subset.numbers)
    numbers.push_back(
        file.variable(of.name, NetcdfType::float64, {}, described_by(of.units, of.long_name)));
  define_attributes(source, subset, file);
  file.begin();
  for (const CopiedVariable& copied : copies)
    put_copied(source, subset, copied, file);
  for (std::size_t k = 0; k < added.size(); ++k)
    file.put(added[k], NetcdfWriter::Fill<std::int32_t>(
                           [&](std::int64_t begin, std::int64_t end, std::int32_t* out) {
                             for (std::int64_t i = begin; i < end; ++i)
                               *out++ = subset.added[k].value(i);
                           }));
  for (std::size_t k = 0; k < numbers.size(); ++k)
    file.put(numbers[k], NetcdfWriter::Fill<double>([&](std::int64_t, std::int64_t, double* out) {
               *out = subset.numbers[k].value;
             }));
  return refused;
}

} // namespace calotte::io_detail
