// SPDX-License-Identifier: Apache-2.0
// What is loaded for which pictures. In programs of their own, as modules stay loaded.
#include "src/load/texture_file.hpp"
#include "tests/unit/obj_test_support.hpp"

#include <fastrt/write.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace fastrt::test {
namespace {

// Ends the program: with 0 if `done` and `library` is loaded, but OpenImageIO is not.
[[noreturn]] void end_by_what_is_loaded(bool done, const char* library) {
  std::ifstream maps("/proc/self/maps");
  const std::string loaded{std::istreambuf_iterator<char>(maps), {}};
  const auto is_loaded = [&](const char* name) { return loaded.find(name) != std::string::npos; };
  std::_Exit(done && is_loaded(library) && !is_loaded("OpenImageIO") ? 0 : 1);
}

const std::vector<float> grey(3 * 8 * 8, 0.5F);

TEST(Modules, UsualTexturesDoNotLoadOpenImageIO) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  for (const std::string format : {"png", "jpg"}) {
    const TemporaryFolder folder;
    const std::vector<unsigned char> bytes = encode_image(format, grey, 8, 8, 1);
    const auto path = folder.write("t." + format, std::string(bytes.begin(), bytes.end()));
    const auto read = [&] {
      end_by_what_is_loaded(read_texture(path, TextureCode::color).image != nullptr, "libjpeg");
    };
    EXPECT_EXIT(read(), testing::ExitedWithCode(0), "") << format;
  }
}

TEST(Modules, JpegAndExrPicturesDoNotLoadOpenImageIO) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto write = [](const char* format, const char* library) {
    end_by_what_is_loaded(!encode_image(format, grey, 8, 8, 1).empty(), library);
  };
  EXPECT_EXIT(write("jpg", "libjpeg"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(write("exr", "libOpenEXRCore"), testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace fastrt::test
