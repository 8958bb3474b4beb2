// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace fastrt {

// One column of a structure of arrays: a growable array of plain values whose memory starts at a cache line
// and may be read (not written) up to column_padding values past its end, so that SIMD code needs no tail
// loops. resize() leaves new values uninitialised: whoever fills a column in parallel touches its pages
// first.
inline constexpr std::size_t column_alignment = 64;
inline constexpr std::size_t column_padding = 16;

// Memory for a column, not initialised; throws std::bad_alloc. Much of it is asked for in huge pages, where
// the system has such. To be given back with the same number of bytes.
void* allocate_column(std::size_t bytes);
void free_column(void* memory, std::size_t bytes) noexcept;

template <class T>
class Column {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  using value_type = T;

  Column() = default;
  explicit Column(std::size_t size) { resize(size); }
  Column(std::size_t size, T value) { resize(size, value); }
  Column(std::initializer_list<T> values) {
    reserve(values.size());
    for (const T& value : values) push_back(value);
  }
  Column(const Column& other) { assign(other.data_, other.size_); }
  Column(Column&& other) noexcept { swap(other); }
  Column& operator=(Column other) noexcept {
    swap(other);
    return *this;
  }
  ~Column() { release(); }

  void swap(Column& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  // Bytes held, padding included.
  std::size_t bytes() const noexcept {
    return data_ == nullptr ? 0 : (capacity_ + column_padding) * sizeof(T);
  }
  T* data() noexcept { return data_; }
  const T* data() const noexcept { return data_; }
  T* begin() noexcept { return data_; }
  T* end() noexcept { return data_ + size_; }
  const T* begin() const noexcept { return data_; }
  const T* end() const noexcept { return data_ + size_; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  T& back() noexcept { return data_[size_ - 1]; }
  const T& back() const noexcept { return data_[size_ - 1]; }

  void clear() noexcept { size_ = 0; }
  void reserve(std::size_t capacity) {
    if (capacity > capacity_) reallocate(capacity);
  }
  void resize(std::size_t size) {
    if (size > capacity_) reallocate(size);
    size_ = size;
  }
  void resize(std::size_t size, T value) {
    const std::size_t old_size = size_;
    resize(size);
    for (std::size_t i = old_size; i < size; ++i) data_[i] = value;
  }
  // As resize, for columns that grow step by step.
  void extend(std::size_t size, T value) {
    make_room(size);
    resize(size, value);
  }
  void push_back(T value) {
    if (size_ == capacity_) reallocate(capacity_ < 8 ? 16 : capacity_ + capacity_ / 2);
    data_[size_++] = value;
  }
  void assign(const T* values, std::size_t count) {
    resize(count);
    if (count != 0) std::memcpy(data_, values, count * sizeof(T));
  }
  void append(const T* values, std::size_t count) {
    const std::size_t old_size = size_;
    make_room(old_size + count);
    size_ = old_size + count;
    if (count != 0) std::memcpy(data_ + old_size, values, count * sizeof(T));
  }

  bool operator==(const Column& other) const {
    if (size_ != other.size_) return false;
    for (std::size_t i = 0; i < size_; ++i)
      if (!(data_[i] == other.data_[i])) return false;
    return true;
  }

private:
  // Grows by half at least, for many small steps must not copy everything each time.
  void make_room(std::size_t size) {
    const std::size_t grown = capacity_ + capacity_ / 2;
    if (size > capacity_) reallocate(size > grown ? size : grown);
  }

  void release() noexcept { free_column(data_, bytes()); }

  void reallocate(std::size_t capacity) {
    T* data = static_cast<T*>(allocate_column((capacity + column_padding) * sizeof(T)));
    if (size_ != 0)
      std::memcpy(static_cast<void*>(data), data_, (size_ < capacity ? size_ : capacity) * sizeof(T));
    std::memset(static_cast<void*>(data + capacity), 0, column_padding * sizeof(T));
    release();
    data_ = data;
    capacity_ = capacity;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

} // namespace fastrt
