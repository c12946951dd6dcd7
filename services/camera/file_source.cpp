#include "services/camera/file_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace puck {

FileSource::FileSource(const FileSourceParams& params)
    : FileSource(params, open_event_file(params.file, params.options)) {}

FileSource::FileSource(const FileSourceParams& params, std::unique_ptr<EventReader> reader)
    : params_(params), reader_(std::move(reader)) {
  if (params_.loop || params_.rate_mev_s > 0) measure();
}

// Length and density of the recording.
void FileSource::measure() {
  EventPacket packet;
  std::int64_t events = 0;
  Timestamp last;
  while (reader_->read(packet, kChunkEvents)) {
    if (events == 0) first_ = packet.time_of(packet.events.front());
    last = packet.newest();
    events += static_cast<std::int64_t>(packet.events.size());
  }
  reader_->rewind();
  const double span_us = static_cast<double>(last - first_);
  if (events < 2 || span_us <= 0) {
    throw EventFileError(params_.file.string() +
                         ": too short to be looped or brought to another rate; expected two events "
                         "at different times");
  }
  const double recorded_gap_us = span_us / static_cast<double>(events);
  if (params_.rate_mev_s > 0) stretch_ = 1 / (params_.rate_mev_s * recorded_gap_us);
  mean_gap_us_ = std::max<std::int64_t>(1, std::llround(recorded_gap_us * stretch_));
}

EventSource::Outcome FileSource::next(Chunk& chunk) {
  if (!reader_->read(chunk.packet, kChunkEvents)) {
    if (!params_.loop || !begin_again() || !reader_->read(chunk.packet, kChunkEvents)) {
      return Outcome::kEnd;
    }
  }
  place(chunk);
  chunk.until = chunk.packet.newest();
  return Outcome::kEvents;
}

bool FileSource::begin_again() {
  if (reader_->counters().events == 0) return false;
  dropped_before_ += reader_->counters().dropped();
  malformed_before_ += reader_->counters().malformed_words;
  reader_->rewind();
  time_.begin_new_clock(mean_gap_us_);
  return true;
}

void FileSource::place(Chunk& chunk) {
  EventPacket& packet = chunk.packet;
  const Timestamp old_start = packet.start;
  const Timestamp old_newest = packet.newest();
  packet.start = time_.place(stretched(old_start));
  if (stretch_ != 1) {
    const Timestamp new_start = stretched(old_start);
    for (Event& event : packet.events) {
      const std::int64_t offset_us = stretched(old_start + event.offset_us) - new_start;
      // The offset of an event is limited to that of a packet, 71 minutes.
      event.offset_us = static_cast<std::uint32_t>(
          std::min<std::int64_t>(offset_us, std::numeric_limits<std::uint32_t>::max()));
    }
  }
  time_.place(stretched(old_newest));
}

Timestamp FileSource::stretched(Timestamp time) const {
  if (stretch_ == 1) return time;
  // Rounds to nearest, since no time is before the first; std::llround is not inlined.
  return first_ + static_cast<std::int64_t>(static_cast<double>(time - first_) * stretch_ + 0.5);
}

std::int64_t FileSource::events_dropped() const {
  return dropped_before_ + reader_->counters().dropped();
}

std::int64_t FileSource::malformed_words() const {
  return malformed_before_ + reader_->counters().malformed_words;
}

}  // namespace puck
