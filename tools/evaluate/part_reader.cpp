#include "tools/evaluate/part_reader.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace puck {

PartReader::PartReader(std::unique_ptr<EventReader> events, const RecordingPart& part)
    : events_(std::move(events)) {
  if (!events_->read(early_, 1)) throw std::invalid_argument("the recording has no events");
  const Timestamp first = early_.newest();
  Timestamp last = first;
  begin_ = first + part.from_us;
  while (last < begin_) {
    if (!events_->read(early_, EventReader::kUsualEvents)) {
      char text[120];
      std::snprintf(
          text, sizeof text, "the recording is %.3f s long: nothing is left from %.3f s on",
          static_cast<double>(last - first) * 1e-6, static_cast<double>(part.from_us) * 1e-6);
      throw std::invalid_argument(text);
    }
    last = early_.newest();
  }
  const bool is_open = part.length_us > RecordingPart::kEnd - begin_.us;
  end_ = is_open ? Timestamp{RecordingPart::kEnd} : begin_ + part.length_us;
}

bool PartReader::read(EventPacket& packet, std::size_t max_events) {
  // An empty packet would end the part.
  do {
    if (!next(packet, max_events)) return false;
  } while (packet.newest() < begin_);
  const auto outside = [&](const Event& event) {
    const Timestamp time = packet.time_of(event);
    return time < begin_ || time >= end_;
  };
  std::erase_if(packet.events, outside);
  return !packet.empty();
}

bool PartReader::next(EventPacket& packet, std::size_t max_events) {
  if (early_.empty()) return events_->read(packet, max_events);
  packet.start = early_.start;
  const auto end = early_.events.begin() +
                   static_cast<std::ptrdiff_t>(std::min(max_events, early_.events.size()));
  packet.events.assign(early_.events.begin(), end);
  early_.events.erase(early_.events.begin(), end);
  return true;
}

void PartReader::rewind() {
  early_.events.clear();
  events_->rewind();
}

}  // namespace puck
