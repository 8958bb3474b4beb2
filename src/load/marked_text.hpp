// SPDX-License-Identifier: Apache-2.0
// Numbers and indices out of text whose marks are known (see DigitMarks): the fast way of the OBJ reader. It
// knows no other blank than spaces. What it does not take is for a careful reader.
#pragma once

#include "src/load/digit_runs.hpp"
#include "src/load/text.hpp"

#include <cstddef>
#include <cstdint>

namespace fastrt {

// At a mark of a line that ends in a line end.
struct MarkedText {
  const char* text;        // what the marks are counted from
  const std::uint16_t* at; // the mark

  const char* place() const { return text + at[0]; }
  char mark() const { return *place(); }
  bool at_line_end() const { return is_line_end(mark()); }
  bool at_space_or_end() const { return mark() == ' ' || at_line_end(); }
  // Of the run between this mark and the next.
  std::size_t length() const { return std::size_t{at[1]} - at[0] - 1; }
};

// From a space to the last one of a row of them; if the line ends there, to its end.
[[gnu::always_inline]] inline void skip_spaces(MarkedText& p) {
  while (p.at[1] == p.at[0] + 1 && p.mark() == ' ') {
    const char next = p.text[p.at[1]];
    if (next != ' ' && !is_line_end(next)) return;
    ++p.at;
  }
}

// Takes the number behind a space, which must end in a space or line end; goes there. False if there is none,
// or if it needs parse_number.
inline bool take_number(MarkedText& p, float& value) {
  const char* q = p.place() + 1;
  if (!take_float(q, value)) return false;
  while (p.place() < q) ++p.at;
  return p.place() == q && p.at_space_or_end();
}

// A number's digits as two lanes of eight: before the point and behind it.
struct PointedDigits {
  __m128i digits;
  std::size_t decimals;
  bool negative;
};

// Finds them at the marks before the number, at its point and behind it: at most seven and eight. False for
// numbers of any other kind.
[[gnu::always_inline]] inline bool find_digits(const MarkedText& p, PointedDigits& found) {
  found.negative = p.place()[1] == '-';
  const std::size_t whole = p.length() - (found.negative ? 1U : 0U);
  found.decimals = MarkedText{p.text, p.at + 1}.length();
  if (p.text[p.at[1]] != '.' || whole > 7 || found.decimals > 8 || whole + found.decimals == 0) return false;
  found.digits = digits_before(p.text + p.at[1], whole, p.text + p.at[2], found.decimals);
  return true;
}

// The number of which `parts` are the two numbers before and behind the point.
[[gnu::always_inline]] inline bool put_together(const PointedDigits& from, std::uint64_t parts,
                                                float& value) {
  const std::uint64_t whole = parts & 0xFFFFFFFFU, fraction = parts >> 32U;
  const std::uint64_t mantissa = whole * small_powers_of_ten[from.decimals] + fraction;
  return round_to_float(static_cast<double>(static_cast<std::int64_t>(mantissa)) /
                            exact_powers_of_ten[from.decimals],
                        from.negative, value);
}

// Takes `count` numbers with points, each behind one space, and goes to the mark behind the last one. False,
// and p where it was, for all else.
template <std::size_t count>
[[gnu::always_inline]] inline bool take_pointed_numbers(MarkedText& p, float* values) {
  static_assert(count == 2 || count == 3);
  PointedDigits found[count];
  for (std::size_t i = 0; i < count; ++i)
    if (!find_digits({p.text, p.at + 2 * i}, found[i])) return false;
  for (std::size_t i = 1; i < count; ++i)
    if (p.text[p.at[2 * i]] != ' ') return false;
  const __m128i last = count == 3 ? found[2].digits : _mm_setzero_si128();
  if (!are_digits(_mm_max_epu8(_mm_max_epu8(found[0].digits, found[1].digits), last))) return false;
  const __m128i parts = join_runs(found[0].digits, found[1].digits);
  if (!put_together(found[0], low_word(parts), values[0]) ||
      !put_together(found[1], low_word(_mm_unpackhi_epi64(parts, parts)), values[1]))
    return false;
  if (count == 3 && !put_together(found[2], low_word(join_runs(last, last)), values[2])) return false;
  const MarkedText behind{p.text, p.at + 2 * count};
  if (!behind.at_space_or_end()) return false;
  p = behind;
  return true;
}

// Takes "17" or "-3" behind a mark as an index from 0, and goes to the mark behind it. `so_far`: how many
// there are before this line.
inline bool take_reference(MarkedText& p, std::uint64_t total, std::uint64_t so_far, std::uint32_t& index) {
  const char* q = p.place() + 1;
  const bool negative = *q == '-';
  q += negative ? 1 : 0;
  std::uint32_t value = 0;
  if (!take_index(q, value) || q != p.text + p.at[1]) return false;
  ++p.at;
  index = negative ? static_cast<std::uint32_t>(so_far) - value : value - 1U;
  return index < (negative ? so_far : total);
}

// The runs between four marks in a row as indices from 0; the fourth lane means nothing. The middle one is
// no_index if it is empty and may be so. False if one is no index, or exceeds its total. Totals fit a signed
// number.
template <bool may_skip_middle>
[[gnu::always_inline]] inline bool take_three_indices(const MarkedText& p, __m128i totals, __m128i& indices) {
  const MarkedText q{p.text, p.at + 1}, r{p.text, p.at + 2};
  const std::size_t a = p.length(), b = q.length(), c = r.length();
  if (a > 8 || b > 8 || c > 8) return false;
  const __m128i first = digits_before(p.text + q.at[0], a, p.text + r.at[0], b);
  const __m128i last = digits_before(p.text + r.at[1], c);
  if (!are_digits(_mm_max_epu8(first, last))) return false;
  indices = _mm_sub_epi32(join_runs(first, last), _mm_set1_epi32(1));
  // What is no number in front is 0 and becomes -1.
  const __m128i fits = _mm_andnot_si128(indices, _mm_cmpgt_epi32(totals, indices));
  const int fit = _mm_movemask_ps(_mm_castsi128_ps(fits));
  return (fit & 7) == 7 || (may_skip_middle && b == 0 && (fit & 5) == 5);
}

} // namespace fastrt
