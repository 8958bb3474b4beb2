// SPDX-License-Identifier: Apache-2.0
// The decoders of PNG and JPEG files give what OpenImageIO gives, and leave unusual JPEGs to it.
#include "src/modules/open.hpp"
#include "src/modules/pictures.hpp"
#include "src/write/checksum.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <fastrt/write.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>

namespace fastrt::test {
namespace {

using Bytes = std::vector<unsigned char>;

struct Pixels {
  int width, height, is_float;
  Bytes rgba;
  bool operator==(const Pixels&) const = default;
};

// What a module makes of a whole file; nothing if it leaves it, or says what is wrong with it.
std::optional<Pixels> decoded(const ModuleFunction& module, const char* format, const Bytes& bytes,
                              std::size_t most_bytes = 1U << 30U) {
  if (module.function == nullptr) {
    ADD_FAILURE() << module.fault;
    return {};
  }
  const PictureFile file{format, bytes.data(), bytes.size(), max_image_side, most_bytes};
  DecodedPicture picture{};
  const bool done = reinterpret_cast<PictureDecode*>(module.function)(&file, &picture) != 0;
  std::optional<Pixels> pixels;
  if (done && picture.is_damaged == 0) {
    const auto* const rgba = static_cast<const unsigned char*>(picture.rgba);
    const int size = (picture.is_float != 0 ? 16 : 4) * picture.width * picture.height;
    pixels = {picture.width, picture.height, picture.is_float, Bytes(rgba, rgba + size)};
  } else {
    EXPECT_NE(picture.error[0], '\0');
  }
  std::free(picture.rgba);
  return pixels;
}
std::optional<Pixels> decoded_here(const char* format, const Bytes& bytes,
                                   std::size_t most_bytes = 1U << 30U) {
  return decoded(find_png_jpeg_function(png_jpeg_decode_name), format, bytes, most_bytes);
}

void expect_as_by_openimageio(const char* format, const Bytes& bytes, const std::string& what) {
  const std::optional<Pixels> here = decoded_here(format, bytes);
  ASSERT_TRUE(here.has_value()) << what;
  EXPECT_TRUE(here == decoded(find_oiio_function(oiio_decode_name), format, bytes)) << what;
}

void put_word(std::uint32_t word, Bytes& out) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<unsigned char>(word >> shift));
}

void put_chunk(const char* name, const Bytes& contents, Bytes& out) {
  put_word(static_cast<std::uint32_t>(contents.size()), out);
  Bytes named(name, name + 4);
  named.insert(named.end(), contents.begin(), contents.end());
  out.insert(out.end(), named.begin(), named.end());
  put_word(crc32(named.data(), named.size()), out);
}

// PNG's numbers.
enum ColorType : unsigned char { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };
struct Kind {
  ColorType type;
  unsigned char depth;
  bool interlaced = false, has_transparent_color = false;
};

// Rows of arbitrary bytes, each after its filter (none).
Bytes rows_of(int width, int height, int bits_per_pixel, unsigned& state) {
  Bytes rows;
  for (int y = 0; y < height && width > 0; ++y) {
    rows.push_back(0);
    for (int i = 0; i < (width * bits_per_pixel + 7) / 8; ++i)
      rows.push_back(static_cast<unsigned char>((state = state * 1664525U + 1013904223U) >> 24U));
  }
  return rows;
}

// A picture of 13 x 11 arbitrary pixels.
Bytes png_of(const Kind& kind) {
  constexpr int width = 13, height = 11, channels[] = {1, 0, 3, 1, 2, 0, 4};
  const int bits = channels[kind.type] * kind.depth;
  unsigned state = 7;
  Bytes rows;
  if (kind.interlaced) { // every a-th column from x on, every b-th row from y on
    constexpr int passes[7][4] = {{0, 8, 0, 8}, {4, 8, 0, 8}, {0, 4, 4, 8}, {2, 4, 0, 4},
                                  {0, 2, 2, 4}, {1, 2, 0, 2}, {0, 1, 1, 2}};
    for (const auto& [x, a, y, b] : passes) {
      const Bytes pass = rows_of((width - x + a - 1) / a, (height - y + b - 1) / b, bits, state);
      rows.insert(rows.end(), pass.begin(), pass.end());
    }
  } else {
    rows = rows_of(width, height, bits, state);
  }
  Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'}, head;
  put_word(width, head);
  put_word(height, head);
  head.insert(head.end(), {kind.depth, kind.type, 0, 0, kind.interlaced});
  put_chunk("IHDR", head, out);
  if (kind.type == palette) {
    Bytes colors = rows_of(3 << kind.depth, 1, 8, state);
    colors.erase(colors.begin()); // the filter
    put_chunk("PLTE", colors, out);
  }
  if (kind.has_transparent_color) put_chunk("tRNS", Bytes(kind.type == palette ? 1 : 2, 0), out);
  const auto size = static_cast<unsigned>(rows.size());
  Bytes stored{0x78,
               1,
               1,
               static_cast<unsigned char>(size),
               static_cast<unsigned char>(size >> 8U),
               static_cast<unsigned char>(~size),
               static_cast<unsigned char>(~size >> 8U)};
  stored.insert(stored.end(), rows.begin(), rows.end());
  put_word(adler32(rows.data(), rows.size()), stored);
  put_chunk("IDAT", stored, out);
  put_chunk("IEND", {}, out);
  return out;
}

