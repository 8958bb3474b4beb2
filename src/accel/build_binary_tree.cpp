// SPDX-License-Identifier: Apache-2.0
#include "src/accel/numbered_range.hpp"
#include "src/accel/parallel.hpp"
#include "src/accel/reinsertion.hpp"
#include "src/accel/subtree.hpp"

#include <fastrt/error.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

constexpr std::size_t min_chunk = std::size_t{1} << 12U;
constexpr std::size_t max_chunks = 64;
constexpr unsigned count_bits = 16; // of a leaf's primitives; its group goes above them for a while
static_assert(block_size * max_leaf_blocks < 1 << count_bits);

// Neighbouring primitives of a range that one task moves. The cuts depend on the primitives alone, not on
// threads; so does everything that follows.
struct Chunk {
  std::size_t begin, end;
  Bins bins;
};

// A node above the serial ranges, or the root of one of these.
struct TopNode {
  BuildRange range;
  std::vector<Chunk> chunks;
  std::unique_ptr<TopNode> children[2];
  GroupedNode node;
  std::size_t below_count = 0;  // nodes below a serial range's root
  std::size_t first_stored = 0; // where the builder keeps these
  std::uint32_t index = 0;      // of the node in the whole tree
  std::uint32_t first_below = 0;
};

// A thread's memory for one serial range after the other.
struct Workbench {
  Column<PrimitiveBox> boxes = Column<PrimitiveBox>(2 * serial_build_range);
  NodeList list;
};

class Builder {
public:
  Builder(Column<PrimitiveBox>& boxes, const BuildSettings& settings)
      : boxes_(boxes), numbers_(2 * boxes.size()), stored_(2 * boxes.size()), threads_(settings.threads) {
    context_.run_log2 = std::countr_zero(static_cast<unsigned>(settings.run_size));
    tree_.order.resize(boxes.size());
    all_ = {boxes.data(), {numbers_.data(), numbers_.data() + boxes.size()}};
    chunk_size_ = std::max(min_chunk, (boxes.size() + max_chunks - 1) / max_chunks);
  }

  BinaryTree build() {
    run_tasks(threads_, failure_, [&] {
      benches_.resize(static_cast<std::size_t>(omp_get_num_threads()));
      build_root();
    });
    boxes_ = {};
    numbers_ = {};
    benches_ = {};
    std::uint32_t next = 1;
    place(root_, 0, next);
    tree_.nodes.resize(next);
    tree_.group_of_leaf.resize(next);
    run_tasks(threads_, failure_, [&] { copy(root_); });
    return std::move(tree_);
  }

private:
  void build_root() {
    root_.range.end = boxes_.size();
    for_each_piece(boxes_.size(), chunk_size_, [&](std::size_t begin, std::size_t end) {
      std::iota(all_.buffers[0] + begin, all_.buffers[0] + end, static_cast<std::uint32_t>(begin));
    });
    measure_chunks(root_);
    check_groups();
    context_.scale = area_scale(root_.range.bounds);
    build(root_);
  }

  void check_groups() {
    std::vector<char> same(root_.chunks.size());
    for_each_index(same.size(), [&](std::size_t i) {
      same[i] = std::all_of(boxes_.begin() + root_.chunks[i].begin, boxes_.begin() + root_.chunks[i].end,
                            [&](const PrimitiveBox& box) { return box.group == boxes_[0].group; });
    });
    context_.one_group = std::find(same.begin(), same.end(), 0) == same.end();
  }

  // Cuts the range into chunks and finds its exact bounds and bins.
  void measure_chunks(TopNode& top) {
    const std::size_t begin = top.range.begin, count = (top.range.size() + chunk_size_ - 1) / chunk_size_;
    std::vector<BuildRange> parts(count, top.range);
    top.chunks.assign(count, {});
    for_each_index(count, [&](std::size_t i) {
      parts[i].begin = top.chunks[i].begin = begin + i * chunk_size_;
      parts[i].end = top.chunks[i].end = std::min(top.range.end, begin + (i + 1) * chunk_size_);
      measure(all_, parts[i]);
    });
    top.range.bounds = top.range.centroids = LaneBox{};
    top.range.tight = true;
    for (const BuildRange& part : parts) {
      top.range.bounds.extend(part.bounds);
      top.range.centroids.extend(part.centroids);
    }
    const BinMapping mapping(top.range.centroids);
    for_each_index(count, [&](std::size_t i) { fill_bins(all_, parts[i], mapping, top.chunks[i].bins); });
  }

  void build(TopNode& top) {
    Bins bins;
    for (const Chunk& chunk : top.chunks) bins.add(chunk.bins);
    if (top.range.size() <= serial_build_range) {
      top.chunks = {};
      return build_serially(top, bins);
    }
    for (auto& child : top.children) child = std::make_unique<TopNode>();
    const bool halve = must_halve(top.range.level, top.range.size());
    BinSplit split = halve ? BinSplit{} : best_split(bins, context_.scale, context_.run_log2);
    if (!halve && split.occupied < few_bins && !top.range.tight) {
      measure_chunks(top);
      bins = Bins{};
      for (const Chunk& chunk : top.chunks) bins.add(chunk.bins);
      split = best_split(bins, context_.scale, context_.run_log2);
    }
    if (split.axis >= 0) {
      move_chunks(top, bins, split);
    } else {
      for (std::uint32_t side = 0; side < 2; ++side) {
        top.children[side]->range = half_of(top.range, side);
        measure_chunks(*top.children[side]);
      }
    }
    top.chunks = {};
    top.node = make_node(top.range.bounds, 0, 0, 0);
    for (auto& child : top.children) spawn(failure_, [this, node = child.get()] { build(*node); });
  }

