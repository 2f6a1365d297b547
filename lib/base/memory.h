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

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define CALOTTE_POOLED false // the sanitizers track malloc
#else
#define CALOTTE_POOLED true
#endif

namespace calotte::base_detail {

/// Allocates memory that oneTBB keeps for later blocks after one task has freed it. The C library
/// would return blocks of some hundred kilobytes to the system, and faulting them in again would
/// cost a tenth of a triangulation.
/// \returns null if there is no memory.
void* pool_allocate(std::size_t bytes);
void pool_free(void* block);

/// The same for containers.
template <class T> struct PoolAllocator {
  using value_type = T;
  PoolAllocator() = default;
  template <class U> PoolAllocator(const PoolAllocator<U>&) {}
  T* allocate(std::size_t n) {
    void* const block = pool_allocate(n * sizeof(T));
    if (block == nullptr)
      throw std::bad_alloc();
    return static_cast<T*>(block);
  }
  void deallocate(T* block, std::size_t) { pool_free(block); }
  template <class U> bool operator==(const PoolAllocator<U>&) const { return true; }
};

/// Returns to the system the free memory that oneTBB and the C library keep for later blocks.
void empty_pools();

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
/// page also faults it in.
///
/// Arrays of up to a few megabytes come from the pools. Larger arrays come from the system and
/// return to it. The eight bytes behind the last value may be read: code for four doubles at a time
/// reads triples of doubles with the double that follows.
template <class T> class Array {
public:
  Array() = default;
  explicit Array(std::int64_t n)
      : size_(n), data_(allocate(static_cast<std::size_t>(n) * sizeof(T) + 8)) {}
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
    bool pooled = true;
    void operator()(T* data) const {
      if (pooled)
        pool_free(data);
      else
        std::free(data);
    }
  };
  using Data = std::unique_ptr<T[], Free>;

  static Data allocate(std::size_t bytes) {
    static_assert(std::is_trivially_copyable_v<T>);
    constexpr std::size_t most_pooled = 16 << 20;
    const bool pooled = CALOTTE_POOLED && bytes <= most_pooled;
    void* data = pooled ? pool_allocate(bytes) : std::malloc(bytes);
    if (data == nullptr && bytes > 0)
      throw std::bad_alloc();
    prefer_huge_pages(data, bytes);
    return Data(static_cast<T*>(data), Free{pooled});
  }

  std::int64_t size_ = 0;
  Data data_;
};

/// The pools keep the memory of a triangulation of up to this number of sites for the next one. A
/// larger triangulation, whose reports alone take half a gigabyte, returns its memory to the
/// system.
inline constexpr std::int64_t most_sites_kept = 1 << 23;
inline void empty_pools_of_many(std::int64_t sites) {
  if (sites > most_sites_kept)
    empty_pools();
}

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
