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

namespace calotte::base_detail {

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
    return data;
  }

  std::int64_t size_ = 0;
  Data data_;
};

} // namespace calotte::base_detail
