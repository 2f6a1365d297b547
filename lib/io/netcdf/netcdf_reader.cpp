// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/netcdf/netcdf_reader.h"

#include "base/array.h"
#include "base/parallel.h"
#include "io/bytes/big_endian.h"
#include "io/bytes/file_error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <type_traits>
#include <utility>

namespace calotte::io_detail {
namespace {

// ---- Shapes

bool matches(const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& wanted) {
  return std::equal(shape.begin(), shape.end(), wanted.begin(), wanted.end(),
                    [](std::int64_t size, std::int64_t want) { return want < 0 || size == want; });
}

// ---- Conversion of values

/// Why a value cannot be converted; null if it can.
using Problem = const char*;

template <class From> Problem convert_value(From value, double& out) {
  out = static_cast<double>(value);
  return nullptr;
}

template <class From> Problem convert_value(From value, std::int32_t& out) {
  using Limits = std::numeric_limits<std::int32_t>;
  if constexpr (std::is_floating_point_v<From>) {
    const auto number = static_cast<double>(value);
    if (!(number >= Limits::min() && number <= Limits::max()) || number != std::floor(number))
      return "has a number that is not a 32-bit integer";
  } else if (!std::in_range<std::int32_t>(value)) {
    return "has a number out of range";
  }
  out = static_cast<std::int32_t>(value);
  return nullptr;
}

/// Converts values of the machine's order, up to the first with a problem.
template <class From, class T> Problem convert(const char* bytes, std::int64_t count, T* out) {
  for (std::int64_t i = 0; i < count; ++i) {
    From value;
    std::memcpy(&value, bytes + i * std::int64_t{sizeof(From)}, sizeof(From));
    if (const Problem problem = convert_value(value, out[i]); problem != nullptr)
      return problem;
  }
  return nullptr;
}

template <class T> Problem convert(NetcdfType type, const char* bytes, std::int64_t count, T* out) {
  switch (type) {
  case NetcdfType::text:
    return "is text, not numbers";
  case NetcdfType::int8:
    return convert<std::int8_t>(bytes, count, out);
  case NetcdfType::int16:
    return convert<std::int16_t>(bytes, count, out);
  case NetcdfType::int32:
    return convert<std::int32_t>(bytes, count, out);
  case NetcdfType::float32:
    return convert<float>(bytes, count, out);
  case NetcdfType::float64:
    return convert<double>(bytes, count, out);
  case NetcdfType::uint8:
    return convert<std::uint8_t>(bytes, count, out);
  case NetcdfType::uint16:
    return convert<std::uint16_t>(bytes, count, out);
  case NetcdfType::uint32:
    return convert<std::uint32_t>(bytes, count, out);
  case NetcdfType::int64:
    return convert<std::int64_t>(bytes, count, out);
  default:
    return convert<std::uint64_t>(bytes, count, out);
  }
}

bool is_floating(std::optional<NetcdfType> type) {
  return type == NetcdfType::float32 || type == NetcdfType::float64;
}

} // namespace

std::string in_words(const std::vector<std::int64_t>& shape) {
  std::vector<std::string> words;
  for (const std::int64_t size : shape)
    words.push_back(size < 0 ? "any" : std::to_string(size));
  return message("({})", listed(words));
}

NetcdfReader::NetcdfReader(const std::string& path) : file_(path) {
  if (is_classic_netcdf(file_)) {
    header_ = classic_header(file_);
    require_values();
  } else {
    library_.emplace(file_);
    header_ = library_->header();
    require_sizes();
  }
  if (variables().empty() && !header_.groups.empty())
    fail_for_groups("it holds nothing");
  for (int v = 0; v < std::ssize(variables()); ++v)
    by_name_.push_back(v);
  std::sort(by_name_.begin(), by_name_.end(), [&](int a, int b) {
    return variables()[static_cast<std::size_t>(a)].name <
           variables()[static_cast<std::size_t>(b)].name;
  });
}

/// Throws unless a classic file contains all values, in the order of the variables, those with
/// records last. The C library reads no other files.
void NetcdfReader::require_values() const {
  for (const NetcdfVariable& variable : variables())
    if (variable.begin < header_.bytes || variable.end > file_.size())
      fail("it is cut short: {} is incomplete; make it again", variable.name);
  std::int64_t end = header_.bytes;
  for (const bool of_records : {false, true})
    for (int v = 0; v < std::ssize(variables()); ++v) {
      const NetcdfVariable& variable = variables()[static_cast<std::size_t>(v)];
      if ((variable.stride > 0) != of_records)
        continue;
      if (variable.begin < end)
        fail("its header is damaged: {} begins within another variable; make it again",
             variable.name);
      end = of_records ? variable.begin + record_bytes(v) : variable.end;
    }
}

/// Throws unless the size in bytes of each variable, and of each part of one, is within 64 bits.
void NetcdfReader::require_sizes() const {
  for (const NetcdfVariable& variable : variables()) {
    std::int64_t bytes = sizeof(double);
    for (const int d : variable.dimensions)
      if (__builtin_mul_overflow(
              bytes, std::max<std::int64_t>(dimensions()[static_cast<std::size_t>(d)].size, 1),
              &bytes))
        fail("{} is too large; make the file again", variable.name);
  }
}

void NetcdfReader::fail(const std::string& problem) const { fail_file(path(), problem); }

// ---- The header

int NetcdfReader::find(const std::string& variable) const {
  const auto name_of = [&](int v) -> const std::string& {
    return variables()[static_cast<std::size_t>(v)].name;
  };
  const auto found =
      std::lower_bound(by_name_.begin(), by_name_.end(), variable,
                       [&](int v, const std::string& name) { return name_of(v) < name; });
  return found != by_name_.end() && name_of(*found) == variable ? *found : -1;
}

std::vector<std::string> NetcdfReader::variable_names() const {
  std::vector<std::string> names;
  for (const NetcdfVariable& variable : variables())
    names.push_back(variable.name);
  return names;
}

int NetcdfReader::require_variable(const std::string& name, const std::string& remedy) const {
  const int v = find(name);
  if (v < 0 && !header_.groups.empty())
    fail_for_groups(message("it has no variable {}", name));
  if (v < 0)
    fail("it has no variable {}; {}", name, remedy);
  return v;
}

void NetcdfReader::fail_for_groups(const std::string& problem) const {
  fail("{} beside its groups ({}), which are not read; ncks -G : -g {} IN OUT takes what one holds "
       "out",
       problem, listed(header_.groups), header_.groups.front());
}

std::vector<std::string> NetcdfReader::dimensions_of(const std::string& variable) const {
  std::vector<std::string> names;
  for (const int id : variables()[static_cast<std::size_t>(require_variable(variable))].dimensions)
    names.push_back(dimensions()[static_cast<std::size_t>(id)].name);
  return names;
}

std::vector<std::int64_t> NetcdfReader::shape_of(const std::string& variable) const {
  std::vector<std::int64_t> shape;
  for (const int id : variables()[static_cast<std::size_t>(require_variable(variable))].dimensions)
    shape.push_back(dimensions()[static_cast<std::size_t>(id)].size);
  return shape;
}

std::int64_t NetcdfReader::product(int variable, std::size_t first, std::size_t last) const {
  const std::vector<int>& of = variables()[static_cast<std::size_t>(variable)].dimensions;
  std::int64_t product = 1;
  for (std::size_t d = first; d < last; ++d)
    product *= dimensions()[static_cast<std::size_t>(of[d])].size;
  return product;
}

/// Size in bytes of one record of a variable; 0 without records.
std::int64_t NetcdfReader::record_bytes(int variable) const {
  const NetcdfVariable& of = variables()[static_cast<std::size_t>(variable)];
  return of.stride == 0 ? 0 : product(variable, 1, of.dimensions.size()) * size_of(*of.type);
}

const NetcdfDimension* NetcdfReader::find_dimension(const std::string& name) const {
  const auto found = std::ranges::find(dimensions(), name, &NetcdfDimension::name);
  return found == dimensions().end() ? nullptr : &*found;
}

std::int64_t NetcdfReader::dimension(const std::string& name) const {
  const NetcdfDimension* const found = find_dimension(name);
  return found == nullptr ? -1 : found->size;
}

bool NetcdfReader::is_unlimited(const std::string& dimension) const {
  const NetcdfDimension* const found = find_dimension(dimension);
  return found != nullptr && found->unlimited;
}

std::optional<NetcdfType> NetcdfReader::type_of(const std::string& variable) const {
  const int v = find(variable);
  return v < 0 ? std::nullopt : variables()[static_cast<std::size_t>(v)].type;
}

bool NetcdfReader::is_numeric(const std::string& variable) const {
  const std::optional<NetcdfType> type = type_of(variable);
  return type && type != NetcdfType::text;
}

bool NetcdfReader::is_integer(const std::string& variable) const {
  return is_numeric(variable) && !is_floating(type_of(variable));
}

bool NetcdfReader::is_float(const std::string& variable) const {
  return type_of(variable) == NetcdfType::float32;
}

const NetcdfAttribute* NetcdfReader::find_attribute(const std::string& variable,
                                                    const std::string& attribute) const {
  const int v = variable.empty() ? -1 : find(variable);
  if (v < 0 && !variable.empty())
    return nullptr;
  const NetcdfAttributes& all =
      v < 0 ? attributes() : variables()[static_cast<std::size_t>(v)].attributes;
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const NetcdfAttribute& a) { return a.name == attribute; });
  return found == all.end() ? nullptr : &*found;
}

