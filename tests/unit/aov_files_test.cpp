// SPDX-License-Identifier: Apache-2.0
// AOVs in files, and the colours of the scene signature.
#include "src/film/frame.hpp"
#include "src/film/srgb.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace fastrt {
namespace {

namespace fs = std::filesystem;

int difference(const std::array<std::uint8_t, 3>& a, const std::array<std::uint8_t, 3>& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
}

TEST(SignatureColor, TheFirstAreFarApart) {
  for (std::uint32_t i = 0; i < 448; ++i) {
    EXPECT_GE(difference(signature_color(i), {0, 0, 0}), 120) << i;
    for (std::uint32_t k = 0; k < i; ++k)
      ASSERT_GE(difference(signature_color(i), signature_color(k)), i < 32 ? 72 : 36) << i << ' ' << k;
  }
}

TEST(SignatureColor, NoneComesTwice) {
  std::set<std::array<std::uint8_t, 3>> seen;
  for (std::uint32_t i = 0; i < 200000; ++i) seen.insert(signature_color(i));
  EXPECT_EQ(seen.size(), 200000U);
  EXPECT_FALSE(seen.contains({0, 0, 0}));
}

// They are promised to stay.
TEST(SignatureColor, IsFixed) {
  EXPECT_EQ(signature_color(0), (std::array<std::uint8_t, 3>{255, 255, 255}));
  EXPECT_EQ(signature_color(1), (std::array<std::uint8_t, 3>{218, 0, 255}));
  EXPECT_EQ(signature_color(2), (std::array<std::uint8_t, 3>{0, 255, 36}));
}

TEST(SignaturePicture, HasTheCodesAndABlackBackground) {
  const AovPlane ids{Aov::id, {}, {2, -1, 7}};
  const auto seven = signature_color(7);
  EXPECT_EQ(signature_picture(ids),
            (std::vector<unsigned char>{0, 255, 36, 0, 0, 0, seven[0], seven[1], seven[2]}));
}

TEST(Srgb, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code) {
    const float linear = linear_of_srgb8(static_cast<unsigned char>(code));
    unsigned char back = 0;
    to_srgb8(&linear, 1, &back);
    EXPECT_EQ(back, code);
  }
}

TEST(AovPicture, PacksIdsIntoCodes) {
  const AovPlane ids{Aov::primitive, {}, {-1, 0, 0x00FEDCBA}};
  EXPECT_EQ(aov_picture(ids), (std::vector<unsigned char>{0, 0, 0, 1, 0, 0, 0xBB, 0xDC, 0xFE}));
}

TEST(AovPicture, ShowsNumbersInTheirRange) {
  const auto codes_of = [](const AovPlane& plane) {
    const std::vector<unsigned char> codes = aov_picture(plane);
    return std::vector<int>(codes.begin(), codes.end());
  };
  EXPECT_EQ(codes_of({Aov::depth, {2, 4, infinity}, {}}),
            (std::vector<int>{255, 255, 255, 26, 26, 26, 0, 0, 0}));
  EXPECT_EQ(codes_of({Aov::depth, {1, 2, 1e9F}, {}}),
            (std::vector<int>{255, 255, 255, 140, 140, 140, 26, 26, 26}));
  EXPECT_EQ(codes_of({Aov::depth, {3, 3, infinity}, {}}),
            (std::vector<int>{255, 255, 255, 255, 255, 255, 0, 0, 0}));
  EXPECT_EQ(codes_of({Aov::normal, {0, 0, 1, 0, 0, 0}, {}}), (std::vector<int>{128, 128, 255, 0, 0, 0}));
  EXPECT_EQ(codes_of({Aov::cost, {}, {1, 5}}), (std::vector<int>{51, 51, 51, 255, 255, 255}));
  EXPECT_EQ(codes_of({Aov::shadow, {1, 0.5F, 0}, {}}), (std::vector<int>{255, 128, 0}));
  EXPECT_EQ(codes_of({Aov::uv, {0.5F, 3.25F}, {}}), (std::vector<int>{128, 64, 0}));
}

TEST(AovPicture, ShowsPositionsInTheirBox) {
  // The second pixel sees nothing.
  const AovPlane plane{Aov::position, {10, 1, -4, 0, 0, 0, 12, 1.5F, -2, 11, 3, -3}, {}};
  EXPECT_EQ(aov_picture(plane), (std::vector<unsigned char>{0, 0, 0, 0, 0, 0, 255, 64, 255, 128, 255, 128}));
}

// A floor up to its horizon, seen row by row, and what stands on it.
TEST(AovPicture, ShowsNearPositionsBeforeAHorizon) {
  constexpr int width = 640, height = 300;
  AovPlane plane{Aov::position, {}, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const float depth = 1e5F / (1.0F + 1000.0F * static_cast<float>(row));
      const bool is_tower = column < 40 && row < 200;
      const float side = 0.002F * static_cast<float>(column - width / 2);
      const float x = is_tower ? -0.3F : side * depth;
      const float y = is_tower ? 0.005F * static_cast<float>(200 - row) : 0.0F;
      for (const float value : {x, y, is_tower ? -0.5F : -depth}) plane.values.push_back(value);
    }
  const std::vector<unsigned char> codes = aov_picture(plane, 1);
  const auto code = [&](int row, int column, int channel) {
    return static_cast<int>(codes[static_cast<std::size_t>(3 * (width * row + column) + channel)]);
  };
  EXPECT_EQ(code(0, width - 1, 0), 255);                     // far to the right, and away:
  EXPECT_EQ(code(0, width - 1, 2), 0);                       // at the box's border
  EXPECT_EQ(code(0, 0, 1), 255);                             // the top of the tower
  EXPECT_GT(code(299, width - 1, 0), code(299, 50, 0) + 30); // from left to right
  EXPECT_GT(code(299, 600, 2), code(100, 600, 2) + 60);      // from near to far
  EXPECT_EQ(aov_picture(plane, 4), codes);
}

