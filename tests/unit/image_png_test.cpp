// SPDX-License-Identifier: Apache-2.0
// PNG files, read back by the system's zlib (which OpenImageIO brings) and a plain unfilter.
#include "src/film/srgb.hpp"
#include "src/write/checksum.hpp"
#include "src/write/deflate.hpp"
#include "src/write/huffman.hpp"
#include "tests/unit/image_pictures.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace fastrt {
namespace {

using Bytes = std::vector<unsigned char>;

struct Zlib {
  int (*uncompress)(unsigned char*, unsigned long*, const unsigned char*, unsigned long);
  unsigned long (*crc32)(unsigned long, const unsigned char*, unsigned);
  unsigned long (*adler32)(unsigned long, const unsigned char*, unsigned);
};

const Zlib& zlib() {
  static const Zlib functions = [] {
    void* library = dlopen("libz.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error("this test needs libz.so.1");
    Zlib found{};
    found.uncompress = reinterpret_cast<decltype(found.uncompress)>(dlsym(library, "uncompress"));
    found.crc32 = reinterpret_cast<decltype(found.crc32)>(dlsym(library, "crc32"));
    found.adler32 = reinterpret_cast<decltype(found.adler32)>(dlsym(library, "adler32"));
    return found;
  }();
  return functions;
}

std::uint32_t word(const Bytes& file, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8U | file.at(at + i);
  return value;
}

int predicted(int filter, int a, int b, int c) {
  if (filter == 0) return 0;
  if (filter == 1) return a;
  if (filter == 2) return b;
  if (filter == 3) return (a + b) / 2;
  const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
  if (pa <= pb && pa <= pc) return a;
  return pb <= pc ? b : c;
}

struct Decoded {
  std::uint32_t width = 0, height = 0;
  Bytes rgb;
  std::array<int, 5> filters{}; // how many rows have each
};

Decoded unfilter(const Bytes& filtered, std::uint32_t width, std::uint32_t height) {
  Decoded image{width, height, {}, {}};
  const std::size_t row = 3 * std::size_t{width};
  image.rgb.resize(row * height);
  for (std::size_t y = 0; y < height; ++y) {
    const int filter = filtered.at(y * (row + 1));
    ++image.filters.at(static_cast<std::size_t>(filter));
    for (std::size_t i = 0; i < row; ++i) {
      const int a = i >= 3 ? image.rgb[y * row + i - 3] : 0;
      const int b = y > 0 ? image.rgb[(y - 1) * row + i] : 0;
      const int c = i >= 3 && y > 0 ? image.rgb[(y - 1) * row + i - 3] : 0;
      image.rgb[y * row + i] =
          static_cast<unsigned char>(filtered.at(y * (row + 1) + 1 + i) + predicted(filter, a, b, c));
    }
  }
  return image;
}

Decoded decode(const Bytes& file) {
  const Bytes signature = {0x89, 'P', 'N', 'G', 13, 10, 26, 10};
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), file.begin()));
  std::vector<std::string> names;
  Bytes stream;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = word(file, at);
    names.emplace_back(file.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                       file.begin() + static_cast<std::ptrdiff_t>(at) + 8);
    EXPECT_EQ(zlib().crc32(0, file.data() + at + 4, static_cast<unsigned>(size + 4)),
              word(file, at + 8 + size));
    if (names.back() == "IDAT")
      stream.insert(stream.end(), file.begin() + static_cast<std::ptrdiff_t>(at) + 8,
                    file.begin() + static_cast<std::ptrdiff_t>(at + 8 + size));
    at += size + 12;
  }
  EXPECT_EQ(names.front(), "IHDR");
  EXPECT_EQ(names.back(), "IEND");
  const std::uint32_t width = word(file, 16), height = word(file, 20);
  Bytes filtered((3 * std::size_t{width} + 1) * height);
  unsigned long size = filtered.size();
  EXPECT_EQ(zlib().uncompress(filtered.data(), &size, stream.data(), stream.size()), 0);
  EXPECT_EQ(size, filtered.size());
  return unfilter(filtered, width, height);
}

TEST(Png, DecodesToTheSameCodes) {
  std::array<int, 5> filters{};
  for (const TestPicture& picture : test_pictures()) {
    SCOPED_TRACE(picture.name + " " + std::to_string(picture.width) + "x" + std::to_string(picture.height));
    const Decoded image = decode(encode_image("png", picture.rgb, picture.width, picture.height));
    EXPECT_EQ(image.width, static_cast<std::uint32_t>(picture.width));
    EXPECT_EQ(image.height, static_cast<std::uint32_t>(picture.height));
    Bytes codes(picture.rgb.size());
    to_srgb8(picture.rgb.data(), codes.size(), codes.data());
    EXPECT_TRUE(image.rgb == codes);
    for (std::size_t i = 0; i < filters.size(); ++i) filters[i] += image.filters[i];
  }
  for (const std::size_t used : {1U, 2U, 4U}) EXPECT_GT(filters[used], 0) << used;
}

