// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace fastrt {

// Collects warnings for whoever wants to show them. The first ten of a kind are kept word for word, the rest
// counted.
class Diagnostics {
public:
  static constexpr std::size_t kept_per_kind = 10;

  // kind: a short fixed text ("degenerate face"); message: the whole line without "warning:".
  void warn(const std::string& kind, const std::string& message);
  // The lines kept, in order, and one more line for each kind that had more.
  std::vector<std::string> lines() const;
  std::size_t count() const noexcept { return count_; }

private:
  std::map<std::string, std::size_t> per_kind_;
  std::vector<std::string> kept_;
  std::size_t count_ = 0;
};

} // namespace fastrt
