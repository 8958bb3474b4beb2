// SPDX-License-Identifier: Apache-2.0
#include <fastrt/isa.hpp>

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>

#include "bench/instruction.hpp"
#include "bench/stepping.hpp"

namespace fastrt::bench {
namespace {

Instruction decoded(std::initializer_list<int> bytes) {
  std::array<std::uint8_t, 32> code{};
  std::size_t i = 0;
  for (const int byte : bytes) code[i++] = static_cast<std::uint8_t>(byte);
  return decode(code.data());
}

TEST(Instruction, operations_are_lanes) {
  EXPECT_EQ(decoded({0x0F, 0x58, 0xC1}).operations, 4);                    // addps xmm0, xmm1
  EXPECT_EQ(decoded({0xF3, 0x0F, 0x59, 0xC1}).operations, 1);              // mulss xmm0, xmm1
  EXPECT_EQ(decoded({0xC5, 0xF4, 0x5C, 0xC2}).operations, 8);              // vsubps ymm0, ymm1, ymm2
  EXPECT_EQ(decoded({0x62, 0xF1, 0x74, 0x48, 0x58, 0xC2}).operations, 16); // vaddps zmm0, zmm1, zmm2
  EXPECT_EQ(decoded({0xC4, 0xE2, 0x75, 0xA8, 0xC2}).operations, 16);       // vfmadd213ps ymm0, ymm1, ymm2
  EXPECT_EQ(decoded({0xC4, 0xE2, 0x71, 0xA9, 0xC2}).operations, 2);        // vfmadd213ss xmm0, xmm1, xmm2
  EXPECT_EQ(decoded({0x66, 0x0F, 0x58, 0xC1}).operations, 0);              // addpd: not floats
  EXPECT_EQ(decoded({0x48, 0x01, 0xC8}).operations, 0);                    // add rax, rcx
}

TEST(Instruction, operands_in_memory) {
  const Instruction plain = decoded({0x41, 0x0F, 0x28, 0x44, 0xC8, 0x10}); // movaps xmm0, [r8 + rcx*8 + 16]
  EXPECT_TRUE(plain.reads_memory);
  EXPECT_EQ(plain.base, 8);
  EXPECT_EQ(plain.index, 1);
  EXPECT_EQ(plain.shift, 3);
  EXPECT_EQ(plain.displacement, 16);
  const Instruction scaled = decoded({0x62, 0xF1, 0x7C, 0x48, 0x28, 0x40, 0xFF}); // vmovaps zmm0, [rax - 64]
  EXPECT_EQ(scaled.base, 0);
  EXPECT_EQ(scaled.displacement, -64);
  const Instruction spread =
      decoded({0x62, 0xF2, 0x7D, 0x48, 0x18, 0x42, 0x03}); // vbroadcastss zmm0, [rdx + 12]
  EXPECT_EQ(spread.base, 2);
  EXPECT_EQ(spread.displacement, 12);
  const Instruction far_away = decoded({0x8B, 0x83, 0x00, 0x01, 0x00, 0x00}); // mov eax, [rbx + 256]
  EXPECT_EQ(far_away.displacement, 256);
  EXPECT_FALSE(decoded({0x48, 0x8D, 0x43, 0x08}).reads_memory); // lea rax, [rbx + 8]
  EXPECT_FALSE(decoded({0x0F, 0x18, 0x08}).reads_memory);       // prefetcht0 [rax]
  EXPECT_FALSE(decoded({0x74, 0x05}).reads_memory);             // je
}

TEST(Instruction, short_displacements_count_in_what_is_moved) {
  const auto displacement = [](std::initializer_list<int> bytes) { return decoded(bytes).displacement; };
  // F3 and F2 say how wide the integers are, not that one alone is moved.
  EXPECT_EQ(displacement({0x62, 0xF1, 0x7F, 0x48, 0x6F, 0x40, 0x01}), 64);  // vmovdqu8 zmm0, [rax + 64]
  EXPECT_EQ(displacement({0x62, 0xF1, 0xFF, 0x28, 0x7F, 0x49, 0x01}), 32);  // vmovdqu16 [rcx + 32], ymm1
  EXPECT_EQ(displacement({0x62, 0xF1, 0x7E, 0x48, 0x6F, 0x40, 0xFF}), -64); // vmovdqu32 zmm0, [rax - 64]
  EXPECT_EQ(displacement({0x62, 0xE1, 0xFE, 0x08, 0x6F, 0x42, 0x01}), 16);  // vmovdqu64 xmm16, [rdx + 16]
  EXPECT_EQ(displacement({0x62, 0xE1, 0x7E, 0x08, 0x10, 0x48, 0x01}), 4);   // vmovss xmm17, [rax + 4]
}

struct alignas(line_bytes) Lines {
  float values[64];
};

TEST(Stepper, counts_what_runs) {
  Lines watched{}, other{};
  Stepper stepper({std::as_bytes(std::span(&watched, 1))});
  EXPECT_EQ(stepper.run([] {}).instructions, 0U);
  const auto nops = [] { asm volatile(".rept 1000\nnop\n.endr"); }; // in a macro, one fewer if not optimised
  EXPECT_EQ(stepper.run(nops).instructions, 1000U);
  EXPECT_EQ(stepper.run([] {
                     asm volatile(".rept 10\naddps %%xmm1, %%xmm0\n.endr" ::: "xmm0");
                   })
                .operations,
            40U);
  // Three loads of two lines; memory that is not watched does not count.
  const auto load = [&] {
    asm volatile(
        "movss (%0), %%xmm0\nmovss 60(%0), %%xmm0\nmovss 128(%0), %%xmm0\nmovss (%1), %%xmm0" ::"r"(&watched),
        "r"(&other)
        : "xmm0");
  };
  EXPECT_EQ(stepper.run(load).lines, 2U);
  EXPECT_EQ(stepper.run(load).lines, 2U); // each run counts anew
}

} // namespace
} // namespace fastrt::bench
