// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/bytes/big_endian.h"

#include "base/elementary.h"

#include <bit>
#include <cstring>
#include <type_traits>

namespace calotte::io_detail {
namespace {

template <class Word>
CALOTTE_INLINE void reverse_words(const char* values, std::int64_t count, char* out) {
  constexpr std::int64_t size = sizeof(Word);
  for (std::int64_t i = 0; i < count; ++i) {
    Word word;
    std::memcpy(&word, values + size * i, size);
    if constexpr (size == 8)
      word = __builtin_bswap64(word);
    else if constexpr (size == 4)
      word = __builtin_bswap32(word);
    else
      word = __builtin_bswap16(word);
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

} // namespace

void swap_big_endian(const char* values, std::int64_t count, std::int64_t size, char* out) {
  if (size == 1 || std::endian::native == std::endian::big) {
    if (values != out)
      std::memcpy(out, values, static_cast<std::size_t>(count * size));
  } else if (size == 8) {
    reverse_each_8(values, count, out);
  } else if (size == 4) {
    reverse_each_4(values, count, out);
  } else {
    reverse_words<std::uint16_t>(values, count, out);
  }
}

} // namespace calotte::io_detail
