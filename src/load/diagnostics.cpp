// SPDX-License-Identifier: Apache-2.0
#include <fastrt/diagnostics.hpp>

namespace fastrt {

void Diagnostics::warn(const std::string& kind, const std::string& message) {
  ++count_;
  if (++per_kind_[kind] <= kept_per_kind) kept_.push_back(message);
}

std::vector<std::string> Diagnostics::lines() const {
  std::vector<std::string> lines = kept_;
  for (const auto& [kind, count] : per_kind_)
    if (count > kept_per_kind) lines.push_back(std::to_string(count - kept_per_kind) + " more: " + kind);
  return lines;
}

} // namespace fastrt
