// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

namespace fastrt {

// The instruction sets that kernels are compiled for. `scalar` is the naive twin's arithmetic over a binary
// tree, one ray at a time: slow, there to check and to compare with.
enum class Isa { scalar, sse42, avx2, avx512 };

// "scalar", "sse4.2", "avx2", "avx512".
const char* isa_name(Isa isa) noexcept;

// Floats per register: 1, 4, 8, 16.
int isa_width(Isa isa) noexcept;

// Whether this CPU and operating system run it.
bool isa_available(Isa isa) noexcept;

// Every ISA that runs here, the widest first.
std::vector<Isa> available_isas();

// The ISA that `name` asks for; "auto" and "" give the widest one. Throws UsageError for an unknown name and
// for an ISA that this CPU lacks; the message lists what is available.
Isa select_isa(std::string_view name);

} // namespace fastrt
