// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>

namespace fastrt {

// Bytes to be read in pieces, from several threads at once: a regular file, or text in memory. A file is read
// with pread and not mapped: one that shrinks meanwhile is an error then, not a SIGBUS.
class Source {
public:
  // Throws InputError if the file can't be opened or is no regular one.
  static Source open(const std::filesystem::path& path);
  // The text must outlive the source.
  static Source memory(std::string_view text, std::string name);
  Source(Source&& other) noexcept;
  Source& operator=(Source&&) = delete;
  ~Source();

  const std::string& name() const noexcept { return name_; }
  std::uint64_t size() const noexcept { return size_; }
  // Copies the bytes offset .. offset + size, which must lie inside. Throws InputError if they can't be read
  // or are no longer there.
  void read(std::uint64_t offset, char* target, std::size_t size) const;
  // Throws InputError if the file has been written to since it was opened.
  void check_unchanged() const;
  // The same, said by whoever found it out.
  [[noreturn]] void fail_changed() const;

private:
  Source() = default;

  std::string name_;
  std::uint64_t size_ = 0;
  const char* text_ = nullptr;
  int file_ = -1;
  std::timespec modified_{};
};

} // namespace fastrt