std::string words(const Kind& kind) {
  return "type " + std::to_string(kind.type) + ", " + std::to_string(kind.depth) + " bits" +
         (kind.interlaced ? ", interlaced" : "");
}

TEST(PngJpeg, PngsAreReadAsByOpenImageIO) {
  for (const Kind kind : {Kind{grey, 8},
                          Kind{grey_alpha, 8},
                          Kind{rgb, 8},
                          Kind{rgba, 8},
                          Kind{palette, 8},
                          Kind{palette, 4},
                          Kind{palette, 1},
                          Kind{rgb, 8, true},
                          Kind{grey_alpha, 8, true},
                          Kind{grey, 1},
                          Kind{grey, 4},
                          Kind{grey, 16},
                          Kind{grey_alpha, 16},
                          Kind{rgb, 16},
                          Kind{rgba, 16},
                          Kind{rgba, 16, true},
                          Kind{grey, 8, false, true},
                          Kind{grey, 16, false, true},
                          Kind{palette, 8, false, true},
                          Kind{palette, 2, true, true}})
    expect_as_by_openimageio("png", png_of(kind), words(kind));
}

TEST(PngJpeg, LargerPngsThanAllowedAreRefused) {
  EXPECT_FALSE(decoded_here("png", png_of({rgb, 16}), 16 * 13 * 11 - 1).has_value());
  EXPECT_TRUE(decoded_here("png", png_of({rgb, 16}), 16 * 13 * 11).has_value());
  EXPECT_FALSE(decoded_here("png", png_of({rgb, 8}), 4 * 13 * 11 - 1).has_value());
  EXPECT_TRUE(decoded_here("png", png_of({rgb, 8}), 4 * 13 * 11).has_value());
}

// One byte changed anywhere between the head and the end, or the rest missing.
TEST(PngJpeg, DamagedPngsAreNoticed) {
  const Bytes whole = png_of({rgb, 8});
  for (std::size_t i = 0; i < whole.size() - 12; ++i) {
    Bytes changed = whole;
    changed[i] ^= 0x41U;
    EXPECT_FALSE(decoded_here("png", changed).has_value()) << i;
    EXPECT_FALSE(decoded_here("png", Bytes(whole.begin(), whole.begin() + static_cast<long>(i))).has_value());
  }
}

TEST(PngJpeg, JpegsAreReadAsByOpenImageIO) {
  std::vector<float> picture(3 * 40 * 24);
  for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = static_cast<float>(i * i % 251) / 251.0F;
  const Bytes whole = encode_image("jpg", picture, 40, 24, 1);
  expect_as_by_openimageio("jpeg", whole, "40 x 24");
  for (std::size_t size = 0; size < whole.size() - 2; size += 3)
    EXPECT_FALSE(
        decoded_here("jpeg", Bytes(whole.begin(), whole.begin() + static_cast<long>(size))).has_value())
        << size;
}

TEST(PngJpeg, RealJpegsAreReadAsByOpenImageIO) {
  const char* const models = std::getenv("FASTRT_MODELS");
  if (models == nullptr) GTEST_SKIP() << "FASTRT_MODELS is not set";
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".jpg" && extension != ".JPG") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const Bytes bytes{std::istreambuf_iterator<char>(file), {}};
    if (bytes.size() < 3 || bytes[0] != 0xFF || bytes[1] != 0xD8) continue;
    expect_as_by_openimageio("jpeg", bytes, entry.path().string());
    ++count;
  }
  EXPECT_GT(count, 0);
}

} // namespace
} // namespace fastrt::test