TEST(Png, DoesNotDependOnTheThreads) {
  for (const TestPicture& picture : {ball_picture(400, 600), noise_picture(300, 500)}) {
    const Bytes one = encode_image("png", picture.rgb, picture.width, picture.height, 1);
    for (const int threads : {2, 3, 7})
      EXPECT_TRUE(encode_image("png", picture.rgb, picture.width, picture.height, threads) == one) << threads;
  }
}

TEST(Png, IsSmallForFlatPictures) {
  const TestPicture flat = flat_picture(1000, 1000, 0.5F);
  EXPECT_LT(encode_image("png", flat.rgb, 1000, 1000).size(), 12000U);
  const TestPicture noise = noise_picture(500, 500);
  EXPECT_LT(encode_image("png", noise.rgb, 500, 500).size(), 765000U); // at most 2 % more than the pixels
}

Bytes inflated(const Bytes& deflated, const Bytes& original) {
  Bytes stream = {0x78, 0x01};
  stream.insert(stream.end(), deflated.begin(), deflated.end());
  deflate_end(stream);
  const std::uint32_t adler = adler32(original.data(), original.size());
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    stream.push_back(static_cast<unsigned char>(adler >> shift));
  Bytes out(original.size() + 1);
  unsigned long size = out.size();
  EXPECT_EQ(zlib().uncompress(out.data(), &size, stream.data(), stream.size()), 0);
  out.resize(size);
  return out;
}

TEST(Deflate, RunsOfEveryLength) {
  Bytes bytes;
  for (std::size_t length = 1; length < 600; ++length)
    bytes.insert(bytes.end(), length, static_cast<unsigned char>(length));
  Bytes deflated;
  deflate_piece(bytes.data(), bytes.size(), deflated);
  EXPECT_TRUE(inflated(deflated, bytes) == bytes);
}

TEST(Deflate, PiecesOfEverySizeJoin) {
  std::mt19937 random(3);
  Bytes all, deflated;
  for (std::size_t size = 0; size < 70; ++size) {
    Bytes piece(size);
    for (unsigned char& byte : piece) byte = static_cast<unsigned char>(random() % (1 + size % 4));
    deflate_piece(piece.data(), piece.size(), deflated);
    all.insert(all.end(), piece.begin(), piece.end());
  }
  EXPECT_TRUE(inflated(deflated, all) == all);
}

// Counts that grow like Fibonacci's numbers ask for codes longer than deflate allows.
TEST(Deflate, SkewedCountsKeepTheLimit) {
  Bytes bytes;
  std::size_t a = 1, b = 1;
  for (unsigned symbol = 0; symbol < 25; ++symbol) {
    for (std::size_t i = 0; i < a; ++i)
      bytes.push_back(static_cast<unsigned char>(symbol * 2 + (i & 1U) * 100));
    b = std::exchange(a, b) + b;
  }
  Bytes deflated;
  deflate_piece(bytes.data(), bytes.size(), deflated);
  EXPECT_TRUE(inflated(deflated, bytes) == bytes);
}

TEST(Huffman, LengthsFillTheCodeExactly) {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    const unsigned limit = round % 2 == 0 ? 15 : 7;
    std::vector<std::uint32_t> counts(limit == 15 ? 286 : 19);
    for (std::uint32_t& count : counts)
      count = random() % 3 == 0 ? 0U : static_cast<std::uint32_t>(random()) >> (random() % 32U);
    const auto used = std::count_if(counts.begin(), counts.end(), [](std::uint32_t n) { return n != 0; });
    std::vector<std::uint8_t> lengths(counts.size());
    huffman_lengths(counts, limit, lengths);
    std::size_t filled = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      EXPECT_EQ(lengths[i] == 0, counts[i] == 0);
      ASSERT_LE(lengths[i], limit);
      if (lengths[i] != 0) filled += std::size_t{1} << (limit - lengths[i]);
    }
    EXPECT_EQ(filled, used >= 2 ? std::size_t{1} << limit : static_cast<std::size_t>(used) << (limit - 1));
  }
}

TEST(Checksum, AgreesWithZlib) {
  std::mt19937 random(11);
  Bytes bytes(70000);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random() | (random() & 0xF0U));
  for (const std::size_t n : {0U, 1U, 7U, 8U, 9U, 4095U, 4096U, 4097U, 70000U}) {
    EXPECT_EQ(crc32(bytes.data(), n), zlib().crc32(0, bytes.data(), static_cast<unsigned>(n)));
    EXPECT_EQ(adler32(bytes.data(), n), zlib().adler32(1, bytes.data(), static_cast<unsigned>(n)));
    const std::uint32_t rest = adler32(bytes.data() + n, bytes.size() - n);
    EXPECT_EQ(adler32_combine(adler32(bytes.data(), n), rest, bytes.size() - n),
              adler32(bytes.data(), bytes.size()));
  }
  const Bytes high(70000, 0xFF);
  EXPECT_EQ(adler32(high.data(), high.size()), zlib().adler32(1, high.data(), 70000));
}

} // namespace
} // namespace fastrt
