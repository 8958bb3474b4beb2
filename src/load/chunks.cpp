// SPDX-License-Identifier: Apache-2.0
#include "src/load/chunks.hpp"

#include "src/load/parallel_for.hpp"
#include "src/load/text.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace fastrt {

namespace {

// Whether a line starts at text[i] for certain: one after a line that ends in `\` may be its continuation, or
// not if that is a comment.
bool starts_line(std::string_view text, std::size_t i) {
  const char last = text[i - 1];
  if (!is_line_end(last)) return false;
  if (last == '\r' && i < text.size() && text[i] == '\n') return false;
  const std::size_t end = last == '\n' && text[i - 2] == '\r' ? i - 2 : i - 1;
  return text[end - 1] != '\\';
}

struct Cut {
  std::uint64_t offset;
  bool torn;
};

// The first certain line start at `offset` or after.
Cut find_cut(const Source& source, std::uint64_t offset) {
  constexpr std::uint64_t behind = 3; // `\`, carriage return, line feed
  std::vector<char> bytes;
  for (std::uint64_t window = 4096;; window *= 16) {
    const std::uint64_t begin = offset - behind;
    const std::uint64_t end =
        std::min(source.size(), offset + std::min<std::uint64_t>(window, max_line_bytes + 1));
    bytes.resize(end - begin);
    source.read(begin, bytes.data(), bytes.size());
    const std::string_view text(bytes.data(), bytes.size());
    for (std::size_t i = behind; i < text.size(); ++i)
      if (starts_line(text, i)) return {begin + i, false};
    if (end == source.size()) return {end, false};
    if (window > max_line_bytes) return {end, true};
  }
}

// The length of the byte order mark, if there is one.
std::uint64_t check_start(const Source& source) {
  std::array<char, 3> start{};
  source.read(0, start.data(), std::min<std::uint64_t>(start.size(), source.size()));
  const std::string_view text(start.data(), start.size());
  const bool wide = source.size() >= 2 && (text[0] == '\0') != (text[1] == '\0');
  if (wide || text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError(source.name(), 1, 1, "looks like UTF-16; save it as UTF-8");
  return text_begin(text);
}

} // namespace

std::vector<Chunk> cut_into_chunks(const Source& source, std::size_t chunk_bytes, int threads) {
  const std::uint64_t start = check_start(source);
  const auto count = static_cast<std::size_t>((source.size() + chunk_bytes - 1) / chunk_bytes);
  std::vector<Chunk> chunks(count);
  if (count == 0) return chunks;
  chunks.front().begin = start;
  chunks.back().end = source.size();
  parallel_for(count - 1, threads, [&](std::size_t i, std::size_t) {
    const Cut cut = find_cut(source, (i + 1) * chunk_bytes);
    chunks[i].end = cut.offset;
    chunks[i].torn = cut.torn;
    chunks[i + 1].begin = cut.offset;
  });
  return chunks;
}

void ChunkBuffer::read(const Source& source, const Chunk& chunk) {
  size_ = static_cast<std::size_t>(chunk.end - chunk.begin);
  if (bytes_.size() < size_ + 2 * padding) bytes_.resize(size_ + 2 * padding);
  std::memset(bytes_.data(), '\n', padding);
  source.read(chunk.begin, begin(), size_);
  std::memset(end(), '\n', padding);
}

} // namespace fastrt
