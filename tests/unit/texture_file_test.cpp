// SPDX-License-Identifier: Apache-2.0
// Texture files of every format that is read, and broken ones.
#include "src/load/texture_file.hpp"
#include "src/modules/open.hpp"
#include "src/modules/pictures.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <fastrt/write.hpp>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <thread>

namespace fastrt::test {
namespace {

// Red, green; blue, white: rows from the top.
const std::vector<float> four_pixels{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};

void expect_four_pixels(const TextureFile& file, float tolerance, const std::string& what) {
  ASSERT_NE(file.image, nullptr) << what << ": " << file.fault;
  EXPECT_EQ(file.fault, "") << what;
  ASSERT_EQ(file.image->width(), 2) << what;
  ASSERT_EQ(file.image->height(), 2) << what;
  for (int i = 0; i < 4; ++i) {
    const glm::vec4 pixel = file.image->pixel(0, i % 2, i / 2);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(pixel[c], four_pixels[static_cast<std::size_t>(3 * i + c)], tolerance) << what << ' ' << i;
    EXPECT_EQ(pixel.a, 1.0F) << what;
  }
}

std::string text_of(const std::vector<unsigned char>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(TextureFile, EveryFormatThatIsWritten) {
  const TemporaryFolder folder;
  for (const std::string format : {"png", "ppm", "pfm", "exr", "hdr", "tif"}) {
    const auto path = folder.write("t." + format, text_of(encode_image(format, four_pixels, 2, 2, 1)));
    expect_four_pixels(read_texture(path, TextureCode::color), 0.01F, format);
  }
  // Blocks of 8 x 8 pixels make JPEG good at plain ones.
  const std::vector<float> grey(3 * 64, 0.5F);
  const TextureFile jpeg =
      read_texture(folder.write("t.jpg", text_of(encode_image("jpg", grey, 8, 8, 1))), TextureCode::color);
  ASSERT_NE(jpeg.image, nullptr) << jpeg.fault;
  EXPECT_NEAR(jpeg.image->pixel(0, 3, 3).g, 0.5F, 0.01F);
}

TEST(TextureFile, TargaAndBitmap) {
  const TemporaryFolder folder;
  std::string targa("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\x20", 18);
  targa += std::string("\0\0\xFF\0\xFF\0\xFF\0\0\xFF\xFF\xFF", 12);
  expect_four_pixels(read_texture(folder.write("t.tga", targa), TextureCode::color), 0, "tga");
  std::string bitmap("BM\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 30);
  bitmap += std::string(24, '\0');
  bitmap += std::string("\xFF\0\0\xFF\xFF\xFF\0\0\0\0\xFF\0\xFF\0\0\0", 16);
  expect_four_pixels(read_texture(folder.write("t.bmp", bitmap), TextureCode::color), 0, "bmp");
}

// The name's extension does not matter where the contents tell.
TEST(TextureFile, ContentsTellTheFormat) {
  const TemporaryFolder folder;
  const auto path = folder.write("t.png", text_of(encode_image("ppm", four_pixels, 2, 2, 1)));
  expect_four_pixels(read_texture(path, TextureCode::color), 0, "ppm");
}

TEST(TextureFile, DataIsNotDecoded) {
  const TemporaryFolder folder;
  const auto path = folder.write("t.pgm", std::string("P5 1 1 255\n\x80", 12));
  EXPECT_EQ(read_texture(path, TextureCode::data).image->pixel(0, 0, 0).g, 128.0F / 255);
  EXPECT_NEAR(read_texture(path, TextureCode::color).image->pixel(0, 0, 0).g, 0.2159, 1e-4);
}

TEST(TextureFile, BrokenFilesAreRefused) {
  const TemporaryFolder folder;
  const std::string png = text_of(encode_image("png", four_pixels, 2, 2, 1));
  std::string large_png = png;
  large_png[17] = large_png[21] = 1; // 65538 x 65538
  const std::pair<const char*, std::string> cases[] = {
      {"empty.png", ""},
      {"text.png", "this is no picture"},
      {"head.png", png.substr(0, 20)},
      {"large.png", large_png},
      {"large.ppm", "P6 2000000000 2000000000 255\n"},
      {"wide.ppm", "P6 16385 1 255\n" + std::string(3 * 16385, 'x')},
      {"large.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 100000 +X 100000\n"},
      {"none.ppm", "P6 0 0 255\n"},
      {"short.exr", "\x76\x2F\x31\x01"},
      {"short.jpg", "\xFF\xD8\xFF\xE0"},
      {"short.tif", std::string("II*\0\xFF\xFF\xFF\xFF", 8)}};
  for (const auto& [name, bytes] : cases) {
    const TextureFile file = read_texture(folder.write(name, bytes), TextureCode::color);
    EXPECT_EQ(file.image, nullptr) << name;
    EXPECT_NE(file.fault, "") << name;
  }
}

// Kinds that OpenImageIO would read or write out of bounds for, and a file of 79 bytes that asks for a
// gigabyte.
TEST(TextureFile, WhatOpenImageIOStumblesOverIsNotGivenToIt) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* name, const std::string& bytes) {
    const TextureFile file = read_texture(folder.write(name, bytes), TextureCode::color);
    EXPECT_EQ(file.image, nullptr) << name;
    EXPECT_NE(file.fault.find("can't be read"), std::string::npos) << name << ": " << file.fault;
  };
  const auto bmp = [](unsigned char header_size, unsigned char depth, unsigned char packing) {
    std::string bytes(14 + 128, '\0');
    bytes[0] = 'B', bytes[1] = 'M', bytes[10] = 14 + 108;
    bytes[14] = static_cast<char>(header_size);
    bytes[18] = bytes[22] = bytes[26] = 1; // a pixel
    bytes[28] = static_cast<char>(depth);
    bytes[30] = static_cast<char>(packing);
    return bytes;
  };
  EXPECT_NE(read_texture(folder.write("good.bmp", bmp(40, 24, 0)), TextureCode::color).image, nullptr);
  refused("packed.bmp", bmp(40, 24, 1));
  refused("halves.bmp", bmp(40, 8, 2));
  refused("header.bmp", bmp(64, 24, 0));
  refused("depth.bmp", bmp(40, 5, 0));
  refused("short.bmp", bmp(40, 24, 0).substr(0, 50));
  refused("palette.tga", std::string("\0\1\1\0\0\1\0\x18\0\0\0\0\1\0\1\0\x08\x20\xFF\xFF\xFF\x80", 22));
  refused("large.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\xFF\x3F\xFF\x3F\x18\x20", 18));
}

// What is there is used, and the rest is said to be missing; nothing ends the program.
TEST(TextureFile, TruncationAnywhereDoesNoHarm) {
  const TemporaryFolder folder;
  for (const std::string format : {"png", "jpg", "exr", "tif", "hdr", "ppm"}) {
    const std::string bytes = text_of(encode_image(format, std::vector<float>(3 * 256, 0.25F), 16, 16, 1));
    for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 37) {
      const TextureFile file =
          read_texture(folder.write("t." + format, bytes.substr(0, size)), TextureCode::color);
      EXPECT_TRUE(file.image != nullptr || !file.fault.empty()) << format << ' ' << size;
    }
  }
}

