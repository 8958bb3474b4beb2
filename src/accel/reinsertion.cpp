// SPDX-License-Identifier: Apache-2.0
#include "src/accel/reinsertion.hpp"

#include "src/accel/parallel.hpp"
#include "src/accel/reinsertion_search.hpp"
#include "src/accel/tree_top.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fastrt {
namespace {

// Of high quality: one node in so many is looked at in a round.
constexpr std::size_t high_share = 4;
constexpr int high_rounds = 4;

// Of standard quality: one node in so many, but not too few; as long as a round promises to take so much of
// the sum of their areas away. Scanned meshes promise 0.1 to 0.7 %, rooms 15 to 80 %.
constexpr std::size_t standard_share = 64, standard_nodes = 64;
constexpr int standard_rounds = 3;
constexpr double much = 0.03;

constexpr std::size_t searches_per_task = 64;
constexpr std::size_t parallel_from = 1024; // fewer searches take less time than it takes to wake a thread

class Reinserter {
public:
  // A round looks at one node in `share`, the largest.
  Reinserter(const BinaryTree& tree, std::size_t share, int threads)
      : tree_(tree), share_(share), threads_(threads), scale_(area_scale(tree_.box(LinkedTree::root))) {}

  // Looks for better places.
  void find() {
    choose_nodes();
    areas_ = sum_of_gains();
    find_places();
  }

  // Whether moving there would gain much, were each move the only one. Less than the root's area gains
  // nothing: the wide tree's root takes in a few of the largest nodes anyway.
  bool promises_much() const {
    const double gain = sum_of_gains();
    return gain >= static_cast<double>(half_area(tree_.box(LinkedTree::root), scale_)) &&
           gain >= much * areas_;
  }

  // Makes the moves that were found; returns whether any. The best go first: moves before it may have made a
  // move impossible, or one that does not pay any more.
  bool apply() {
    const auto stays = [](const Reinsertion& r) { return r.target == LinkedTree::none; };
    found_.erase(std::remove_if(found_.begin(), found_.end(), stays), found_.end());
    std::sort(found_.begin(), found_.end(), before);
    bool moved = false;
    for (const Reinsertion& r : found_) {
      if (!tree_.can_move(r.node, r.target)) continue;
      const std::uint32_t sibling = tree_.sibling(r.node);
      if (tree_.move(r.node, r.target) < 0) {
        moved = true;
      } else {
        tree_.move(r.node, sibling);
      }
    }
    return moved;
  }

  LinkedTree& tree() { return tree_; }

private:
  // The largest nodes, their areas for gains: moving these brings most, and takes most of the time that
  // moving all would.
  void choose_nodes() {
    found_.clear();
    for (std::uint32_t i = 0; i < tree_.size(); ++i) {
      const float area = half_area(tree_.box(i), scale_);
      // An area that is not a number has no place in an order.
      if (tree_.can_leave(i) && area >= 0) found_.push_back({i, LinkedTree::none, area});
    }
    const std::size_t count = (found_.size() + share_ - 1) / share_;
    std::nth_element(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count), found_.end(),
                     before);
    found_.resize(count);
  }

  void find_places() {
    TaskFailure failure;
    run_tasks(found_.size() < parallel_from ? 1 : threads_, failure, [&] {
      for_each_index((found_.size() + searches_per_task - 1) / searches_per_task, [&](std::size_t task) {
        const std::size_t end = std::min(found_.size(), (task + 1) * searches_per_task);
        for (std::size_t i = task * searches_per_task; i < end; ++i)
          found_[i] = Search(tree_, scale_, found_[i].node).run();
      });
    });
  }

  double sum_of_gains() const {
    double sum = 0;
    for (const Reinsertion& r : found_) sum += static_cast<double>(r.gain);
    return sum;
  }

  static bool before(const Reinsertion& a, const Reinsertion& b) {
    return a.gain > b.gain || (a.gain == b.gain && a.node < b.node);
  }

  LinkedTree tree_;
  std::size_t share_;
  int threads_;
  __m128 scale_;
  std::vector<Reinsertion> found_;
  double areas_ = 0; // of the nodes looked at
};

} // namespace

void reinsert_subtrees(BinaryTree& tree, const BuildSettings& settings) {
  if (tree.nodes.empty()) return;
  Reinserter reinserter(tree, high_share, settings.threads);
  int round = 0;
  for (; round < high_rounds; ++round) {
    reinserter.find();
    if (!reinserter.apply()) break;
  }
  if (round > 0) tree = reinserter.tree().in_order(tree);
}

void reinsert_largest_subtrees(BinaryTree& tree, const BuildSettings& settings) {
  if (tree.nodes.empty()) return;
  const TreeTop top(tree, std::max(standard_nodes, tree.nodes.size() / standard_share));
  Reinserter reinserter(top.tree(), 1, settings.threads);
  int round = 0;
  for (; round < standard_rounds; ++round) {
    reinserter.find();
    if (!reinserter.promises_much()) break;
    if (round == 0) reinserter.tree().limit_depth(top.max_depth());
    if (!reinserter.apply()) break;
  }
  if (round > 0) tree = top.below(reinserter.tree().in_order(top.tree()));
}

} // namespace fastrt
