// SPDX-License-Identifier: Apache-2.0
#include <fastrt/column.hpp>

#include <sys/mman.h>

#include <cstdint>
#include <limits>
#include <new>

namespace fastrt {
namespace {

constexpr std::size_t page = 4096;
constexpr std::size_t huge_page = std::size_t{1} << 21U;

constexpr std::size_t round_up(std::size_t size, std::size_t unit) { return (size + unit - 1) / unit * unit; }

// A page at a time, large columns cost thousands of page faults, and walking them misses the TLB. They come
// from the system itself and go back to it: the heap would keep some of what a tree's builder lets go, and
// take other memory for the scene.
void* map_huge_pages(std::size_t bytes) {
  if (bytes > std::numeric_limits<std::size_t>::max() / 2) throw std::bad_alloc();
  const std::size_t size = round_up(bytes, page);
  void* const map =
      ::mmap(nullptr, size + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (map == MAP_FAILED) throw std::bad_alloc();
  const auto begin = reinterpret_cast<std::uintptr_t>(map);
  const std::size_t before = round_up(begin, huge_page) - begin;
  char* const memory = static_cast<char*>(map) + before;
  if (before != 0) ::munmap(map, before);
  if (before != huge_page) ::munmap(memory + size, huge_page - before);
#ifdef MADV_HUGEPAGE
  // Advice alone: without it all works as well. The last, partial page stays one of small pages.
  ::madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
  return memory;
}

} // namespace

void* allocate_column(std::size_t bytes) {
  return bytes < huge_page ? ::operator new (bytes, std::align_val_t{column_alignment})
                           : map_huge_pages(bytes);
}

void free_column(void* memory, std::size_t bytes) noexcept {
  if (bytes < huge_page)
    ::operator delete (memory, std::align_val_t{column_alignment});
  else
    ::munmap(memory, round_up(bytes, page));
}

} // namespace fastrt
