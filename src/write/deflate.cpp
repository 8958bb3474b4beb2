// SPDX-License-Identifier: Apache-2.0
#include "src/write/deflate.hpp"

#include "src/write/huffman.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>

namespace fastrt {

namespace {

constexpr std::size_t shortest_run = 3, longest_run = 258;
constexpr std::size_t end_of_block = 256;
constexpr std::size_t symbol_count = 286;     // bytes, end of block, run lengths
constexpr std::size_t code_length_count = 19; // symbols of the table that describes the code

// A token is a byte (0..255) or a run that repeats the byte before it (256 + its length - shortest_run).
constexpr std::size_t token_count = 512;

struct RunLength {
  std::uint16_t symbol, extra_bits, extra;
};

// Symbols 257..264 are the lengths 3..10; then each four symbols have one extra bit more; 285 is 258.
constexpr RunLength run_length(std::size_t length) {
  if (length == longest_run) return {285, 0, 0};
  const auto rest = static_cast<unsigned>(length - shortest_run);
  if (rest < 8) return {static_cast<std::uint16_t>(257 + rest), 0, 0};
  const auto bits = static_cast<unsigned>(std::bit_width(rest)) - 3;
  return {static_cast<std::uint16_t>(257 + 4 * bits + (rest >> bits)), static_cast<std::uint16_t>(bits),
          static_cast<std::uint16_t>(rest & ((1U << bits) - 1))};
}

// Writes bits, the lowest first, into memory that is known to suffice (with seven bytes more).
class BitWriter {
public:
  explicit BitWriter(unsigned char* out) : out_(out) {}
  // At most 56 bits between two calls of flush.
  void put(std::uint64_t bits, unsigned count) {
    buffer_ |= bits << filled_;
    filled_ += count;
  }
  void flush() {
    std::memcpy(out_, &buffer_, sizeof buffer_);
    out_ += filled_ >> 3U;
    buffer_ >>= filled_ & ~7U;
    filled_ &= 7U;
  }
  unsigned char* finish() {
    filled_ += 7;
    flush();
    return out_;
  }

private:
  unsigned char* out_;
  std::uint64_t buffer_ = 0;
  unsigned filled_ = 0;
};

// How many bytes from `bytes` on equal `value`, at most `count`.
std::size_t run_of(unsigned char value, const unsigned char* bytes, std::size_t count) {
  const std::uint64_t eight = 0x0101010101010101U * value;
  std::size_t n = 0;
  for (; n + 8 <= count; n += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + n, sizeof word);
    if (word != eight) return n + static_cast<std::size_t>(std::countr_zero(word ^ eight)) / 8;
  }
  while (n < count && bytes[n] == value) ++n;
  return n;
}

// Returns the number of tokens.
std::size_t make_tokens(const unsigned char* bytes, std::size_t count, std::uint16_t* tokens) {
  std::uint16_t* token = tokens;
  std::size_t i = 0;
  if (count != 0) *token++ = bytes[i++];
  // One look at four bytes tells whether the next three repeat the one before: in noisy rows they rarely do,
  // in flat ones always, so the branch is cheap.
  while (i + 3 <= count) {
    std::uint32_t four = 0;
    std::memcpy(&four, bytes + i - 1, sizeof four);
    if (((four ^ (four >> 8U)) & 0xFFFFFFU) != 0) {
      *token++ = bytes[i++];
      continue;
    }
    const std::size_t run = run_of(bytes[i - 1], bytes + i, std::min(count - i, longest_run));
    *token++ = static_cast<std::uint16_t>(256 + run - shortest_run);
    i += run;
  }
  while (i < count) *token++ = bytes[i++];
  return static_cast<std::size_t>(token - tokens);
}

using TokenCounts = std::array<std::uint32_t, token_count>;

// Equal tokens often follow each other; with four counters for each, no count waits for the one before.
TokenCounts count_tokens(const std::uint16_t* tokens, std::size_t count) {
  std::array<TokenCounts, 4> parts{};
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4)
    for (std::size_t k = 0; k < 4; ++k) ++parts[k][tokens[i + k]];
  for (; i < count; ++i) ++parts[0][tokens[i]];
  for (std::size_t k = 1; k < 4; ++k)
    for (std::size_t token = 0; token < token_count; ++token) parts[0][token] += parts[k][token];
  return parts[0];
}

struct Code {
  std::array<std::uint8_t, symbol_count> lengths{};
  std::array<std::uint16_t, symbol_count> codes{};
};

Code make_code(const TokenCounts& counts) {
  std::array<std::uint32_t, symbol_count> symbols{};
  std::copy_n(counts.begin(), 256, symbols.begin());
  symbols[end_of_block] = 1;
  for (std::size_t length = shortest_run; length <= longest_run; ++length)
    symbols[run_length(length).symbol] += counts[256 + length - shortest_run];
  Code code;
  huffman_lengths(symbols, 15, code.lengths);
  huffman_codes(code.lengths, code.codes);
  return code;
}

