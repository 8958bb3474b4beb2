// SPDX-License-Identifier: Apache-2.0
#include "bench/stepping.hpp"

#include <fastrt/error.hpp>

#include <ucontext.h>
#include <x86intrin.h>

#include <csignal>
#include <cstdint>

#include "bench/instruction.hpp"

namespace fastrt::bench {
namespace {

constexpr unsigned long long trap_flag = 0x100;

// Memory that is watched and which of its lines were touched since the last reset.
struct Watched {
  std::uintptr_t begin = 0, end = 0;
  std::vector<bool> touched;
};

// What the handler works on: signals have no other argument. It allocates nothing.
struct State {
  std::vector<Watched> watched;
  Work work;
  volatile bool stepping = false;
};
State state;

// The registers of a context by the processor's numbers.
constexpr int registers[16] = {REG_RAX, REG_RCX, REG_RDX, REG_RBX, REG_RSP, REG_RBP, REG_RSI, REG_RDI,
                               REG_R8,  REG_R9,  REG_R10, REG_R11, REG_R12, REG_R13, REG_R14, REG_R15};

void touch(std::uintptr_t address) {
  for (Watched& range : state.watched) {
    if (address < range.begin || address >= range.end) continue;
    const std::size_t line = address / line_bytes - range.begin / line_bytes;
    state.work.lines += !range.touched[line];
    range.touched[line] = true;
  }
}

// Called before each instruction, which the context's instruction pointer shows.
void on_step(int, siginfo_t*, void* context) {
  gregset_t& values = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  if (!state.stepping) {
    values[REG_EFL] &= ~static_cast<greg_t>(trap_flag);
    return;
  }
  const Instruction step = decode(reinterpret_cast<const std::uint8_t*>(values[REG_RIP]));
  ++state.work.instructions;
  state.work.operations += static_cast<std::size_t>(step.operations);
  if (!step.reads_memory) return;
  greg_t address = step.displacement;
  if (step.base >= 0) address += values[registers[step.base]];
  if (step.index >= 0) address += values[registers[step.index]] << step.shift;
  touch(static_cast<std::uintptr_t>(address));
}

} // namespace

Stepper::Stepper(std::vector<std::span<const std::byte>> watched) {
  state = {};
  for (const auto& bytes : watched) {
    const auto begin = reinterpret_cast<std::uintptr_t>(bytes.data());
    state.watched.push_back({begin, begin + bytes.size(), std::vector<bool>(bytes.size() / line_bytes + 2)});
  }
  struct sigaction action {};
  action.sa_sigaction = on_step;
  action.sa_flags = SA_SIGINFO;
  if (sigaction(SIGTRAP, &action, nullptr) != 0) throw Error("cannot step");
  empty_ = raw([] {});
}

Stepper::~Stepper() { std::signal(SIGTRAP, SIG_DFL); }

Work Stepper::raw(const std::function<void()>& code) {
  for (Watched& range : state.watched) range.touched.assign(range.touched.size(), false);
  state.work = {};
  state.stepping = true;
  __writeeflags(__readeflags() | trap_flag);
  code();
  state.stepping = false; // the step after this clears the flag
  return state.work;
}

Work Stepper::run(const std::function<void()>& code) {
  Work work = raw(code);
  work.instructions -= empty_.instructions;
  return work;
}

} // namespace fastrt::bench
