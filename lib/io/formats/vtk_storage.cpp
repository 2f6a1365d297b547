// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/vtk_storage.h"
#include "io/bytes/file_error.h"

#include "io/bytes/base64.h"
#include "io/bytes/text.h"
#include "io/formats/poly_data.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace calotte::io_detail {
namespace {

/// An array of a file. Messages contain both names.
struct ArrayInFile {
  const VtkStorage& storage;
  const XmlElement& element;

  std::string name() const {
    return in_array(storage.name, element.attribute("Name", element.name));
  }
};

// ---- Bytes

/// Bytes of the file, or decoded bytes that it owns.
class StoredBytes {
public:
  explicit StoredBytes(std::string_view bytes) : bytes_(bytes) {}
  explicit StoredBytes(std::string&& own) : own_(std::move(own)) {}
  std::string_view view() const { return own_.empty() ? bytes_ : std::string_view(own_); }

private:
  std::string_view bytes_;
  std::string own_;
};

/// The stored bytes of an array from its header on.
class Source {
public:
  Source(const ArrayInFile& array, std::string_view stored, bool base64)
      : array_(array), raw_(stored), base64_(stored), is_base64_(base64) {}

  std::int64_t most() const {
    return is_base64_ ? base64_.most() : static_cast<std::int64_t>(raw_.size());
  }

  /// \throws Error parse if there are fewer.
  StoredBytes take(std::uint64_t count) {
    if (count > static_cast<std::uint64_t>(most()))
      fail_damaged(array_.name(), "its data end early");
    if (!is_base64_) {
      const std::string_view taken = raw_.substr(0, count);
      raw_.remove_prefix(count);
      return StoredBytes(taken);
    }
    std::string out;
    out.reserve(count);
    base64_.take(static_cast<std::int64_t>(count), out);
    if (out.size() != count)
      fail_damaged(array_.name(), "its base64 text ends early or has another character");
    return StoredBytes(std::move(out));
  }

  std::uint64_t take_length() {
    const VtkStorage& storage = array_.storage;
    const StoredBytes bytes = take(static_cast<std::uint64_t>(size_of(storage.length_type)));
    return storage.length_type == Scalar::uint64
               ? stored<std::uint64_t>(bytes.view().data(), storage.swapped)
               : stored<std::uint32_t>(bytes.view().data(), storage.swapped);
  }

private:
  const ArrayInFile& array_;
  std::string_view raw_;
  Base64Reader base64_;
  bool is_base64_;
};

/// \param size required number of bytes; -1 for any number.
void require_size(const ArrayInFile& array, std::uint64_t bytes, std::int64_t size) {
  if (size >= 0 && bytes != static_cast<std::uint64_t>(size))
    fail_damaged(array.name(), "it has {} bytes, but {} belong there", bytes, size);
}

// ---- Compression

/// The header of a compressed array: blocks of one size, followed by one of another size, unless
/// that is 0.
struct Blocks {
  std::uint64_t size = 0, last = 0;
  std::vector<std::uint64_t> compressed; ///< size of each

  std::uint64_t size_of_block(std::size_t i) const {
    return i + 1 == compressed.size() && last > 0 ? last : size;
  }
};

/// zlib compresses to a thousandth at best (its manual: 1030:1).
bool is_plausible(std::uint64_t size, std::uint64_t compressed) {
  return size / 1100 <= compressed + 1;
}

Blocks take_blocks(const ArrayInFile& array, Source& source) {
  const std::uint64_t count = source.take_length();
  Blocks blocks{.size = source.take_length(), .last = source.take_length(), .compressed = {}};
  if (count > static_cast<std::uint64_t>(source.most() / size_of(array.storage.length_type)))
    fail_damaged(array.name(), "its header announces {} blocks, more than there are", count);
  for (std::uint64_t i = 0; i < count; ++i)
    blocks.compressed.push_back(source.take_length());
  auto left = static_cast<std::uint64_t>(source.most());
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t compressed = blocks.compressed[i], size = blocks.size_of_block(i);
    if (compressed > left || !is_plausible(size, compressed))
      fail_damaged(array.name(),
                   "its header announces block {} of {} bytes for {} bytes, which cannot be", i,
                   compressed, size);
    left -= compressed;
  }
  return blocks;
}

/// Decompresses a block and appends the bytes. Memory grows with the bytes, not with the size in
/// the header. Returns false if there are not `size` bytes.
bool inflate_block(std::string_view compressed, std::uint64_t size, std::string& out) {
  constexpr std::uint64_t chunk = std::uint64_t{1} << 20;
  z_stream stream{};
  // inflate() does not change its input; the member is const only with ZLIB_CONST.
  stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(compressed.data()));
  stream.avail_in = static_cast<uInt>(compressed.size());
  if (compressed.size() > std::numeric_limits<uInt>::max() || inflateInit(&stream) != Z_OK)
    return false;
  const std::unique_ptr<z_stream, decltype(&inflateEnd)> end(&stream, &inflateEnd);
  const std::size_t before = out.size();
  int result = Z_OK;
  for (std::uint64_t done = 0; result == Z_OK && done <= size; done = out.size() - before) {
    const std::uint64_t room = std::clamp<std::uint64_t>(size - done, 1, chunk);
    out.resize(before + done + room);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + before + done);
    stream.avail_out = static_cast<uInt>(room);
    result = inflate(&stream, Z_NO_FLUSH);
    out.erase(out.size() - stream.avail_out);
  }
  return result == Z_STREAM_END && out.size() - before == size;
}

