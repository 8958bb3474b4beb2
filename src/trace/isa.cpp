// SPDX-License-Identifier: Apache-2.0
#include <fastrt/error.hpp>
#include <fastrt/isa.hpp>

#include <cpuid.h>

#include <array>

namespace fastrt {
namespace {

struct IsaRow {
  Isa isa;
  const char* name;
  int width;
};
// The widest first.
constexpr std::array<IsaRow, 4> rows{{{Isa::avx512, "avx512", 16},
                                      {Isa::avx2, "avx2", 8},
                                      {Isa::sse42, "sse4.2", 4},
                                      {Isa::scalar, "scalar", 1}}};

const IsaRow& row_of(Isa isa) noexcept {
  for (const IsaRow& row : rows)
    if (row.isa == isa) return row;
  return rows.back();
}

std::string list_available() {
  std::string list;
  for (const Isa isa : available_isas()) list += std::string(list.empty() ? "" : ", ") + isa_name(isa);
  return list;
}

// Which not every compiler's own detection knows.
bool has_lzcnt() noexcept {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(0x80000001U, &a, &b, &c, &d) != 0 && (c & bit_LZCNT) != 0;
}

} // namespace

const char* isa_name(Isa isa) noexcept { return row_of(isa).name; }
int isa_width(Isa isa) noexcept { return row_of(isa).width; }

// The compiler's own detection also asks whether the operating system saves the registers.
bool isa_available(Isa isa) noexcept {
  switch (isa) {
  case Isa::scalar:
    return true;
  case Isa::sse42:
    return __builtin_cpu_supports("sse4.2") != 0;
  case Isa::avx2:
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
           __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0 && has_lzcnt();
  case Isa::avx512:
    return isa_available(Isa::avx2) && __builtin_cpu_supports("avx512f") != 0 &&
           __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  }
  return false;
}

std::vector<Isa> available_isas() {
  std::vector<Isa> available;
  for (const IsaRow& row : rows)
    if (isa_available(row.isa)) available.push_back(row.isa);
  return available;
}

Isa select_isa(std::string_view name) {
  if (name.empty() || name == "auto") return available_isas().front();
  for (const IsaRow& row : rows) {
    if (name != row.name) continue;
    if (isa_available(row.isa)) return row.isa;
    throw UsageError("this CPU does not support " + std::string(name) + "; available: " + list_available());
  }
  throw UsageError("unknown ISA '" + std::string(name) + "'; available: auto, " + list_available());
}

} // namespace fastrt
