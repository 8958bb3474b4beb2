// SPDX-License-Identifier: Apache-2.0
#include "src/cli/save.hpp"

#include "src/cli/signals.hpp"
#include "src/write/output_file.hpp"

namespace fastrt::cli {

std::string format_of(const std::filesystem::path& output) {
  std::string extension = output.extension().string();
  if (extension.empty()) return "png";
  extension.erase(0, 1);
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

void save(const std::filesystem::path& output, const std::vector<unsigned char>& bytes) {
  enter_phase(Phase::saving);
  replace_file(output, bytes.data(), bytes.size());
  if (signal_received() == 0) enter_phase(Phase::idle);
}

} // namespace fastrt::cli