// The bits of every token: for a run the length's code, its extra bits, and one bit for the distance, whose
// code has a single symbol.
struct TokenBits {
  std::uint32_t bits;
  std::uint32_t count;
};

std::array<TokenBits, token_count> token_bits(const Code& code) {
  std::array<TokenBits, token_count> table{};
  for (std::size_t byte = 0; byte < 256; ++byte) table[byte] = {code.codes[byte], code.lengths[byte]};
  for (std::size_t length = shortest_run; length <= longest_run; ++length) {
    const RunLength run = run_length(length);
    const std::uint32_t bits = code.lengths[run.symbol];
    table[256 + length - shortest_run] = {static_cast<std::uint32_t>(code.codes[run.symbol]) |
                                              static_cast<std::uint32_t>(run.extra) << bits,
                                          bits + run.extra_bits + 1U};
  }
  return table;
}

// The header of a block with a code of its own. The lengths are written as they are, but for zeros, which
// come in runs (symbols 17 and 18).
void put_header(BitWriter& writer, const Code& code) {
  struct Item {
    std::uint8_t symbol, extra_bits, extra;
  };
  std::array<Item, symbol_count + 1> items{};
  std::size_t item_count = 0;
  for (std::size_t i = 0; i < symbol_count;) {
    std::size_t zeros = 0;
    while (i + zeros < symbol_count && zeros < 138 && code.lengths[i + zeros] == 0) ++zeros;
    if (zeros < 3)
      items[item_count++] = {code.lengths[i++], 0, 0};
    else if (zeros <= 10)
      items[item_count++] = {17, 3, static_cast<std::uint8_t>(zeros - 3)};
    else
      items[item_count++] = {18, 7, static_cast<std::uint8_t>(zeros - 11)};
    if (zeros >= 3) i += zeros;
  }
  items[item_count++] = {1, 0, 0}; // the distances: only 1, in one bit

  std::array<std::uint32_t, code_length_count> counts{};
  for (std::size_t i = 0; i < item_count; ++i) ++counts[items[i].symbol];
  std::array<std::uint8_t, code_length_count> lengths{};
  std::array<std::uint16_t, code_length_count> codes{};
  huffman_lengths(counts, 7, lengths);
  huffman_codes(lengths, codes);

  static constexpr std::array<std::uint8_t, code_length_count> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
  writer.put(0b100, 3); // not the last block; codes of its own
  writer.put(symbol_count - 257, 5);
  writer.put(0, 5);
  writer.put(code_length_count - 4, 4);
  writer.flush();
  for (const std::uint8_t symbol : order) {
    writer.put(lengths[symbol], 3);
    writer.flush();
  }
  for (std::size_t i = 0; i < item_count; ++i) {
    const Item& item = items[i];
    writer.put(codes[item.symbol], lengths[item.symbol]);
    writer.put(item.extra, item.extra_bits);
    writer.flush();
  }
}

void put_tokens(BitWriter& writer, const std::uint16_t* tokens, std::size_t count,
                const std::array<TokenBits, token_count>& table) {
  const auto put = [&](std::uint16_t token) { writer.put(table[token].bits, table[token].count); };
  std::size_t i = 0;
  for (; i + 2 <= count; i += 2) { // a token has at most 21 bits
    put(tokens[i]);
    put(tokens[i + 1]);
    writer.flush();
  }
  if (i < count) put(tokens[i]);
  writer.flush();
}

} // namespace

void deflate_piece(const unsigned char* bytes, std::size_t count, std::vector<unsigned char>& out) {
  const auto tokens = std::make_unique_for_overwrite<std::uint16_t[]>(count);
  const std::size_t made = make_tokens(bytes, count, tokens.get());
  const TokenCounts counts = count_tokens(tokens.get(), made);
  const Code code = make_code(counts);
  const std::array<TokenBits, token_count> table = token_bits(code);
  std::size_t bits = 0;
  for (std::size_t i = 0; i < token_count; ++i) bits += std::size_t{counts[i]} * table[i].count;

  constexpr std::size_t most_else = 1024; // header (at most 512), ends of blocks, and what flush overwrites
  const std::size_t begin = out.size();
  out.resize(begin + bits / 8 + most_else);
  BitWriter writer(out.data() + begin);
  put_header(writer, code);
  put_tokens(writer, tokens.get(), made, table);
  writer.put(code.codes[end_of_block], code.lengths[end_of_block]);
  writer.put(0b000, 3); // an empty stored block: the rest of the byte, and its length with the complement
  unsigned char* end = writer.finish();
  static constexpr std::array<unsigned char, 4> empty = {0x00, 0x00, 0xFF, 0xFF};
  end = std::copy(empty.begin(), empty.end(), end);
  out.resize(static_cast<std::size_t>(end - out.data()));
}

void deflate_end(std::vector<unsigned char>& out) {
  out.push_back(0b011); // the last block, with the fixed code
  out.push_back(0);
}

} // namespace fastrt
