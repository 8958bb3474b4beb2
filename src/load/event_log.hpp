// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fastrt {

class Diagnostics;
class Source;

// Something to say about a place in a file.
struct Event {
  std::uint64_t offset = 0; // in bytes, in the file being read
  bool error = false;
  bool placed = false; // the message names its place by itself: it is about another file
  std::string kind;    // of warnings
  std::string message;
};

// A place where a line begins, and how many lines lie before it.
struct LineAnchor {
  std::uint64_t offset;
  std::uint64_t lines_before;
};

// What was found wrong in one piece of a file, in the order of the file. Of a kind of warning only as many
// are kept as Diagnostics can show; the rest are counted.
class EventLog {
public:
  void warn(std::uint64_t offset, const char* kind, std::string message);
  // Only the first warning of each (kind, key) counts.
  void warn_once(std::uint64_t offset, const char* kind, std::string_view key, std::string message);
  void fail(std::uint64_t offset, std::string message);
  bool failed() const noexcept { return failed_; }
  // Whether one more warning of the kind would be kept: its place need not be sought otherwise.
  bool keeps(const char* kind) const;

private:
  friend class EventReport;
  struct Once {
    Event event;
    std::string key;
  };

  std::vector<Event> events_;
  std::vector<Once> once_;
  std::set<std::pair<std::string, std::string>> keys_;
  std::map<std::string, std::size_t> counts_;
  std::map<std::string, std::size_t> extra_; // of other files, counted only
  bool failed_ = false;
};

// The logs of all pieces of one file, put together.
class EventReport {
public:
  // In the order of the file.
  void take(EventLog log);
  // Throws InputError for the first error, or with `strict` for the first event; else hands the warnings to
  // `diagnostics`, each with file:line:column.
  void deliver(const Source& source, const std::vector<LineAnchor>& anchors, bool strict,
               Diagnostics& diagnostics);
  // Hands everything to the log of another file that refers to this one there, at `offset`.
  void pass_on(const Source& source, EventLog& log, std::uint64_t offset);

private:
  void sort();
  void place(const Source& source, const std::vector<LineAnchor>& anchors);

  std::vector<Event> events_;
  std::set<std::pair<std::string, std::string>> keys_;
  std::map<std::string, std::size_t> extra_;
};

struct Place {
  std::size_t line = 0, column = 0; // from 1; 0 when the file can't be read any more
};

// Lines and columns of ascending offsets, by reading the file from the last of the ascending anchors before
// each.
std::vector<Place> places_of(const Source& source, const std::vector<LineAnchor>& anchors,
                             const std::vector<std::uint64_t>& offsets);

} // namespace fastrt