StoredBytes take_compressed(const ArrayInFile& array, Source& source, std::int64_t size) {
  const Blocks blocks = take_blocks(array, source);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < blocks.compressed.size(); ++i)
    sum += blocks.size_of_block(i);
  require_size(array, sum, size);
  std::string out;
  for (std::size_t i = 0; i < blocks.compressed.size(); ++i) {
    const StoredBytes block = source.take(blocks.compressed[i]);
    if (!inflate_block(block.view(), blocks.size_of_block(i), out))
      fail_damaged(array.name(), "block {} is not {} bytes compressed by zlib", i,
                   blocks.size_of_block(i));
  }
  return StoredBytes(std::move(out));
}

// ---- An array

Source open_source(const ArrayInFile& array, bool appended) {
  const VtkStorage& storage = array.storage;
  if (!appended)
    return {array, array.element.text, true};
  if (!storage.appended)
    fail_damaged(array.name(), "its data are appended, but the file has no AppendedData");
  const std::string text = array.element.attribute("offset");
  std::int64_t offset = -1;
  if (!parse_number(text, Scalar::int64, offset) || offset < 0 ||
      offset > static_cast<std::int64_t>(storage.appended->size()))
    fail_damaged(array.name(), "its offset is {}, which is not within the {} bytes of AppendedData",
                 in_quotes(text), storage.appended->size());
  return {array, storage.appended->substr(static_cast<std::size_t>(offset)),
          storage.appended_base64};
}

StoredBytes read_bytes(const ArrayInFile& array, bool appended, std::int64_t size) {
  Source source = open_source(array, appended);
  if (array.storage.compressed)
    return take_compressed(array, source, size);
  const std::uint64_t bytes = source.take_length();
  require_size(array, bytes, size);
  return source.take(bytes);
}

template <class T>
void read_text(const ArrayInFile& array, Scalar type, std::int64_t count, const Room<T>& room) {
  std::vector<T> numbers;
  std::string_view text = array.element.text;
  for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
    T number{};
    if (!parse_number(word, type, number))
      fail_file(array.name(), "{} at place {} is not a number of its type; correct it",
                in_quotes(word), numbers.size());
    numbers.push_back(number);
  }
  if (count >= 0 && std::ssize(numbers) != count)
    fail_damaged(array.name(), "it has {} numbers, but {} belong there", numbers.size(), count);
  std::copy(numbers.begin(), numbers.end(), room(std::ssize(numbers)));
}

} // namespace

std::optional<Scalar> vtk_type(const std::string& name) {
  constexpr std::array<std::pair<std::string_view, Scalar>, 10> types{
      {{"Int8", Scalar::int8},
       {"UInt8", Scalar::uint8},
       {"Int16", Scalar::int16},
       {"UInt16", Scalar::uint16},
       {"Int32", Scalar::int32},
       {"UInt32", Scalar::uint32},
       {"Int64", Scalar::int64},
       {"UInt64", Scalar::uint64},
       {"Float32", Scalar::float32},
       {"Float64", Scalar::float64}}};
  for (const auto& [text, type] : types)
    if (text == name)
      return type;
  return std::nullopt;
}

template <class T>
void read_vtk_numbers(const VtkStorage& storage, const XmlElement& element, std::int64_t count,
                      const Room<T>& room) {
  const ArrayInFile array{storage, element};
  const std::optional<Scalar> type = vtk_type(element.attribute("type"));
  if (!type)
    fail_file(array.name(), "its type {} is not one of numbers",
              in_quotes(element.attribute("type")));
  const std::string format = element.attribute("format", "ascii");
  if (format == "ascii")
    return read_text<T>(array, *type, count, room);
  if (format != "binary" && format != "appended")
    fail_file(array.name(), "its format {} is not ascii, binary or appended", in_quotes(format));
  const std::int64_t width = size_of(*type);
  const StoredBytes bytes = read_bytes(array, format == "appended", count < 0 ? -1 : width * count);
  const auto size = static_cast<std::int64_t>(bytes.view().size());
  if (size % width != 0)
    fail_damaged(array.name(), "it has {} bytes, which are not numbers of {}", size, width);
  copy_numbers(bytes.view().data(), size / width, *type, storage.swapped, room(size / width));
}

template void read_vtk_numbers(const VtkStorage&, const XmlElement&, std::int64_t,
                               const Room<double>&);
template void read_vtk_numbers(const VtkStorage&, const XmlElement&, std::int64_t,
                               const Room<std::int32_t>&);
template void read_vtk_numbers(const VtkStorage&, const XmlElement&, std::int64_t,
                               const Room<std::int64_t>&);

} // namespace calotte::io_detail
