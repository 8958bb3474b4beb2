// SPDX-License-Identifier: Apache-2.0
// Where pictures go: whole or not at all, and with a clear word when they can't.
#include "tests/unit/image_pictures.hpp"

#include <fastrt/error.hpp>
#include <fastrt/write.hpp>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

namespace fastrt {
namespace {

namespace fs = std::filesystem;

class ImageFile : public testing::Test {
protected:
  fs::path folder = fs::temp_directory_path() / ("fastrt-files-" + std::to_string(getpid()));
  TestPicture picture = ball_picture(60, 40);

  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  void write(const fs::path& path) const { write_image(path, picture.rgb, picture.width, picture.height); }
  std::string expected(const std::string& format) const {
    const auto bytes = encode_image(format, picture.rgb, picture.width, picture.height);
    return {bytes.begin(), bytes.end()};
  }
  static std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void put(const fs::path& path, const std::string& text) { std::ofstream(path) << text; }
  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  static mode_t mode(const fs::path& path) {
    struct stat info {};
    EXPECT_EQ(stat(path.c_str(), &info), 0);
    return info.st_mode & 07777U;
  }
  // What() of the OutputError, "" if there is none.
  template <class Action>
  static std::string output_error(Action action) {
    try {
      action();
    } catch (const OutputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(ImageFile, HoldsWhatEncodeImageGives) {
  write(folder / "a.png");
  EXPECT_EQ(content(folder / "a.png"), expected("png"));
  write(folder / "b.PPM"); // whatever the case
  EXPECT_EQ(content(folder / "b.PPM"), expected("ppm"));
  EXPECT_EQ(file_count(), 2U);
}

TEST_F(ImageFile, NewOnesFollowTheUmaskAndOldOnesKeepTheirMode) {
  const mode_t old = umask(027);
  write(folder / "new.png");
  umask(old);
  EXPECT_EQ(mode(folder / "new.png"), 0640U);
  put(folder / "old.png", "old");
  fs::permissions(folder / "old.png", fs::perms(0604));
  write(folder / "old.png");
  EXPECT_EQ(mode(folder / "old.png"), 0604U);
  EXPECT_EQ(content(folder / "old.png"), expected("png"));
}

TEST_F(ImageFile, LinksAreFollowed) {
  put(folder / "real.png", "old");
  fs::create_symlink("real.png", folder / "link.png");
  fs::create_symlink(folder / "later.png", folder / "dangling.png");
  write(folder / "link.png");
  write(folder / "dangling.png");
  EXPECT_TRUE(fs::is_symlink(folder / "link.png"));
  EXPECT_TRUE(fs::is_symlink(folder / "dangling.png"));
  EXPECT_EQ(content(folder / "real.png"), expected("png"));
  EXPECT_EQ(content(folder / "later.png"), expected("png"));
  fs::create_symlink("loop.png", folder / "loop.png");
  EXPECT_NE(output_error([&] { write(folder / "loop.png"); }), "");
}

TEST_F(ImageFile, DevicesAndPipesAreWrittenDirectly) {
  EXPECT_NO_THROW(check_image_path("/dev/null"));
  EXPECT_NO_THROW(write("/dev/null"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const fs::path pipe = folder / "pipe.ppm";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NO_THROW(check_image_path(pipe)); // does not wait for a reader
  std::string read;
  std::thread reader([&] { read = content(pipe); });
  write(pipe);
  reader.join();
  EXPECT_EQ(read, expected("ppm"));
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(ImageFile, AFullDiskIsReported) {
  const std::string error = output_error([&] { write("/dev/full"); });
  EXPECT_EQ(error, "cannot write '/dev/full': No space left on device");
}

TEST_F(ImageFile, AFailedWriteLeavesTheOldFile) {
  put(folder / "old.png", "old");
  picture = noise_picture(100, 100);
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small { 4096, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string error = output_error([&] { write(folder / "old.png"); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(error.find("old.png': File too large"), std::string::npos) << error;
  EXPECT_EQ(content(folder / "old.png"), "old");
  EXPECT_EQ(file_count(), 1U); // nothing else is left
}

TEST_F(ImageFile, PathsThatCannotBeWrittenAreToldBeforeAndAfter) {
  fs::create_directory(folder / "folder.png");
  put(folder / "file", "");
  const struct {
    fs::path path;
    const char* reason;
  } cases[] = {{folder / "missing" / "a.png", "No such file or directory"},
               {folder / "folder.png", "Is a directory"},
               {folder, "Is a directory"},
               {folder / "file" / "a.png", "Not a directory"},
               {folder / (std::string(300, 'a') + ".png"), "File name too long"}};
  for (const auto& c : cases) {
    const std::string reason = ": " + std::string(c.reason);
    const std::string before = output_error([&] { check_image_path(c.path); });
    EXPECT_NE(before.find(reason), std::string::npos) << before;
    const std::string after = output_error([&] { write(c.path); });
    EXPECT_NE(after.find(reason), std::string::npos) << after;
  }
  EXPECT_EQ(file_count(), 2U);
}

TEST_F(ImageFile, FoldersAndFilesWithoutPermissionAreRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  put(folder / "fixed.png", "old");
  fs::permissions(folder / "fixed.png", fs::perms(0400));
  EXPECT_NE(output_error([&] { check_image_path(folder / "fixed.png"); }).find("Permission denied"),
            std::string::npos);
  fs::permissions(folder, fs::perms(0500));
  EXPECT_NE(output_error([&] { check_image_path(folder / "a.png"); }).find("Permission denied"),
            std::string::npos);
  EXPECT_NE(output_error([&] { write(folder / "a.png"); }).find("Permission denied"), std::string::npos);
  fs::permissions(folder, fs::perms(0700));
}

TEST_F(ImageFile, ALongNameThatTheSystemTakesIsFine) {
  const fs::path path = folder / (std::string(251, 'a') + ".png");
  EXPECT_NO_THROW(check_image_path(path));
  write(path);
  EXPECT_EQ(content(path), expected("png"));
}

TEST_F(ImageFile, CheckingLeavesNothing) {
  put(folder / "old.png", "old");
  check_image_path(folder / "old.png");
  check_image_path(folder / "new.png");
  EXPECT_EQ(content(folder / "old.png"), "old");
  EXPECT_EQ(file_count(), 1U);
}

TEST_F(ImageFile, NamesWithoutAKnownExtensionAreRefused) {
  for (const char* name : {"a", "a.", "a.bmp", "png", ".png", "a.png.txt", "a.obj"}) {
    EXPECT_THROW(check_image_path(folder / name), UsageError) << name;
    EXPECT_THROW(write(folder / name), UsageError) << name;
  }
  EXPECT_THROW(check_image_path(""), UsageError);
  EXPECT_EQ(file_count(), 0U);
}

TEST_F(ImageFile, MessagesStayOneLine) {
  const std::string error = output_error([&] { check_image_path(folder / "a\n\x1b[31m" / "b.png"); });
  EXPECT_NE(error.find("a\\x0a\\x1b[31m/b.png"), std::string::npos) << error;
}

// A missing module names where it was looked for. In a program of its own, as the module is loaded once.
TEST_F(ImageFile, AMissingModuleIsReported) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto encode_elsewhere = [&](const char* format) {
    setenv("FASTRT_MODULE_PATH", "/nowhere", 1);
    const std::string error =
        output_error([&] { encode_image(format, picture.rgb, picture.width, picture.height); });
    std::fputs(error.c_str(), stderr);
    std::_Exit(error.empty() ? 1 : 0);
  };
  const testing::ExitedWithCode failed_well(0);
  EXPECT_EXIT(encode_elsewhere("hdr"), failed_well, "fastrt_oiio.so is in none of /nowhere");
  EXPECT_EXIT(encode_elsewhere("jpg"), failed_well, "fastrt_png_jpeg.so is in none of /nowhere");
  EXPECT_EXIT(encode_elsewhere("exr"), failed_well, "fastrt_openexr.so is in none of /nowhere");
}

} // namespace
} // namespace fastrt