template <class Function>
Function* reader(const char* name) {
  const fs::path module = fs::read_symlink("/proc/self/exe").parent_path() / "oiio_reader.so";
  void* library = dlopen(module.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  return reinterpret_cast<Function*>(dlsym(library, name));
}

std::string read_attribute(const fs::path& file, const char* name) {
  using Read = int(const char*, const char*, char*, std::size_t);
  std::array<char, 256> text{};
  return reader<Read>("read_attribute")(file.c_str(), name, text.data(), text.size()) != 0 ? text.data() : "";
}

// One channel of a file by its name: its bits; false if there is none or it is of another type.
bool read_channel(const fs::path& file, const char* name, bool integer, std::vector<std::uint32_t>& bits) {
  using Read = int(const char*, const char*, int, std::uint32_t*, std::size_t);
  auto* read = reader<Read>("read_channel");
  return read(file.c_str(), name, integer ? 1 : 0, bits.data(), bits.size()) != 0;
}

TEST(EncodeLayers, HoldsEveryBitUnderItsName) {
  std::vector<Aov> aovs;
  for (std::size_t i = 0; i < aov_count; ++i) aovs.push_back(static_cast<Aov>(i));
  Frame frame = black_frame(3, 2, aovs);
  std::uint32_t next = 1;
  for (float& value : frame.rgb) value = static_cast<float>(++next) * 0.1F;
  for (AovPlane& plane : frame.aovs) {
    for (float& value : plane.values) value = static_cast<float>(++next) * 0.7F;
    for (std::int32_t& id : plane.ids)
      id = static_cast<std::int32_t>(++next) + 0x7654320F; // more than 24 bits
  }
  const fs::path file = fs::temp_directory_path() / ("fastrt-layers-" + std::to_string(getpid()) + ".exr");
  const std::vector<std::string> objects = {"floor", "two\nlines", ""};
  const std::vector<unsigned char> bytes = encode_layers(frame, objects, 2);
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::vector<std::uint32_t> bits(6);
  const char* const colors[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_TRUE(read_channel(file, colors[c], false, bits));
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(std::bit_cast<float>(bits[i]), frame.rgb[3 * i + c]);
  }
  for (const AovPlane& plane : frame.aovs) {
    const AovInfo& info = aov_info(plane.aov);
    const auto channels = static_cast<std::size_t>(info.channels);
    for (std::size_t c = 0; c < channels; ++c) {
      ASSERT_TRUE(read_channel(file, info.channel_names[c], info.integer, bits)) << info.channel_names[c];
      for (std::size_t i = 0; i < 6; ++i) {
        if (info.integer)
          EXPECT_EQ(bits[i], static_cast<std::uint32_t>(plane.ids[i]) + (plane.aov <= Aov::material ? 1 : 0));
        else
          EXPECT_EQ(std::bit_cast<float>(bits[i]), plane.values[channels * i + c]);
      }
    }
  }
  EXPECT_FALSE(read_channel(file, "nonsense", false, bits));
  EXPECT_EQ(read_attribute(file, "fastrt:objects"), "floor\ntwo lines\n\n");
  fs::remove(file);
}

std::array<int, 8> windows_of(const std::vector<unsigned char>& bytes) {
  const fs::path file = fs::temp_directory_path() / ("fastrt-windows-" + std::to_string(getpid()) + ".exr");
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  std::array<int, 8> windows{};
  EXPECT_NE(reader<int(const char*, int*)>("read_windows")(file.c_str(), windows.data()), 0);
  fs::remove(file);
  return windows;
}

TEST(EncodeLayers, SaysWhereACropLies) {
  Frame frame = black_frame(4, 40, {Aov::id});
  EXPECT_EQ(windows_of(encode_layers(frame)), (std::array<int, 8>{0, 0, 4, 40, 0, 0, 4, 40}));
  frame.x = 10;
  frame.y = 20;
  frame.whole_width = 64;
  frame.whole_height = 100;
  EXPECT_EQ(windows_of(encode_layers(frame)), (std::array<int, 8>{10, 20, 4, 40, 0, 0, 64, 100}));
}

TEST(EncodeLayers, RefusesFramesWithoutTheirPixels) {
  EXPECT_THROW(encode_layers(Frame{}), UsageError);
  Frame codes = black_frame(2, 2, {Aov::depth});
  codes.rgb = {};
  EXPECT_THROW(encode_layers(codes), UsageError);
  Frame short_plane = black_frame(2, 2, {Aov::depth});
  short_plane.aovs[0].values.resize(3);
  EXPECT_THROW(encode_layers(short_plane), UsageError);
  Frame unknown = black_frame(2, 2, {Aov::depth});
  unknown.aovs[0].aov = static_cast<Aov>(aov_count);
  EXPECT_THROW(encode_layers(unknown), UsageError);
}

// OpenEXR reports errors while it holds its own lock.
TEST(EncodeLayers, PassesOnWhatOpenExrSays) {
  Frame twice = black_frame(2, 2, {Aov::depth});
  twice.aovs.push_back(twice.aovs[0]);
  try {
    encode_layers(twice);
    ADD_FAILURE() << "two channels of one name were written";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("depth"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace fastrt
