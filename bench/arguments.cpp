// SPDX-License-Identifier: Apache-2.0
#include "bench/arguments.hpp"

#include <fastrt/error.hpp>

#include <cstdio>
#include <sstream>

namespace fastrt::bench {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

int whole_number(const std::string& text) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0' || value < 1 || value > 65536)
    throw UsageError("'" + text + "' is not a number from 1 to 65536");
  return static_cast<int>(value);
}

double number(const std::string& text, double smallest) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(value >= smallest))
    throw UsageError("'" + text + "' is not a number of at least " + std::to_string(smallest));
  return value;
}

int guarded_main(const char* program, int (*run)(int, char**), int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const UsageError& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return 1;
  }
}

} // namespace fastrt::bench
