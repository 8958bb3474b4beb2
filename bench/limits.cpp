// SPDX-License-Identifier: Apache-2.0
#include "bench/limits.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "bench/measure.hpp"

// Twelve accumulators hide the latency of two units that start one operation a cycle each. All registers are
// zero.
#define FASTRT_EACH_ACCUMULATOR(line) ".irp r,0,1,2,3,4,5,6,7,8,9,10,11\n" line "\n.endr\n"
#define FASTRT_VECTOR_REGISTERS                                                                              \
  "xmm0", "xmm1", "xmm2", "xmm3", "xmm4", "xmm5", "xmm6", "xmm7", "xmm8", "xmm9", "xmm10", "xmm11", "xmm12", \
      "xmm13"

namespace fastrt::bench {
namespace {

constexpr int accumulators = 12;
constexpr int tries = 5;

// The largest of a few values of amount / seconds(work).
template <class Work>
double best_rate(double amount, const Work& work) {
  double best = 0;
  for (int i = 0; i < tries; ++i) {
    const double start = thread_seconds();
    work();
    best = std::max(best, amount / (thread_seconds() - start));
  }
  return best;
}

void multiply_add(Isa isa, int rounds) {
  if (isa == Isa::avx512) {
    asm volatile(
        FASTRT_EACH_ACCUMULATOR("vpxord %%zmm\\r, %%zmm\\r, %%zmm\\r") "vpxord %%zmm12, %%zmm12, %%zmm12\n" ::
            : FASTRT_VECTOR_REGISTERS);
    for (int i = 0; i < rounds; ++i)
      asm volatile(FASTRT_EACH_ACCUMULATOR("vfmadd213ps %%zmm12, %%zmm12, %%zmm\\r")::
                       : FASTRT_VECTOR_REGISTERS);
    asm volatile("vzeroupper");
  } else if (isa == Isa::avx2) {
    asm volatile("vzeroall" ::: FASTRT_VECTOR_REGISTERS);
    for (int i = 0; i < rounds; ++i)
      asm volatile(FASTRT_EACH_ACCUMULATOR("vfmadd213ps %%ymm12, %%ymm12, %%ymm\\r")::
                       : FASTRT_VECTOR_REGISTERS);
    asm volatile("vzeroupper");
  } else {
    asm volatile(FASTRT_EACH_ACCUMULATOR("xorps %%xmm\\r, %%xmm\\r") "xorps %%xmm12, %%xmm12\n" ::
                     : FASTRT_VECTOR_REGISTERS);
    for (int i = 0; i < rounds; ++i)
      asm volatile(FASTRT_EACH_ACCUMULATOR("mulps %%xmm12, %%xmm\\r\naddps %%xmm12, %%xmm\\r")::
                       : FASTRT_VECTOR_REGISTERS);
  }
}

// Reads everything, eight cache lines at a time.
void read_all(Isa isa, const char* p, std::size_t bytes) {
  for (const char* const end = p + bytes; p != end; p += 512) {
    if (isa == Isa::avx512)
      asm volatile(".irp o,0,64,128,192,256,320,384,448\nvmovaps \\o(%0), %%zmm0\n.endr" ::"r"(p) : "xmm0");
    else if (isa == Isa::avx2)
      asm volatile(".irp o,0,32,64,96,128,160,192,224,256,288,320,352,384,416,448,480\nvmovaps \\o(%0), "
                   "%%ymm0\n.endr" ::"r"(p)
                   : "xmm0");
    else
      asm volatile(".irp o,0,64,128,192,256,320,384,448\nmovaps \\o(%0), %%xmm0\nmovaps \\o+16(%0), %%xmm1\n"
                   "movaps \\o+32(%0), %%xmm2\nmovaps \\o+48(%0), %%xmm3\n.endr" ::"r"(p)
                   : "xmm0", "xmm1", "xmm2", "xmm3");
  }
  if (isa != Isa::sse42) asm volatile("vzeroupper");
}

struct alignas(64) Line {
  char bytes[64];
};

} // namespace

double peak_operations(Isa isa) {
  const int lanes = isa == Isa::avx512 ? 16 : isa == Isa::avx2 ? 8 : 4;
  constexpr int rounds = 5'000'000;
  return best_rate(2.0 * lanes * accumulators * rounds, [&] { multiply_add(isa, rounds); });
}

double peak_instructions() {
  constexpr int rounds = 1'000'000, count = 12 * 5;
  return best_rate(1.0 * count * rounds, [] {
    asm volatile("xorps %%xmm12, %%xmm12" ::: "xmm12");
    for (int i = 0; i < rounds; ++i)
      asm volatile(
          FASTRT_EACH_ACCUMULATOR("addps %%xmm12, %%xmm\\r\nlea 1(%%rax), %%ecx\nlea 2(%%rax), %%edx\n"
                                  "mov (%%rsp), %%esi\ncmp %%eax, %%eax")::
              : "ecx", "edx", "esi", "cc", FASTRT_VECTOR_REGISTERS);
  });
}

double read_bandwidth(std::size_t bytes, int threads) {
  const Isa isa = available_isas().front();
  const std::size_t size = bytes / 512 * 512;
  const std::size_t passes = std::max<std::size_t>(1, (std::size_t{1} << 29U) / size);
  double sum = 0;
#pragma omp parallel num_threads(threads) reduction(+ : sum)
  {
    const std::vector<Line> lines(size / sizeof(Line), Line{});
    sum += best_rate(static_cast<double>(passes * size), [&] {
      for (std::size_t pass = 0; pass < passes; ++pass) read_all(isa, lines.data()->bytes, size);
    });
  }
  return sum;
}

double copy_bandwidth() {
  constexpr std::size_t size = std::size_t{1} << 28U;
  const std::vector<char> from(size, 1);
  std::vector<char> to(size, 2);
  return best_rate(2.0 * size, [&] {
    std::memcpy(to.data(), from.data(), size);
    asm volatile("" ::"r"(to.data()) : "memory");
  });
}

} // namespace fastrt::bench