// The upper half of what is bright all over, and nothing but a fault where nothing could be read.
TEST(TextureFile, WhatIsThereOfADamagedPictureIsUsed) {
  const TemporaryFolder folder;
  for (const std::string format : {"png", "jpg", "exr"}) {
    std::vector<float> noise(3 * 128 * 128);
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = 0.5F + static_cast<float>(i * i % 251) / 512.0F;
    const std::string bytes = text_of(encode_image(format, noise, 128, 128, 1));
    testing::internal::CaptureStderr();
    const TextureFile half =
        read_texture(folder.write("t." + format, bytes.substr(0, bytes.size() / 2)), TextureCode::data);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << format;
    if (half.image == nullptr) {
      EXPECT_EQ(format, "exr");
      EXPECT_NE(half.fault.find("can't be read"), std::string::npos) << half.fault;
      continue;
    }
    EXPECT_NE(half.fault.find("is damaged"), std::string::npos) << half.fault;
    EXPECT_GT(half.image->pixel(0, 0, 0).r, 0.3F) << format;
    EXPECT_EQ(half.image->pixel(0, 0, 0).a, 1.0F) << format;
    EXPECT_EQ(half.image->pixel(0, 127, 127).a, 1.0F) << format;
  }
}

// libtiff says nothing of a strip without bytes, and OpenImageIO takes what it said last for the reason.
TEST(TextureFile, TheFaultOfATiffIsItsOwn) {
  const TemporaryFolder folder;
  constexpr int width = 256, height = 340; // two strips
  std::string bytes =
      text_of(encode_image("tif", std::vector<float>(3 * width * height, 0.5F), width, height, 1));
  const auto number_at = [&](std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, &bytes[at], sizeof number);
    return number;
  };
  constexpr std::size_t sizes_of_strips = 8; // among the fields of the directory
  bytes.replace(number_at(number_at(4) + 2 + 12 * sizes_of_strips + 8) + 4, 4, 4, '\0');
  const TextureFile other = read_texture(folder.write("a.tif", std::string("II*\0x", 5)), TextureCode::color);
  EXPECT_NE(other.fault.find("TIFF header"), std::string::npos) << other.fault;
  const TextureFile file = read_texture(folder.write("b.tif", bytes), TextureCode::color);
  EXPECT_NE(file.fault.find("is damaged"), std::string::npos) << file.fault;
  EXPECT_EQ(file.fault.find("TIFF header"), std::string::npos) << file.fault;
  ASSERT_NE(file.image, nullptr);
  EXPECT_GT(file.image->pixel(0, 0, 0).g, 0.4F);
  EXPECT_EQ(file.image->pixel(0, 0, height - 1).g, 0.0F);
}

