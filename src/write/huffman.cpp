// SPDX-License-Identifier: Apache-2.0
#include "src/write/huffman.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace fastrt {

namespace {

constexpr std::size_t longest = 15; // deflate's limit

struct Node {
  std::uint64_t count;
  std::uint32_t symbol; // leaves only
  std::uint32_t parent = 0;
};

// Leaves by rising count, then the inner nodes as they are made, which is by rising count as well: the two
// smallest are always at the front of one of the two queues.
void join(std::vector<Node>& nodes) {
  const std::size_t leaves = nodes.size();
  std::size_t leaf = 0, inner = leaves;
  const auto take_smallest = [&] {
    const bool from_leaves =
        leaf < leaves && (inner == nodes.size() || nodes[leaf].count <= nodes[inner].count);
    return from_leaves ? leaf++ : inner++;
  };
  for (std::size_t k = 1; k < leaves; ++k) {
    const std::size_t a = take_smallest(), b = take_smallest();
    nodes[a].parent = nodes[b].parent = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({nodes[a].count + nodes[b].count, 0});
  }
}

// How many leaves lie at each depth; those deeper than the limit count at the limit.
std::array<std::size_t, longest + 1> depths_of(const std::vector<Node>& nodes, std::size_t leaves,
                                               unsigned limit) {
  std::array<std::size_t, longest + 1> at_depth{};
  std::vector<unsigned> depth(nodes.size(), 0);
  for (std::size_t i = nodes.size() - 1; i-- > 0;) {
    depth[i] = depth[nodes[i].parent] + 1;
    if (i < leaves) ++at_depth[std::min(depth[i], limit)];
  }
  return at_depth;
}

// Moving leaves up to the limit made the code too full: each step takes one leaf from the limit and hangs it
// beside a shorter one.
void make_room(std::array<std::size_t, longest + 1>& at_depth, unsigned limit) {
  std::size_t used = 0;
  for (unsigned d = 1; d <= limit; ++d) used += at_depth[d] << (limit - d);
  for (; used > std::size_t{1} << limit; --used) {
    unsigned d = limit - 1;
    while (at_depth[d] == 0) --d;
    --at_depth[d];
    at_depth[d + 1] += 2;
    --at_depth[limit];
  }
}

} // namespace

void huffman_lengths(std::span<const std::uint32_t> counts, unsigned limit, std::span<std::uint8_t> lengths) {
  std::fill(lengths.begin(), lengths.end(), std::uint8_t{0});
  std::vector<Node> nodes;
  nodes.reserve(2 * counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (counts[i] != 0) nodes.push_back({counts[i], static_cast<std::uint32_t>(i)});
  if (nodes.empty()) return;
  if (nodes.size() == 1) {
    lengths[nodes[0].symbol] = 1;
    return;
  }
  std::sort(nodes.begin(), nodes.end(), [](const Node& a, const Node& b) {
    return a.count != b.count ? a.count < b.count : a.symbol < b.symbol;
  });
  const std::size_t leaves = nodes.size();
  join(nodes);
  std::array<std::size_t, longest + 1> at_depth = depths_of(nodes, leaves, limit);
  make_room(at_depth, limit);
  std::size_t leaf = 0; // the rarest gets the longest code
  for (unsigned d = limit; d > 0; --d)
    for (std::size_t k = 0; k < at_depth[d]; ++k)
      lengths[nodes[leaf++].symbol] = static_cast<std::uint8_t>(d);
}

void huffman_codes(std::span<const std::uint8_t> lengths, std::span<std::uint16_t> codes) {
  std::array<std::uint32_t, longest + 1> with_length{}, next{};
  for (const std::uint8_t length : lengths)
    if (length != 0) ++with_length[length];
  for (std::size_t d = 1; d <= longest; ++d) next[d] = (next[d - 1] + with_length[d - 1]) << 1U;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    std::uint32_t bits = lengths[i] == 0 ? 0 : next[lengths[i]]++;
    std::uint32_t reversed = 0;
    for (unsigned k = 0; k < lengths[i]; ++k, bits >>= 1U) reversed = reversed << 1U | (bits & 1U);
    codes[i] = static_cast<std::uint16_t>(reversed);
  }
}

} // namespace fastrt
