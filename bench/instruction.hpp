// SPDX-License-Identifier: Apache-2.0
// As much of an x86-64 instruction as counting work needs: its single-precision operations and where its
// operand lies in memory.
#pragma once

#include <cstdint>

namespace fastrt::bench {

struct Instruction {
  int operations = 0;        // on floats, all lanes; FMA counts as two, comparing and choosing as one
  bool reads_memory = false; // or writes; at base + (index << shift) + displacement
  int base = -1, index = -1, shift = 0; // registers as the processor numbers them; -1: none
  std::int64_t displacement = 0;
};

// Addresses relative to the next instruction, gathers and prefetches are taken for no memory at all: gathers
// have no single operand, and has_operand drops them. `code` must have 16 readable bytes.
Instruction decode(const std::uint8_t* code) noexcept;

} // namespace fastrt::bench
