#include "services/camera/file_source.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace puck {
namespace {

// Saturates.
Timestamp later(Timestamp time, std::int64_t us) {
  const bool is_open = us > FileSourceParams::kToEnd - std::max<std::int64_t>(0, time.us);
  return is_open ? Timestamp{FileSourceParams::kToEnd} : time + us;
}

}  // namespace

FileSource::FileSource(const FileSourceParams& params)
    : FileSource(params, open_event_file(params.file, params.options)) {}

FileSource::FileSource(const FileSourceParams& params, std::unique_ptr<EventReader> reader)
    : params_(params), reader_(std::move(reader)) {
  if (params_.loop || params_.rate_mev_s > 0) measure();
}

// Length and density of the part.
void FileSource::measure() {
  EventPacket packet;
  std::int64_t events = 0;
  while (read(packet, kChunkEvents)) {
    if (packet.start >= part_end_) break;
    cut(packet);
    events += static_cast<std::int64_t>(packet.events.size());
  }
  last_ = newest_;
  const Timestamp begin = std::max(first_, part_begin_);
  const double span_us = static_cast<double>(*last_ - begin);
  if (events < 2 || span_us <= 0) {
    throw EventFileError(params_.file.string() +
                         ": too short to be looped or brought to another rate; expected two events "
                         "at different times in the played part");
  }
  const double recorded_gap_us = span_us / static_cast<double>(events);
  if (params_.rate_mev_s > 0) stretch_ = 1 / (params_.rate_mev_s * recorded_gap_us);
  mean_gap_us_ = std::max<std::int64_t>(1, std::llround(recorded_gap_us * stretch_));
  reader_->rewind();
  events_read_ = 0;
}

bool FileSource::read(EventPacket& packet, std::size_t most) {
  if (!reader_->read(packet, most)) return false;
  events_read_ += static_cast<std::int64_t>(packet.events.size());
  if (!std::exchange(has_first_, true)) {
    first_ = packet.time_of(packet.events.front());
    part_begin_ = later(first_, params_.start_us);
    part_end_ = later(part_begin_, params_.length_us);
    from_ = part_begin_;
  }
  if (packet.start < part_end_) newest_ = std::min(packet.newest(), part_end_ - 1);
  return true;
}

// Gives what was read last again, if it holds the place of the search.
bool FileSource::read_next(EventPacket& packet) {
  if (!std::exchange(repeats_latest_, false)) {
    if (!read(packet, kChunkEvents)) return false;
    latest_ = packet;
    return true;
  }
  packet = latest_;
  return true;
}

EventSource::Outcome FileSource::next(Chunk& chunk) {
  chunk.session_from.reset();
  if (task_ == Task::kReturn) return return_on(chunk.packet);
  EventPacket& packet = chunk.packet;
  if (!read_next(packet) || packet.time_of(packet.events.front()) >= part_end_) {
    return end_of_part(chunk);
  }
  cut(packet);
  if (packet.empty()) return Outcome::kNothingYet;
  const bool is_found = std::exchange(task_, Task::kPlay) == Task::kSearch;
  if (is_found) time_ = {};
  const std::int64_t session = std::exchange(session_number_, reader_->session_number());
  const bool has_changed = session != session_number_;
  place(chunk);
  chunk.until = chunk.packet.newest();
  if (is_found) {
    chunk.session_from = std::min(stretched(from_), chunk.packet.start);
  } else if (has_changed) {
    chunk.session_from = chunk.packet.start;
  }
  return Outcome::kEvents;
}

EventSource::Outcome FileSource::end_of_part(Chunk& chunk) {
  const bool is_empty = !has_first_ || newest_ < part_begin_;
  if (is_empty && has_first_ && task_ == Task::kPlay) {
    char text[160];
    std::snprintf(
        text, sizeof text, ": is %.3f s long: nothing is left from %.3f s on (camera.start_s)",
        static_cast<double>(newest_ - first_) * 1e-6, static_cast<double>(params_.start_us) * 1e-6);
    throw EventFileError(params_.file.string() + text);
  }
  if (has_first_) last_ = newest_;
  if (task_ == Task::kSearch) {
    if (!go_to_start()) return Outcome::kEnd;
    task_ = Task::kReturn;
    return return_on(chunk.packet);
  }
  if (!params_.loop || is_empty || !go_to_start()) return Outcome::kEnd;
  from_ = part_begin_;
  time_.begin_new_clock(mean_gap_us_);
  return next(chunk);
}

// Reads on, to where the source was before a search that failed.
EventSource::Outcome FileSource::return_on(EventPacket& packet) {
  const auto left = static_cast<std::size_t>(return_to_ - events_read_);
  if (left > 0 && read(packet, std::min(left, kChunkEvents))) {
    latest_ = packet;
    if (events_read_ < return_to_) return Outcome::kNothingYet;
  }
  task_ = Task::kPlay;
  from_ = part_begin_;
  session_number_ = reader_->session_number();
  return Outcome::kNotFound;
}

ControlVerdict FileSource::seek(std::int64_t position_us) {
  if (!has_first_) return ControlVerdict::kNotBegun;
  const Timestamp place = std::max(later(first_, position_us), part_begin_);
  if (place >= part_end_ || (last_ && place > *last_)) return ControlVerdict::kBeyondEnd;
  const std::int64_t was_at = task_ == Task::kPlay ? events_read_ : return_to_;
  const bool is_in_latest = !latest_.empty() && place >= latest_.time_of(latest_.events.front());
  if (is_in_latest) {
    repeats_latest_ = place <= latest_.newest();
  } else if (place <= newest_ && !go_to_start()) {
    return ControlVerdict::kReadOnlyOnce;
  }
  return_to_ = was_at;
  from_ = place;
  task_ = Task::kSearch;
  return ControlVerdict::kSearching;
}

// False for a pipe, which then stays where it is. Throws EventFileError if a file cannot be read
// again.
bool FileSource::go_to_start() {
  if (!reader_->can_rewind()) return false;
  const EventCounters counters = reader_->counters();
  reader_->rewind();
  dropped_before_ += counters.dropped();
  malformed_before_ += counters.malformed_words;
  events_read_ = 0;
  latest_.events.clear();
  repeats_latest_ = false;
  return true;
}

std::int64_t FileSource::position_us(Timestamp time) const {
  const auto after_us = static_cast<double>(time_.original(time) - first_);
  return std::llround(after_us / stretch_);
}

// To the events that are to be played.
void FileSource::cut(EventPacket& packet) const {
  if (packet.time_of(packet.events.front()) >= from_ && packet.newest() < part_end_) return;
  std::erase_if(packet.events, [&](const Event& event) {
    const Timestamp time = packet.time_of(event);
    return time < from_ || time >= part_end_;
  });
  if (packet.empty()) return;
  const std::uint32_t cut_us = packet.events.front().offset_us;
  packet.start = packet.start + cut_us;
  for (Event& event : packet.events) event.offset_us -= cut_us;
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
