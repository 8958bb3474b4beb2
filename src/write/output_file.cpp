// SPDX-License-Identifier: Apache-2.0
#include "src/write/output_file.hpp"

#include "src/scene/printable.hpp"
#include "src/write/descriptor_name.hpp"

#include <fastrt/error.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

namespace fastrt {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw OutputError("cannot write '" + printable(path.string()) +
                    "': " + std::generic_category().message(error));
}

// Where the bytes go, and how.
struct Target {
  fs::path path; // no link
  bool exists = false;
  bool direct = false;
  int descriptor = -1; // of a name that stands for one
  mode_t mode = 0;
};

// Links to open files of other processes, which name no place where a file could be put.
bool is_open_file(const fs::path& path) { return path.native().starts_with("/proc/"); }

Target resolve(const fs::path& path) {
  constexpr int most_links = 40;
  Target target{path};
  struct stat info {};
  for (int links = 0;; ++links) {
    target.descriptor = descriptor_named(target.path);
    if (target.descriptor >= 0) {
      target.exists = target.direct = true;
      return target;
    }
    if (lstat(target.path.c_str(), &info) != 0) {
      if (errno != ENOENT) fail(path, errno);
      return target; // may still be made, unless its folder is missing
    }
    if (is_open_file(target.path) && stat(target.path.c_str(), &info) != 0) fail(path, errno);
    if (!S_ISLNK(info.st_mode)) break;
    if (links == most_links) fail(path, ELOOP);
    std::error_code error;
    const fs::path next = fs::read_symlink(target.path, error);
    if (error) fail(path, error.value());
    target.path = target.path.parent_path() / next;
  }
  if (S_ISDIR(info.st_mode)) fail(path, EISDIR);
  target.exists = true;
  target.direct = !S_ISREG(info.st_mode) || is_open_file(target.path);
  target.mode = info.st_mode & 07777U;
  return target;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// A file that is being written: closed, and removed if it was made here and not kept.
class OpenFile {
public:
  OpenFile(fs::path path, int descriptor, bool temporary)
      : path_(std::move(path)), descriptor_(descriptor), temporary_(temporary) {}
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (temporary_) ::unlink(path_.c_str());
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  const fs::path& path() const { return path_; }
  int descriptor() const { return descriptor_; }
  void keep() { temporary_ = false; }
  // 0 or the error; these also come late, when the system finds no room.
  int close() { return ::close(std::exchange(descriptor_, -1)) == 0 || errno == EINTR ? 0 : errno; }

private:
  fs::path path_;
  int descriptor_;
  bool temporary_;
};

// A new file beside `target`; its short name of its own fits wherever the target's does.
OpenFile open_temporary(const fs::path& shown, const fs::path& target) {
  static std::atomic<unsigned> count{0};
  for (int attempt = 0;; ++attempt) {
    fs::path path = folder_of(target) / (".fastrt-" + std::to_string(getpid()) + "-" +
                                         std::to_string(count.fetch_add(1)) + ".tmp");
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {std::move(path), descriptor, true};
    if (errno != EEXIST || attempt == 1000) fail(shown, errno);
  }
}

OpenFile open_directly(const fs::path& shown, const Target& target) {
  const int descriptor = target.descriptor >= 0 ? ::fcntl(target.descriptor, F_DUPFD_CLOEXEC, 0)
                                                : ::open(target.path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (descriptor < 0) fail(shown, errno);
  return {target.path, descriptor, false};
}

// Of descriptors that the caller made so that they don't wait.
void wait_for_room(int descriptor) {
  pollfd waiting{descriptor, POLLOUT, 0};
  ::poll(&waiting, 1, -1);
}

// 0 or the error.
int write_all(int descriptor, const unsigned char* bytes, std::size_t count) {
  constexpr std::size_t most = std::size_t{1} << 30U; // one call takes less than 2 GiB
  while (count != 0) {
    const ssize_t written = ::write(descriptor, bytes, std::min(count, most));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EAGAIN) {
      wait_for_room(descriptor);
      continue;
    }
    if (written <= 0) return written < 0 ? errno : EIO;
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
  return 0;
}

// Some file systems know no sync; that is no failure.
int sync(int descriptor) {
  if (::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS) return 0;
  return errno;
}

void write_directly(const fs::path& shown, const Target& target, const unsigned char* bytes,
                    std::size_t count) {
  OpenFile file = open_directly(shown, target);
  int error = write_all(file.descriptor(), bytes, count);
  const int close_error = file.close();
  if (error == 0) error = close_error;
  if (error != 0) fail(shown, error);
}

// Beside its place and then into it. False for a place that can't be taken: a file that is mounted alone.
bool put_whole(const fs::path& shown, const Target& target, const unsigned char* bytes, std::size_t count) {
  OpenFile file = open_temporary(shown, target.path);
  int error = write_all(file.descriptor(), bytes, count);
  if (error == 0 && target.exists && ::fchmod(file.descriptor(), target.mode) != 0) error = errno;
  if (error == 0) error = sync(file.descriptor());
  const int close_error = file.close();
  if (error == 0) error = close_error;
  if (error != 0) fail(shown, error);
  if (::rename(file.path().c_str(), target.path.c_str()) != 0) {
    if (errno == EBUSY) return false;
    fail(shown, errno);
  }
  // The folder is not synced: after a power failure the place may hold what it held before, whole.
  file.keep();
  return true;
}

} // namespace

void check_writable(const fs::path& path) {
  const Target target = resolve(path);
  if (target.descriptor >= 0) {
    if (const int error = check_descriptor(target.descriptor); error != 0) fail(path, error);
    return;
  }
  if (target.exists && ::access(target.path.c_str(), W_OK) != 0) fail(path, errno);
  if (!target.direct) open_temporary(path, target.path); // made and removed
}

fs::path place_of(const fs::path& path) {
  const Target target = resolve(path);
  if (target.descriptor >= 0) return "/dev/fd/" + std::to_string(target.descriptor);
  std::error_code error;
  const fs::path folder = fs::canonical(folder_of(target.path), error);
  if (error) fail(path, error.value());
  return folder / target.path.filename();
}

void replace_file(const fs::path& path, const unsigned char* bytes, std::size_t count) {
  const Target target = resolve(path);
  if (target.direct || !put_whole(path, target, bytes, count)) write_directly(path, target, bytes, count);
}

} // namespace fastrt