std::string NetcdfReader::text(const std::string& variable, const std::string& attribute) const {
  const NetcdfAttribute* const found = find_attribute(variable, attribute);
  const auto* const text = found != nullptr ? std::get_if<std::string>(&found->value) : nullptr;
  return text != nullptr ? text->substr(0, text->find('\0')) : "";
}

std::vector<double> NetcdfReader::numbers(const std::string& variable,
                                          const std::string& attribute) const {
  const NetcdfAttribute* const found = find_attribute(variable, attribute);
  const auto* const values = found != nullptr ? std::get_if<NetcdfValues>(&found->value) : nullptr;
  if (values == nullptr)
    return {};
  std::vector<double> numbers(values->bytes.size() /
                              static_cast<std::size_t>(size_of(values->type)));
  convert(values->type, values->bytes.data(), std::ssize(numbers), numbers.data());
  return numbers;
}

double NetcdfReader::number(const std::string& variable, const std::string& attribute,
                            double fallback) const {
  const std::vector<double> all = numbers(variable, attribute);
  return all.size() == 1 ? all.front() : fallback;
}

std::int32_t NetcdfReader::start_index(const std::string& variable, std::int32_t fallback) const {
  const double start = number(variable, "start_index", fallback);
  if (start != 0 && start != 1)
    fail("the attribute start_index of {} is neither 0 nor 1; correct it", variable);
  return static_cast<std::int32_t>(start);
}