// What may go wrong when OpenImageIO is first used goes wrong in few programs: so there are many.
TEST(TextureFile, TheFirstOnesAreReadAtOnce) {
  ASSERT_NE(find_oiio_function(oiio_decode_name).function, nullptr);
  const TemporaryFolder folder;
  const auto path = folder.write("t.ppm", text_of(encode_image("ppm", four_pixels, 2, 2, 1)));
  for (int program = 0; program < 200; ++program) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      std::atomic<int> read{0};
      std::vector<std::thread> threads;
      for (int i = 0; i < 8; ++i)
        threads.emplace_back(
            [&] { read += read_texture(path, TextureCode::color).image != nullptr ? 1 : 0; });
      for (std::thread& thread : threads) thread.join();
      _exit(read == 8 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0) << program;
  }
}

// One byte after the other changed: libpng would print what is wrong.
TEST(TextureFile, NothingIsPrinted) {
  const TemporaryFolder folder;
  const std::string bytes = text_of(encode_image("png", std::vector<float>(3 * 64, 0.25F), 8, 8, 1));
  testing::internal::CaptureStderr();
  for (std::size_t i = 8; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 0x24);
    read_texture(folder.write("t.png", changed), TextureCode::color);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(TextureFile, OnlyRegularFilesAreOpened) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder.path() / "fifo.png").c_str(), 0600), 0);
  for (const auto& path : {folder.path() / "fifo.png", folder.path(), folder.path() / "missing.png",
                           std::filesystem::path("/dev/zero")}) {
    const TextureFile file = read_texture(path, TextureCode::color);
    EXPECT_EQ(file.image, nullptr);
    EXPECT_NE(file.fault.find("can't be read"), std::string::npos) << file.fault;
  }
}

} // namespace
} // namespace fastrt::test
