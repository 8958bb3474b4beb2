// SPDX-License-Identifier: Apache-2.0
#include <fastrt/column.hpp>

#include <sys/mman.h>

#include <new>

namespace fastrt {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21U;

// A page at a time, large columns cost thousands of page faults, and walking them misses the TLB. What is
// smaller than a huge page can't have one.
std::align_val_t alignment_of(std::size_t bytes) {
  return std::align_val_t{bytes >= huge_page ? huge_page : column_alignment};
}

} // namespace

void* allocate_column(std::size_t bytes) {
  const std::align_val_t alignment = alignment_of(bytes);
  void* const memory = ::operator new(bytes, alignment);
#ifdef MADV_HUGEPAGE
  // Advice alone: without it all works as well. The last, partial page stays one of small pages.
  if (bytes >= huge_page) ::madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
  return memory;
}

void free_column(void* memory, std::size_t bytes) noexcept { ::operator delete(memory, alignment_of(bytes)); }

} // namespace fastrt