// ---- Values

std::vector<double> NetcdfReader::doubles(const std::string& variable,
                                          const std::vector<std::int64_t>& shape) const {
  return get_all<double>(variable, shape);
}

std::vector<std::int32_t> NetcdfReader::ints(const std::string& variable,
                                             const std::vector<std::int64_t>& shape) const {
  return get_all<std::int32_t>(variable, shape);
}

void NetcdfReader::rows(const std::string& variable, std::int64_t first, std::int64_t count,
                        double* out) const {
  get_rows(require_variable(variable), first, count, out);
}

void NetcdfReader::rows(const std::string& variable, std::int64_t first, std::int64_t count,
                        std::int32_t* out) const {
  get_rows(require_variable(variable), first, count, out);
}

template <class T>
std::vector<T> NetcdfReader::get_all(const std::string& variable,
                                     const std::vector<std::int64_t>& shape) const {
  const std::vector<std::int64_t> has = shape_of(variable);
  if (!matches(has, shape))
    fail("{} has the shape {} instead of {}; make the file again", variable, in_words(has),
         in_words(shape));
  const std::int64_t count = product(find(variable), 0, has.size());
  std::vector<T> values = room_for<T>(variable, count);
  if (count > 0)
    get_rows(find(variable), 0, has.empty() ? 1 : has[0], values.data());
  return values;
}

/// Memory for values of a variable.
template <class T>
std::vector<T> NetcdfReader::room_for(const std::string& variable, std::int64_t count) const {
  // The largest compression ratio of deflate, for a file that stores each value in some form.
  constexpr std::int64_t most_compressed = 1032, least = std::int64_t{1} << 24;
  if (count > least && count / most_compressed > file_.size() / std::int64_t{sizeof(T)})
    fail("{} has more values than a file of its size can hold; make the file again", variable);
  std::vector<T> values;
  try {
    values.resize(static_cast<std::size_t>(count));
  } catch (const std::exception&) {
    fail("{} is too large for this machine's memory; read it on a larger one", variable);
  }
  return values;
}

std::vector<double> NetcdfReader::part(const std::string& variable,
                                       const std::vector<std::int64_t>& start,
                                       const std::vector<std::int64_t>& count) const {
  const int id = require_variable(variable);
  const std::size_t rank = count.size();
  std::int64_t all = 1;
  for (const std::int64_t entries : count)
    all *= entries;
  std::vector<double> values = room_for<double>(variable, all);
  if (all == 0)
    return values;
  if (library_) {
    std::vector<std::size_t> from(start.begin(), start.end()), entries(count.begin(), count.end());
    from.push_back(0), entries.push_back(1); // of variables without dimensions
    library_->get(id, from, entries, values.data());
    return values;
  }
  std::size_t whole = rank; // the dimensions from here on are whole
  while (whole > 0 && count[whole - 1] == product(id, whole - 1, whole))
    --whole;
  const std::size_t axis = whole > 0 ? whole - 1 : 0; // values of the same indices before it adjoin
  const std::int64_t run = rank > 0 ? count[axis] * product(id, axis + 1, rank) : 1;
  for (std::int64_t k = 0; k < all / run; ++k) {
    std::int64_t first = 0, rest = k;
    for (std::size_t d = std::min(axis + 1, rank); d-- > 0;) {
      const std::int64_t entries = d == axis ? 1 : count[d];
      first += (start[d] + rest % entries) * product(id, d + 1, rank);
      rest /= entries;
    }
    get_values(id, first, run, values.data() + k * run);
  }
  file_.require_whole();
  return values;
}

