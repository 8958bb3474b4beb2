// SPDX-License-Identifier: Apache-2.0
#include "src/load/event_log.hpp"

#include "src/load/source.hpp"

#include <fastrt/diagnostics.hpp>
#include <fastrt/error.hpp>

#include <algorithm>
#include <array>

namespace fastrt {

namespace {

// Keywords and names that are warned about once each, per piece of a file: enough to show, bounded for a file
// that holds nothing else.
constexpr std::size_t most_keys = 1000;

std::string located(const Source& source, const Place& place, const std::string& message) {
  return InputError(source.name(), place.line, place.column, message).what();
}

} // namespace

bool EventLog::keeps(const char* kind) const {
  const auto found = counts_.find(kind);
  return found == counts_.end() || found->second < Diagnostics::kept_per_kind;
}

void EventLog::warn(std::uint64_t offset, const char* kind, std::string message) {
  if (keeps(kind)) events_.push_back({offset, false, false, kind, std::move(message)});
  ++counts_[kind];
}

void EventLog::warn_once(std::uint64_t offset, const char* kind, std::string_view key, std::string message) {
  if (keys_.size() >= most_keys || !keys_.emplace(kind, key).second) return;
  once_.push_back({{offset, false, false, kind, std::move(message)}, std::string(key)});
}

void EventLog::fail(std::uint64_t offset, std::string message) {
  failed_ = true;
  events_.push_back({offset, true, false, {}, std::move(message)});
}

void EventReport::take(EventLog log) {
  for (auto& once : log.once_)
    if (keys_.emplace(once.event.kind, std::move(once.key)).second) events_.push_back(std::move(once.event));
  for (auto& event : log.events_) events_.push_back(std::move(event));
  for (const auto& [kind, count] : log.counts_)
    if (count > Diagnostics::kept_per_kind) extra_[kind] += count - Diagnostics::kept_per_kind;
  for (const auto& [kind, count] : log.extra_) extra_[kind] += count;
}

void EventReport::sort() {
  const auto earlier = [](const Event& a, const Event& b) { return a.offset < b.offset; };
  std::stable_sort(events_.begin(), events_.end(), earlier);
}

// Only what will be shown needs a line number.
void EventReport::place(const Source& source, const std::vector<LineAnchor>& anchors) {
  std::map<std::string, std::size_t> shown;
  std::vector<std::uint64_t> offsets;
  std::vector<Event*> events;
  for (Event& event : events_) {
    if (event.placed || (!event.error && ++shown[event.kind] > Diagnostics::kept_per_kind)) continue;
    offsets.push_back(event.offset);
    events.push_back(&event);
  }
  const std::vector<Place> places = places_of(source, anchors, offsets);
  for (std::size_t i = 0; i < events.size(); ++i) {
    events[i]->message = located(source, places[i], events[i]->message);
    events[i]->placed = true;
  }
}

void EventReport::deliver(const Source& source, const std::vector<LineAnchor>& anchors, bool strict,
                          Diagnostics& diagnostics) {
  sort();
  const auto fatal = std::find_if(events_.begin(), events_.end(),
                                  [strict](const Event& event) { return strict || event.error; });
  if (fatal != events_.end()) {
    events_ = {std::move(*fatal)};
    place(source, anchors);
    throw InputError(events_.front().message);
  }
  place(source, anchors);
  for (const Event& event : events_) diagnostics.warn(event.kind, event.message);
  for (const auto& [kind, count] : extra_)
    for (std::size_t i = 0; i < count; ++i) diagnostics.warn(kind, {});
}

void EventReport::pass_on(const Source& source, EventLog& log, std::uint64_t offset) {
  sort();
  place(source, {});
  for (Event& event : events_) {
    event.offset = offset;
    log.failed_ = log.failed_ || event.error;
    log.events_.push_back(std::move(event));
  }
  for (const auto& [kind, count] : extra_) log.extra_[kind] += count;
}

namespace {

// Where a reader is that counts lines.
class LineCounter {
public:
  void step(char c) {
    if (c == '\n' || c == '\r') {
      line_ += c == '\n' && after_return_ ? 0 : 1;
      start_ = position_ + 1;
    }
    after_return_ = c == '\r';
    ++position_;
  }
  void jump(const LineAnchor& anchor) {
    position_ = start_ = anchor.offset;
    line_ = anchor.lines_before + 1;
    after_return_ = false;
  }
  std::uint64_t position() const { return position_; }
  Place place() const { return {line_, static_cast<std::size_t>(position_ - start_) + 1}; }

private:
  std::uint64_t position_ = 0, start_ = 0, line_ = 1;
  bool after_return_ = false;
};

} // namespace

std::vector<Place> places_of(const Source& source, const std::vector<LineAnchor>& anchors,
                             const std::vector<std::uint64_t>& offsets) {
  std::vector<Place> places(offsets.size());
  constexpr std::uint64_t piece = 4096;
  std::array<char, piece> bytes{};
  LineCounter counter;
  auto anchor = anchors.begin();
  try {
    for (std::size_t i = 0; i < offsets.size(); ++i) {
      const std::uint64_t offset = std::min(offsets[i], source.size());
      for (; anchor != anchors.end() && anchor->offset <= offset; ++anchor)
        if (anchor->offset >= counter.position()) counter.jump(*anchor);
      while (counter.position() < offset) {
        const std::uint64_t size = std::min(piece, offset - counter.position());
        source.read(counter.position(), bytes.data(), size);
        for (std::uint64_t k = 0; k < size; ++k) counter.step(bytes[k]);
      }
      places[i] = counter.place();
    }
  } catch (const InputError&) {
    // The file shrank meanwhile: the messages have to do without a place.
  }
  return places;
}

} // namespace fastrt
