// SPDX-License-Identifier: Apache-2.0
// A file cut into chunks that threads read on their own.
#pragma once

#include "src/load/source.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fastrt {

// A run of whole lines of a file.
struct Chunk {
  std::uint64_t begin = 0, end = 0;
  bool torn = false; // no line ended where it should have: its last line exceeds max_line_bytes
};

// Cuts at the line ends next to multiples of chunk_bytes, so that the chunks depend on the file alone. Starts
// behind a byte order mark. Throws InputError for UTF-16.
std::vector<Chunk> cut_into_chunks(const Source& source, std::size_t chunk_bytes, int threads);

// Memory for one chunk at a time, with line feeds before and behind the text for those that look beyond it.
class ChunkBuffer {
public:
  static constexpr std::size_t padding = 128; // before and behind
  void read(const Source& source, const Chunk& chunk);
  char* begin() { return bytes_.data() + padding; }
  char* end() { return begin() + size_; }

private:
  std::vector<char> bytes_;
  std::size_t size_ = 0;
};

} // namespace fastrt