  // On a copy of the range's boxes, which stays in the cache.
  void build_serially(TopNode& top, const Bins& bins) {
    Workbench& bench = benches_[static_cast<std::size_t>(omp_get_thread_num())];
    gather(all_, top.range, bench.boxes.data());
    BuildContext context = context_;
    context.order = tree_.order.data() + top.range.begin;
    context.buffers[0] = bench.boxes.data();
    context.buffers[1] = bench.boxes.data() + serial_build_range;
    BuildRange range = top.range;
    range.begin = 0;
    range.end = top.range.size();
    range.buffer = 0;
    bench.list.clear();
    top.node = build_range(context, range, bins, bench.list);
    if (top.node.node.count != 0) top.node.node.first += static_cast<std::uint32_t>(top.range.begin);
    put_away(top, bench.list);
  }

  // Until it is known where they belong.
  void put_away(TopNode& top, const NodeList& list) {
    top.below_count = list.nodes.size();
    top.first_stored = next_stored_.fetch_add(top.below_count, std::memory_order_relaxed);
    for (std::size_t i = 0; i < top.below_count; ++i) {
      BinaryNode& node = stored_[top.first_stored + i] = list.nodes[i];
      node.count |= static_cast<std::uint32_t>(list.groups[i]) << count_bits;
    }
  }

  void move_chunks(TopNode& top, const Bins& bins, const BinSplit& split) {
    SplitSides sides = split_sides(top.range, bins, split);
    const std::size_t count = top.chunks.size();
    std::vector<SplitSides> sides_of(count, sides);
    std::vector<Chunk> moved[2];
    for (auto& chunks : moved) chunks.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t size = top.chunks[i].end - top.chunks[i].begin;
      const std::size_t left = left_count(top.chunks[i].bins, split);
      for (std::size_t side = 0; side < 2; ++side) {
        sides_of[i].next[side] = moved[side][i].begin = sides.next[side];
        sides.next[side] = moved[side][i].end = sides.next[side] + (side == 0 ? left : size - left);
      }
    }
    for_each_index(count, [&](std::size_t i) {
      Bins* const both[2] = {&moved[0][i].bins, &moved[1][i].bins};
      move_to_sides(all_, top.range, top.chunks[i].begin, top.chunks[i].end, split, sides_of[i], both);
    });
    for (std::size_t side = 0; side < 2; ++side) {
      top.children[side]->range = sides.ranges[side];
      top.children[side]->chunks = join(moved[side]);
    }
  }

  // Puts neighbours together until they are worth a task.
  std::vector<Chunk> join(const std::vector<Chunk>& chunks) const {
    std::vector<Chunk> joined;
    for (const Chunk& chunk : chunks) {
      if (!joined.empty() && chunk.end - joined.back().begin <= chunk_size_) {
        joined.back().end = chunk.end;
        joined.back().bins.add(chunk.bins);
      } else {
        joined.push_back(chunk);
      }
    }
    return joined;
  }

  void place(TopNode& top, std::uint32_t index, std::uint32_t& next) {
    top.index = index;
    top.first_below = next;
    if (top.node.node.count == 0) top.node.node.first = next;
    if (!top.children[0]) {
      next += static_cast<std::uint32_t>(top.below_count);
      return;
    }
    next += 2;
    place(*top.children[0], top.first_below, next);
    place(*top.children[1], top.first_below + 1, next);
  }

  void copy(const TopNode& top) {
    tree_.nodes[top.index] = top.node.node;
    tree_.group_of_leaf[top.index] = top.node.group;
    for (const auto& child : top.children)
      if (child) spawn(failure_, [this, node = child.get()] { copy(*node); });
    for (std::size_t i = 0; i < top.below_count; ++i) {
      BinaryNode node = stored_[top.first_stored + i];
      tree_.group_of_leaf[top.first_below + i] = static_cast<std::uint8_t>(node.count >> count_bits);
      node.count &= (1U << count_bits) - 1U;
      node.first += node.count == 0 ? top.first_below : static_cast<std::uint32_t>(top.range.begin);
      tree_.nodes[top.first_below + i] = node;
    }
  }

  Column<PrimitiveBox>& boxes_;
  Column<std::uint32_t> numbers_;
  Column<BinaryNode> stored_; // nodes below serial ranges; there are never as many as fit in
  std::atomic<std::size_t> next_stored_{0};
  std::vector<Workbench> benches_; // of each thread
  int threads_;
  std::size_t chunk_size_;
  NumberedBoxes all_;
  BuildContext context_;
  BinaryTree tree_;
  TopNode root_;
  TaskFailure failure_;
};

} // namespace

BinaryTree split_boxes(Column<PrimitiveBox>& boxes, const BuildSettings& settings) {
  if (boxes.empty()) return {};
  if (boxes.size() > std::size_t{max_blocks} * block_size)
    throw LimitError("too many primitives for one tree: " + std::to_string(boxes.size()));
  return Builder(boxes, settings).build();
}

BinaryTree build_binary_tree(Column<PrimitiveBox>& boxes, const BuildSettings& settings) {
  BinaryTree tree = split_boxes(boxes, settings);
  if (settings.quality == BvhQuality::high)
    reinsert_subtrees(tree, settings);
  else
    reinsert_largest_subtrees(tree, settings);
  return tree;
}

} // namespace fastrt
