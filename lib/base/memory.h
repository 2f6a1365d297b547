// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace calotte::base_detail {

#ifdef __linux__
/// Passes `advice` to madvise() for the whole pages, of `page` bytes each, of a block. Errors are
/// ignored.
inline void advise(void* begin, std::size_t bytes, std::size_t page, int advice) {
  const auto address = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (address + page - 1) / page * page,
                       last = (address + bytes) / page * page;
  if (first < last)
    madvise(reinterpret_cast<void*>(first), last - first, advice);
}
#endif

/// Requests huge pages for fresh memory of a large array if the system lets programs choose. Random
/// access then causes fewer TLB misses and 512 times fewer page faults. Smaller arrays stay on
/// small pages: the host of a virtual machine takes back free memory in huge pages, and a new
/// process then waits 2 to 4 ms for each, where small pages are often left. (Two processors of AMD
/// EPYC, 163 842 sites: 39 to 90 ms on huge pages, 36 to 57 ms on small ones.)
inline void prefer_huge_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  constexpr std::size_t large = std::size_t{64} << 20;
  if (bytes >= large)
    advise(begin, bytes, std::size_t{1} << 21, MADV_HUGEPAGE);
#endif
}

/// n values of a type without constructors, not initialised, so that the thread that first writes a
/// page also faults it in. The eight bytes behind the last value may be read: code for four doubles
/// at a time reads triples of doubles with the double that follows.
template <class T> class Array {
public:
  Array() = default;
  explicit Array(std::int64_t n) : size_(n), data_(allocate(n)) {}
  Array(Array&& other) noexcept
      : size_(std::exchange(other.size_, 0)), data_(std::move(other.data_)) {}
  Array& operator=(Array&& other) noexcept {
    size_ = std::exchange(other.size_, 0);
    data_ = std::move(other.data_);
    return *this;
  }
  T& operator[](std::int64_t i) { return data_[static_cast<std::size_t>(i)]; }
  const T& operator[](std::int64_t i) const { return data_[static_cast<std::size_t>(i)]; }
  std::int64_t size() const { return size_; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T* begin() { return data_.get(); }
  T* end() { return data_.get() + size_; }
  const T* begin() const { return data_.get(); }
  const T* end() const { return data_.get() + size_; }

private:
  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  using Data = std::unique_ptr<T[], Free>;

  static Data allocate(std::int64_t n) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::size_t bytes = static_cast<std::size_t>(n) * sizeof(T) + 8;
    Data data(static_cast<T*>(std::malloc(bytes)));
    if (!data)
      throw std::bad_alloc();
    prefer_huge_pages(data.get(), bytes);
    return data;
  }

  std::int64_t size_ = 0;
  Data data_;
};

/// Memory for n values; that of a large array prefers huge pages.
template <class T> void reserve_huge(std::vector<T>& values, std::int64_t n) {
  values.reserve(static_cast<std::size_t>(n));
  prefer_huge_pages(values.data(), static_cast<std::size_t>(n) * sizeof(T));
}

/// A vector of n zeros.
template <class T> std::vector<T> zeros(std::int64_t n) {
  std::vector<T> values;
  reserve_huge(values, n);
  values.resize(static_cast<std::size_t>(n));
  return values;
}

} // namespace calotte::base_detail
