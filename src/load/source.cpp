// SPDX-License-Identifier: Apache-2.0
#include "src/load/source.hpp"

#include "src/load/text.hpp"

#include <fastrt/error.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace fastrt {

namespace {

std::string reason() { return std::generic_category().message(errno); }

} // namespace

Source Source::open(const std::filesystem::path& path) {
  Source source;
  source.name_ = path.string();
  // Without O_NONBLOCK a FIFO that nobody writes to would hold us here.
  source.file_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (source.file_ < 0) throw InputError("cannot open " + in_quotes(source.name_) + ": " + reason());
  struct stat status {};
  if (::fstat(source.file_, &status) != 0)
    throw InputError("cannot read " + in_quotes(source.name_) + ": " + reason());
  if (S_ISDIR(status.st_mode))
    throw InputError("cannot read " + in_quotes(source.name_) + ": it is a directory");
  if (!S_ISREG(status.st_mode))
    throw InputError("cannot read " + in_quotes(source.name_) + ": not a regular file");
  source.size_ = static_cast<std::uint64_t>(status.st_size);
  source.modified_ = status.st_mtim;
  return source;
}

Source Source::memory(std::string_view text, std::string name) {
  Source source;
  source.name_ = std::move(name);
  source.size_ = text.size();
  source.text_ = text.data();
  return source;
}

Source::Source(Source&& other) noexcept
    : name_(std::move(other.name_)), size_(other.size_), text_(other.text_),
      file_(std::exchange(other.file_, -1)), modified_(other.modified_) {}

Source::~Source() {
  if (file_ >= 0) ::close(file_);
}

void Source::read(std::uint64_t offset, char* target, std::size_t size) const {
  if (file_ < 0) {
    if (size != 0) std::memcpy(target, text_ + offset, size);
    return;
  }
  while (size != 0) {
    const ssize_t got = ::pread(file_, target, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw InputError("cannot read " + in_quotes(name_) + ": " + reason());
    if (got == 0) fail_changed();
    target += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
}

void Source::check_unchanged() const {
  if (file_ < 0) return;
  struct stat status {};
  if (::fstat(file_, &status) != 0) return;
  const bool same = static_cast<std::uint64_t>(status.st_size) == size_ &&
                    status.st_mtim.tv_sec == modified_.tv_sec && status.st_mtim.tv_nsec == modified_.tv_nsec;
  if (!same) fail_changed();
}

void Source::fail_changed() const { throw InputError(in_quotes(name_) + " changed while it was being read"); }

} // namespace fastrt
