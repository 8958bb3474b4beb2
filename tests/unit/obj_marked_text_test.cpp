// SPDX-License-Identifier: Apache-2.0
#include "src/load/digit_marks.hpp"
#include "src/load/marked_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace fastrt {
namespace {

constexpr std::size_t padding = 64;

// Text with blanks around it, and its marks.
struct Marked {
  std::string bytes;
  std::unique_ptr<DigitMarks> marks = std::make_unique<DigitMarks>();

  explicit Marked(const std::string& text)
      : bytes(std::string(padding, '\n') + text + std::string(padding, '\n')) {
    marks->find(begin(), begin() + text.size() + 1);
  }
  const char* begin() const { return bytes.data() + padding; }
  // At the mark with this number.
  MarkedText at(std::size_t mark) const { return {begin(), marks->begin() + mark}; }
};

std::array<std::uint32_t, 4> lanes(__m128i values) {
  std::array<std::uint32_t, 4> all{};
  std::memcpy(all.data(), &values, sizeof all);
  return all;
}

bool is_mark(char c) { return static_cast<unsigned char>(c) <= '/' && c != '-'; }

TEST(ObjMarkedText, FindsEveryMark) {
  std::mt19937 random(1);
  for (const std::size_t size : {0U, 1U, 15U, 16U, 17U, 1000U, 8191U, 8192U, 20000U}) {
    std::string text(size, ' ');
    for (char& c : text) c = static_cast<char>(random() % (random() % 2 == 0 ? 256 : 64));
    const Marked marked(text);
    std::vector<std::uint16_t> expected;
    const std::size_t known = std::min(text.size() + 1, DigitMarks::reach);
    for (std::size_t i = 0; i < known; ++i)
      if (is_mark(marked.begin()[i])) expected.push_back(static_cast<std::uint16_t>(i));
    const auto found = static_cast<std::size_t>(marked.marks->end() - marked.marks->begin());
    ASSERT_GE(found, expected.size());
    ASSERT_LE(found, expected.size() + 15); // those of a sixteen that is not all text
    EXPECT_TRUE(std::equal(expected.begin(), expected.end(), marked.marks->begin()));
  }
}

std::string random_digits(std::mt19937& random, std::size_t count) {
  std::string text;
  while (text.size() < count) text += static_cast<char>('0' + random() % 10);
  return text;
}

TEST(ObjMarkedText, ThreePointedNumbersEqualTheCarefulOnes) {
  std::mt19937 random(2);
  int taken = 0;
  constexpr int count = 200'000;
  for (int i = 0; i < count; ++i) {
    std::array<std::string, 3> words;
    for (std::string& word : words) {
      if (random() % 2 == 0) word = "-";
      word += random_digits(random, random() % 8) + '.';
      word += random_digits(random, word.size() < 3 ? 1 + random() % 8 : random() % 9);
    }
    const Marked marked("v " + words[0] + ' ' + words[1] + ' ' + words[2]);
    MarkedText p = marked.at(0);
    std::array<float, 3> values{};
    if (!take_pointed_numbers<3>(p, values.data())) {
      EXPECT_EQ(p.at, marked.at(0).at);
      continue;
    }
    ++taken;
    EXPECT_TRUE(p.at_line_end());
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(std::bit_cast<std::uint32_t>(values[k]),
                std::bit_cast<std::uint32_t>(parse_number(words[k]).value))
          << words[k];
  }
  EXPECT_GT(taken, count * 99 / 100); // but for those half-way between two floats
}

TEST(ObjMarkedText, OtherNumbersAreLeftToOthers) {
  for (const char* text :
       {"v 1.0 2.0", "v 1.0 2.0 3", "v 1 2.0 3.0", "v 1.0  2.0 3.0", "v 1.0 2.0 3.0e1", "v . 2.0 3.0",
        "v 1.0 -. 3.0", "v 1.0 2.0 +3.0", "v 1.0 --2.0 3.0", "v 1.0\t2.0 3.0", "v 1.0 2.-1 3.0",
        "v 1.0 2.0 3.0.0", "v 1.0 2.0 3.0/", "v 12345678.0 2.0 3.0", "v 1.123456789 2.0 3.0",
        "v 1.0 2.0:1.0 3.0", "v 1.0 2.0 \xB3.0"}) {
    const Marked marked(text);
    MarkedText p = marked.at(0);
    std::array<float, 3> values{};
    EXPECT_FALSE(take_pointed_numbers<3>(p, values.data())) << text;
    EXPECT_EQ(p.at, marked.at(0).at);
  }
}

TEST(ObjMarkedText, ThreeIndicesCountFromZero) {
  std::mt19937 random(3);
  const __m128i totals = _mm_set1_epi32(99'999'999);
  for (int i = 0; i < 10'000; ++i) {
    std::array<std::uint32_t, 3> expected{};
    for (std::uint32_t& index : expected)
      index = static_cast<std::uint32_t>(random() % 99999999U >> (random() % 27));
    const Marked marked("f " + std::to_string(expected[0] + 1) + '/' + std::to_string(expected[1] + 1) + '/' +
                        std::to_string(expected[2] + 1));
    __m128i indices = _mm_setzero_si128();
    ASSERT_TRUE(take_three_indices<true>(marked.at(0), totals, indices));
    ASSERT_TRUE(take_three_indices<false>(marked.at(0), totals, indices));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(lanes(indices)[k], expected[k]);
  }
}

TEST(ObjMarkedText, IndicesOutOfRangeAreRefused) {
  const __m128i totals = _mm_set_epi32(0, 30, 20, 10);
  const auto takes = [totals](const std::string& text) {
    const Marked marked(text);
    __m128i indices = _mm_setzero_si128();
    return take_three_indices<true>(marked.at(0), totals, indices);
  };
  EXPECT_TRUE(takes("f 10/20/30"));
  EXPECT_TRUE(takes("f 10//30"));
  EXPECT_TRUE(takes("f 00000001/20/30"));
  for (const char* text :
       {"f 11/20/30", "f 10/21/30", "f 10/20/31", "f 0/20/30", "f 10/0/30", "f 10/20/0", "f -1/20/30",
        "f /20/30", "f 10/20/", "f 000000001/20/30", "f 1:/20/30", "f 10/2e/30"})
    EXPECT_FALSE(takes(text)) << text;
  const Marked marked("f 10//30");
  __m128i indices = _mm_setzero_si128();
  ASSERT_TRUE(take_three_indices<true>(marked.at(0), totals, indices));
  EXPECT_EQ(lanes(indices)[1], 0xFFFFFFFFU);
  EXPECT_FALSE(take_three_indices<false>(marked.at(0), totals, indices));
}

TEST(ObjMarkedText, EveryOtherByteIsNoDigit) {
  for (int byte = 0; byte < 256; ++byte) {
    const bool is_one = byte >= '0' && byte <= '9';
    for (std::size_t place = 0; place < 8; ++place) {
      std::string text = "77777777";
      text[place] = static_cast<char>(byte);
      EXPECT_EQ(are_digits(digits_before(text.data() + 8, 8)), is_one);
      EXPECT_EQ(are_digits(digits_before(text.data() + 8, 7 - place)), true);
    }
  }
}

} // namespace
} // namespace fastrt
