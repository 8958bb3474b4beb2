// SPDX-License-Identifier: Apache-2.0
#include "bench/allocations.hpp"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> held{0}, peak{0};

// Set while a column asks for memory or gives it back: it is counted as a whole, wherever it comes from.
thread_local bool in_column = false;

void count(std::size_t bytes) noexcept {
  const std::size_t now = held.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  std::size_t most = peak.load(std::memory_order_relaxed);
  while (now > most && !peak.compare_exchange_weak(most, now, std::memory_order_relaxed)) {
  }
}

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  if (!in_column) count(malloc_usable_size(memory));
  return memory;
}

void release(void* memory) noexcept {
  if (memory == nullptr) return;
  if (!in_column) held.fetch_sub(malloc_usable_size(memory), std::memory_order_relaxed);
  std::free(memory);
}

class ColumnGuard {
public:
  ColumnGuard() noexcept { in_column = true; }
  ColumnGuard(const ColumnGuard&) = delete;
  ColumnGuard& operator=(const ColumnGuard&) = delete;
  ~ColumnGuard() { in_column = false; }
};

} // namespace

// The other forms end in these.
void* operator new(std::size_t size) { return counted(std::malloc(size == 0 ? 1 : size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(align, (size + align - 1) / align * align));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }

// The linker (its option --wrap, in CMakeLists.txt) leads the library's calls of allocate_column and
// free_column here; "real" are the library's own.
extern "C" {
void* __real__ZN6fastrt15allocate_columnEm(std::size_t bytes);
void __real__ZN6fastrt11free_columnEPvm(void* memory, std::size_t bytes) noexcept;
void* __wrap__ZN6fastrt15allocate_columnEm(std::size_t bytes);
void __wrap__ZN6fastrt11free_columnEPvm(void* memory, std::size_t bytes) noexcept;
}

void* __wrap__ZN6fastrt15allocate_columnEm(std::size_t bytes) {
  const ColumnGuard guard;
  void* const memory = __real__ZN6fastrt15allocate_columnEm(bytes);
  count(bytes);
  return memory;
}

void __wrap__ZN6fastrt11free_columnEPvm(void* memory, std::size_t bytes) noexcept {
  const ColumnGuard guard;
  if (memory != nullptr) held.fetch_sub(bytes, std::memory_order_relaxed);
  __real__ZN6fastrt11free_columnEPvm(memory, bytes);
}

namespace fastrt::bench {

std::size_t bytes_allocated() noexcept { return held.load(std::memory_order_relaxed); }
std::size_t peak_allocated() noexcept { return peak.load(std::memory_order_relaxed); }
void reset_peak() noexcept { peak.store(held.load(std::memory_order_relaxed), std::memory_order_relaxed); }

} // namespace fastrt::bench