void NetcdfReader::require_converted(const NetcdfVariable& variable, const char* problem) const {
  if (problem != nullptr)
    fail("{} {}; make the file again", variable.name, problem);
}

template <class T>
void NetcdfReader::get_rows(int variable, std::int64_t first, std::int64_t count, T* out) const {
  const NetcdfVariable& of = variables()[static_cast<std::size_t>(variable)];
  const std::size_t rank = of.dimensions.size();
  const std::int64_t row = product(variable, std::min<std::size_t>(rank, 1), rank);
  if (!library_) {
    get_values(variable, first * row, count * row, out);
    return file_.require_whole();
  }
  if constexpr (std::is_same_v<T, std::int32_t>)
    if (is_floating(of.type)) { // the library would truncate fractions, and has no integer for NaN
      std::vector<double> values(static_cast<std::size_t>(count * row));
      get_rows(variable, first, count, values.data());
      return require_converted(
          of, convert<double>(reinterpret_cast<const char*>(values.data()), count * row, out));
    }
  std::vector<std::size_t> start(rank + 1, 0), counts(rank + 1, 1);
  for (std::size_t d = 0; d < rank; ++d)
    counts[d] = static_cast<std::size_t>(product(variable, d, d + 1));
  if (rank > 0) {
    start[0] = static_cast<std::size_t>(first);
    counts[0] = static_cast<std::size_t>(count);
  }
  library_->get(variable, start, counts, out);
}

/// Reads `count` values of a variable of a classic file, from value `first` on, block by block.
template <class T>
void NetcdfReader::get_values(int variable, std::int64_t first, std::int64_t count, T* out) const {
  constexpr std::int64_t block_values = 1 << 17;
  const NetcdfVariable& of = variables()[static_cast<std::size_t>(variable)];
  const std::int64_t size = size_of(*of.type);
  for_each_task((count + block_values - 1) / block_values, [&](std::int64_t block) {
    const std::int64_t begin = block * block_values, n = std::min(block_values, count - begin);
    const bool as_they_are = of.type == type_in_memory<T>;
    Array<char> stored(as_they_are ? 0 : n * size);
    char* const bytes = as_they_are ? reinterpret_cast<char*>(out + begin) : stored.begin();
    read_bytes(variable, (first + begin) * size, n * size, bytes);
    swap_big_endian(bytes, n, size, bytes);
    if (!as_they_are)
      require_converted(of, convert(*of.type, bytes, n, out + begin));
  });
}

void NetcdfReader::stored_rows(int variable, std::size_t axis, std::int64_t first,
                               std::int64_t count, char* out) const {
  const NetcdfVariable& of = variables()[static_cast<std::size_t>(variable)];
  const std::size_t rank = of.dimensions.size();
  const std::int64_t values = product(variable, std::min(axis + 1, rank), rank),
                     size = size_of(*of.type);
  if (!library_)
    return read_bytes(variable, first * values * size, count * values * size, out);
  std::vector<std::size_t> start(rank + 1, 0), counts(rank + 1, 1);
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
  library_->get(variable, start, counts, out);
  swap_big_endian(out, count * values, size, out);
}

/// Reads bytes of a variable of a classic file, in the order of its values. Records that are close
/// to each other are read in one call, together with the bytes between them.
void NetcdfReader::read_bytes(int variable, std::int64_t begin, std::int64_t size,
                              char* out) const {
  constexpr std::int64_t most_read = 1 << 20, near = 8; // times the bytes of a record
  const NetcdfVariable& of = variables()[static_cast<std::size_t>(variable)];
  const std::int64_t record = record_bytes(variable), stride = of.stride;
  if (stride == 0 || stride == record)
    return file_.read(of.begin + begin, size, out);
  Array<char> span;
  while (size > 0) {
    const std::int64_t first = begin / record, within = begin % record,
                       count = std::clamp<std::int64_t>(
                           (within + size - 1) / record + 1, 1,
                           stride > near * record ? 1
                                                  : std::max<std::int64_t>(most_read / stride, 1)),
                       bytes = std::min(size, count * record - within);
    if (count == 1) {
      file_.read(of.begin + first * stride + within, bytes, out);
    } else {
      if (span.size() == 0)
        span = Array<char>(count * stride);
      file_.read(of.begin + first * stride, (count - 1) * stride + record, span.begin());
      for (std::int64_t done = 0; done < bytes;) {
        const std::int64_t at = within + done, part = std::min(record - at % record, bytes - done);
        std::memcpy(out + done, span.begin() + at / record * stride + at % record,
                    static_cast<std::size_t>(part));
        done += part;
      }
    }
    out += bytes, begin += bytes, size -= bytes;
  }
}

} // namespace calotte::io_detail
