// SPDX-License-Identifier: Apache-2.0
// The formats besides PNG: what is in the file, and that OpenImageIO reads the same picture back.
#include "src/film/srgb.hpp"
#include "tests/unit/image_pictures.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <thread>

namespace fastrt {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<unsigned char>;

// A folder that goes with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("fastrt-formats-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

TestPicture read_back(const fs::path& file) {
  using Read = std::size_t(const char*, float*, std::size_t, int*, int*);
  const fs::path module = fs::read_symlink("/proc/self/exe").parent_path() / "oiio_reader.so";
  void* library = dlopen(module.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  auto* read = reinterpret_cast<Read*>(dlsym(library, "read_picture"));
  TestPicture picture{"read", 0, 0, {}};
  picture.rgb.resize(read(file.c_str(), nullptr, 0, &picture.width, &picture.height));
  const std::size_t count =
      read(file.c_str(), picture.rgb.data(), picture.rgb.size(), &picture.width, &picture.height);
  EXPECT_EQ(count, picture.rgb.size());
  return picture;
}

class Formats : public testing::TestWithParam<const char*> {};

TEST_P(Formats, ComeBackAsTheyWent) {
  const std::string format = GetParam();
  const Folder folder;
  const fs::path file = folder.path / ("picture." + format);
  for (const TestPicture& picture :
       {ball_picture(120, 90), noise_picture(37, 53), flat_picture(1, 1, 0.25F)}) {
    SCOPED_TRACE(picture.name);
    write_image(file, picture.rgb, picture.width, picture.height);
    const TestPicture back = read_back(file);
    ASSERT_EQ(back.width, picture.width);
    ASSERT_EQ(back.height, picture.height);
    ASSERT_EQ(back.rgb.size(), picture.rgb.size());
    Bytes codes(picture.rgb.size());
    to_srgb8(picture.rgb.data(), codes.size(), codes.data());
    const bool is_jpeg = format == "jpg" || format == "jpeg";
    if (is_jpeg && picture.name == "noise") continue; // not made for that
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (format == "exr" || format == "pfm") {
        ASSERT_EQ(back.rgb[i], picture.rgb[i]) << i;
      } else if (format == "hdr") { // eight bits, scaled by the pixel's largest value
        ASSERT_NEAR(back.rgb[i], picture.rgb[i], 1.0F / 128) << i;
      } else {
        ASSERT_NEAR(255 * back.rgb[i], codes[i], is_jpeg ? 40 : 1e-3) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Formats,
                         testing::Values("png", "ppm", "exr", "jpg", "jpeg", "tif", "tiff", "hdr"),
                         [](const auto& format) { return std::string(format.param); });

TEST(Ppm, IsAHeaderAndTheCodes) {
  const std::vector<float> rgb = {0, 0.18F, 1, 2, -1, 0.5F};
  const Bytes file = encode_image("ppm", rgb, 2, 1);
  const std::string header = "P6\n2 1\n255\n";
  ASSERT_EQ(file.size(), header.size() + 6);
  EXPECT_EQ(std::memcmp(file.data(), header.data(), header.size()), 0);
  EXPECT_EQ(Bytes(file.end() - 6, file.end()), (Bytes{0, 118, 255, 255, 0, 188}));
}

TEST(Pfm, IsAHeaderAndTheRowsFromTheBottom) {
  const std::vector<float> rgb = {1, 2, 3, 4, 5, 6e30F};
  const Bytes file = encode_image("pfm", rgb, 1, 2);
  const std::string header = "PF\n1 2\n-1.0\n";
  ASSERT_EQ(file.size(), header.size() + 24);
  EXPECT_EQ(std::memcmp(file.data(), header.data(), header.size()), 0);
  const float expected[] = {4, 5, 6e30F, 1, 2, 3};
  EXPECT_EQ(std::memcmp(file.data() + header.size(), expected, sizeof expected), 0);
}

// Numbers of arbitrary bits become no smaller: such rows are stored as they are.
TEST(Exr, KeepsEveryBitOfRowsThatDoNotCompress) {
  constexpr int width = 50, height = 40; // of three chunks of 16 rows, one is not full
  TestPicture picture = flat_picture(width, height, 0.0F);
  std::mt19937 random(5);
  for (float& value : picture.rgb)
    value = std::bit_cast<float>(static_cast<std::uint32_t>(random()) & 0xBFFFFFFFU); // all finite
  const Folder folder;
  const fs::path file = folder.path / "bits.exr";
  write_image(file, picture.rgb, width, height, 2);
  EXPECT_GT(fs::file_size(file), picture.rgb.size() * sizeof(float));
  const TestPicture back = read_back(file);
  ASSERT_EQ(back.rgb.size(), picture.rgb.size());
  EXPECT_EQ(std::memcmp(back.rgb.data(), picture.rgb.data(), picture.rgb.size() * sizeof(float)), 0);
}

TEST(Exr, CompressesRowsThatAreAlike) {
  const TestPicture ball = ball_picture(150, 500);
  EXPECT_LT(encode_image("exr", ball.rgb, 150, 500).size(), ball.rgb.size() * sizeof(float) * 2 / 3);
}

TEST(EncodeImage, GivesTheSameBytesEveryTime) {
  const TestPicture picture = ball_picture(150, 500);
  std::vector<Bytes> first;
  for (const std::string& format : image_extensions())
    first.push_back(encode_image(format, picture.rgb, 150, 500, 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // some writers would store the second
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_TRUE(encode_image(image_extensions()[i], picture.rgb, 150, 500, 3) == first[i])
        << image_extensions()[i];
}

TEST(EncodeImage, OfCodesGivesTheBytesOfTheLinearPicture) {
  const TestPicture picture = ball_picture(150, 300);
  Bytes codes(picture.rgb.size());
  to_srgb8(picture.rgb.data(), codes.size(), codes.data());
  int count = 0;
  for (const std::string& format : image_extensions()) {
    if (!is_8bit_format(format)) {
      EXPECT_THROW(encode_image(format, codes, 150, 300), UsageError) << format;
      continue;
    }
    ++count;
    EXPECT_TRUE(encode_image(format, codes, 150, 300, 2) == encode_image(format, picture.rgb, 150, 300, 1))
        << format;
  }
  EXPECT_EQ(count, 6);
  EXPECT_FALSE(is_8bit_format("bmp"));
}

TEST(EncodeImage, NamesItsFormats) {
  EXPECT_EQ(image_extensions(),
            (std::vector<std::string>{"png", "ppm", "pfm", "exr", "jpg", "jpeg", "tif", "tiff", "hdr"}));
}

TEST(EncodeImage, RefusesWhatMakesNoSense) {
  const std::vector<float> rgb(12);
  EXPECT_THROW(encode_image("bmp", rgb, 2, 2), UsageError);
  EXPECT_THROW(encode_image("", rgb, 2, 2), UsageError);
  EXPECT_THROW(encode_image("png", rgb, 3, 2), UsageError);
  EXPECT_THROW(encode_image("png", rgb, 0, 2), UsageError);
  EXPECT_THROW(encode_image("png", rgb, -2, -2), UsageError);
  const Bytes codes(12);
  EXPECT_THROW(encode_image("bmp", codes, 2, 2), UsageError);
  EXPECT_THROW(encode_image("png", codes, 3, 2), UsageError);
}

TEST(EncodeImage, RefusesWhatAFormatCannotHold) {
  const TestPicture wide = flat_picture(65501, 1, 0.5F);
  EXPECT_THROW(encode_image("jpg", wide.rgb, wide.width, wide.height), OutputError);
  EXPECT_FALSE(encode_image("png", wide.rgb, wide.width, wide.height).empty());
  EXPECT_THROW(check_picture_size("tif", 65536, 21363), OutputError);
  EXPECT_THROW(check_picture_size("tiff", 65536, 65536), OutputError);
  EXPECT_NO_THROW(check_picture_size("tiff", 21362, 65536));
  EXPECT_NO_THROW(check_picture_size("exr", 65536, 65536));
}

// TIFF's limit of pixels counts on it.
TEST(EncodeImage, NoiseGrowsByLessThanTwoPerCent) {
  std::mt19937 random(3);
  for (const int width : {700, 21800, 65536}) {
    Bytes codes(std::size_t{3} * 65536 * 16);
    codes.resize(codes.size() / (3 * static_cast<std::size_t>(width)) * 3 * static_cast<std::size_t>(width));
    for (unsigned char& code : codes) code = static_cast<unsigned char>(random());
    const int height = static_cast<int>(codes.size()) / (3 * width);
    EXPECT_LT(static_cast<double>(encode_image("tif", codes, width, height).size()),
              1.02 * static_cast<double>(codes.size()));
  }
}

TEST(EncodeImage, NumbersThatAreNoneDoNoHarm) {
  TestPicture picture = ball_picture(40, 30);
  picture.rgb[7] = std::numeric_limits<float>::quiet_NaN();
  picture.rgb[8] = std::numeric_limits<float>::infinity();
  picture.rgb[9] = -std::numeric_limits<float>::infinity();
  for (const std::string& format : image_extensions())
    EXPECT_FALSE(encode_image(format, picture.rgb, 40, 30).empty()) << format;
}

} // namespace
} // namespace fastrt
