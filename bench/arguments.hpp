// SPDX-License-Identifier: Apache-2.0
// What the programs of this folder share about their command lines.
#pragma once

#include <string>
#include <vector>

namespace fastrt::bench {

// "a,b" to {"a", "b"}.
std::vector<std::string> split(const std::string& text);

// Each throws UsageError where the text is not a number, or not one in the range.
int whole_number(const std::string& text);
double number(const std::string& text, double smallest);

// Calls run(count, arguments). What it throws becomes one line, and the exit code 2 if the command line is
// wrong, else 1.
int guarded_main(const char* program, int (*run)(int, char**), int count, char** arguments);

} // namespace fastrt::bench
