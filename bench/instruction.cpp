// SPDX-License-Identifier: Apache-2.0
#include "bench/instruction.hpp"

#include <cstring>

namespace fastrt::bench {
namespace {

// Opcode maps as VEX and EVEX number them: 0 one byte, 1 behind 0F, 2 behind 0F 38, 3 behind 0F 3A.
struct Opcode {
  int map = 0, code = 0;
  int prefix = 0; // 1: 66 (double, or integers), 2: F3 (one float), 3: F2 (one double)
  int bits = 128; // of the registers
  bool evex = false, broadcast = false;
  int more_index = 0, more_base = 0; // bit 3 of register numbers
};

const std::uint8_t* read_evex(const std::uint8_t* p, Opcode& op) {
  op.map = p[1] & 7;
  op.prefix = p[2] & 3;
  op.bits = 128 << (p[3] >> 5 & 3);
  op.broadcast = (p[3] & 16) != 0;
  op.evex = true;
  op.more_index = (~p[1] >> 6 & 1) << 3;
  op.more_base = (~p[1] >> 5 & 1) << 3;
  op.code = p[4];
  return p + 5;
}

const std::uint8_t* read_vex(const std::uint8_t* p, Opcode& op) {
  const bool is_long = p[0] == 0xC4;
  const int last = is_long ? p[2] : p[1];
  if (is_long) {
    op.map = p[1] & 31;
    op.more_index = (~p[1] >> 6 & 1) << 3;
    op.more_base = (~p[1] >> 5 & 1) << 3;
  } else {
    op.map = 1;
  }
  op.bits = 128 << (last >> 2 & 1);
  op.prefix = last & 3;
  op.code = p[is_long ? 3 : 2];
  return p + (is_long ? 4 : 3);
}

const std::uint8_t* read_plain(const std::uint8_t* p, Opcode& op) {
  if ((*p & 0xF0) == 0x40) {
    op.more_index = (*p >> 1 & 1) << 3;
    op.more_base = (*p & 1) << 3;
    ++p;
  }
  if (*p != 0x0F) {
    op.code = *p++;
    return p;
  }
  ++p;
  op.map = 1;
  if (*p == 0x38 || *p == 0x3A) op.map = *p++ == 0x38 ? 2 : 3;
  op.code = *p++;
  return p;
}

const std::uint8_t* read_opcode(const std::uint8_t* p, Opcode& op) {
  for (;; ++p) {
    if (*p == 0x66)
      op.prefix = 1;
    else if (*p == 0xF3)
      op.prefix = 2;
    else if (*p == 0xF2)
      op.prefix = 3;
    else if (*p != 0x2E && *p != 0x3E && *p != 0xF0)
      break;
  }
  if (*p == 0x62) return read_evex(p, op);
  if (*p == 0xC4 || *p == 0xC5) return read_vex(p, op);
  return read_plain(p, op);
}

int operations(const Opcode& op) {
  const int lanes = op.bits / 32;
  if (op.map == 1 && (op.prefix == 0 || op.prefix == 2)) {
    switch (op.code) {
    case 0x51:
    case 0x58:
    case 0x59:
    case 0x5C:
    case 0x5D:
    case 0x5E:
    case 0x5F:
    case 0xC2: // sqrt + * - min / max compare
      return op.prefix == 0 ? lanes : 1;
    case 0x2E:
    case 0x2F:
      return 1; // compare into the flags
    default:
      return 0;
    }
  }
  const int column = op.code & 15, row = op.code >> 4;
  if (op.map == 2 && op.prefix == 1 && row >= 9 && row <= 11 && column >= 6) // FMA
    return 2 * (column >= 9 && column % 2 != 0 ? 1 : lanes);
  return 0;
}

bool has_operand(const Opcode& op) {
  const int code = op.code;
  if (op.map >= 2)
    return !(op.map == 2 && op.prefix == 1 && (code >> 2 == 0x90 >> 2 || code >> 2 == 0xA0 >> 2)); // gathers
  if (op.map == 1) // not jumps, byte swaps, prefetches, nops, system calls
    return !(code >> 4 == 8 || code >> 3 == 0xC8 >> 3 || code == 0x18 || code == 0x0D || code == 0x1F ||
             code == 0x05 || code == 0x77 || code == 0xA2 || code == 0x31);
  if (code < 0x40) return (code & 7) < 4;
  if (code >> 4 == 8) return code != 0x8D; // lea computes an address and reads nothing
  switch (code) {
  case 0x63:
  case 0x69:
  case 0x6B:
  case 0xC0:
  case 0xC1:
  case 0xC6:
  case 0xC7:
  case 0xD0:
  case 0xD1:
  case 0xD2:
  case 0xD3:
  case 0xF6:
  case 0xF7:
  case 0xFE:
  case 0xFF:
    return true;
  default:
    return false;
  }
}

// EVEX counts displacements of one byte in units of what the instruction reads.
int displacement_unit(const Opcode& op) {
  if (!op.evex) return 1;
  if (op.broadcast) return 4;
  const bool moves_register = op.map == 1 && (op.code == 0x6F || op.code == 0x7F); // whatever the prefix
  if (op.map == 1 && op.prefix >= 2 && !moves_register) return op.prefix == 2 ? 4 : 8;
  if (op.map == 2 && (op.code == 0x18 || op.code == 0x58)) return 4; // one float or integer to all lanes
  if (op.map == 2 && (op.code == 0x19 || op.code == 0x59)) return 8; // two
  const bool quarter = (op.map == 2 && (op.code == 0x1A || op.code == 0x5A)) ||
                       (op.map == 3 && (op.code == 0x18 || op.code == 0x38));
  const bool half = (op.map == 2 && (op.code == 0x1B || op.code == 0x5B)) ||
                    (op.map == 3 && (op.code == 0x1A || op.code == 0x3A));
  if (quarter) return 16;
  return half ? 32 : op.bits / 8;
}

} // namespace

Instruction decode(const std::uint8_t* code) noexcept {
  Opcode op;
  const std::uint8_t* p = read_opcode(code, op);
  Instruction result;
  result.operations = operations(op);
  if (!has_operand(op)) return result;
  const int mode = *p >> 6, field = *p & 7;
  ++p;
  if (mode == 3 || (mode == 0 && field == 5))
    return result; // a register, or relative to the next instruction
  bool has_base = true;
  if (field == 4) {
    result.base = (*p & 7) | op.more_base;
    const int index = (*p >> 3 & 7) | op.more_index;
    if (index != 4) result.index = index;
    result.shift = *p >> 6;
    has_base = !(mode == 0 && (*p & 7) == 5);
    if (!has_base) result.base = -1;
    ++p;
  } else {
    result.base = field | op.more_base;
  }
  result.reads_memory = true;
  if (mode == 1) {
    result.displacement = static_cast<std::int8_t>(*p) * displacement_unit(op);
  } else if (mode == 2 || !has_base) {
    std::int32_t displacement = 0;
    std::memcpy(&displacement, p, sizeof displacement);
    result.displacement = displacement;
  }
  return result;
}

} // namespace fastrt::bench
