// SPDX-License-Identifier: Apache-2.0
#include "src/load/spelling.hpp"

#include "src/load/text.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace fastrt {
namespace {

constexpr std::size_t longest = 64;

// How many letters must be put in, taken out, changed or swapped with their neighbour (Damerau's distance,
// each place touched once).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_before(b.size() + 1), before(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(two_before, before);
    std::swap(before, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({before[j] + 1, row[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], two_before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

} // namespace

std::string_view nearest_name(std::string_view word, std::span<const std::string_view> names) {
  if (word.size() > longest) return {};
  const std::string wanted = lower_case(word);
  std::string_view best;
  std::size_t least = std::max<std::size_t>(word.size() / 3, 1) + 1;
  for (const std::string_view name : names) {
    if (name.size() > longest) continue;
    const std::size_t d = distance(wanted, lower_case(name));
    if (d < least) least = d, best = name;
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
  const std::string_view best = nearest_name(word, names);
  return best.empty() ? std::string() : "; did you mean " + in_quotes(best) + '?';
}

} // namespace fastrt
