#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "common/events/event_bits.h"
#include "common/io/event_sink.h"

namespace puck {

/// An event as a file of whole records holds it, before any check.
struct EventRecord {
  std::int64_t t_us = 0;
  std::uint32_t x = 0;  ///< A negative number becomes a large one …
  std::uint32_t y = 0;  ///< … which lies outside every sensor.
  bool brighter = false;
};

/// Hands records to `sink` in a tight loop, up to the first that needs the checks of its `append`,
/// and no more than fit. `record_at(i)`: the i-th of `count` records. `scratch`: memory for a run.
/// Returns the number taken; at 0, give the first record to `append`.
template <typename RecordAt>
std::size_t take_record_run(EventSink& sink, std::span<Event> scratch, std::size_t count,
                            RecordAt record_at) {
  if (count == 0) return 0;
  const std::size_t room = sink.room_at({record_at(std::size_t{0}).t_us});
  if (room == 0) return 0;
  const std::size_t most = std::min({room, scratch.size(), count});
  const auto width = static_cast<std::uint32_t>(sink.sensor().width);
  const auto height = static_cast<std::uint32_t>(sink.sensor().height);
  const auto start_us = static_cast<std::uint64_t>(sink.packet_start().us);
  std::uint64_t newest_us =
      0;  // Since the packet's start; a time before it becomes a large number.
  std::size_t taken = 0;
  for (; taken < most; ++taken) {
    const EventRecord record = record_at(taken);
    const std::uint64_t offset_us = static_cast<std::uint64_t>(record.t_us) - start_us;
    if ((record.x >= width) | (record.y >= height) | (offset_us < newest_us) |
        (offset_us > std::numeric_limits<std::uint32_t>::max())) {
      break;
    }
    newest_us = offset_us;
    scratch[taken] = std::bit_cast<Event>(event_bits(record.x, record.y, record.brighter ? 1 : 0,
                                                     static_cast<std::uint32_t>(offset_us)));
  }
  sink.append_run(scratch.first(taken));
  return taken;
}

/// Hands records to `sink`: a run, or else the first of `count` (1 or more), which is checked.
/// Returns the number taken, at least 1.
template <typename RecordAt>
std::size_t take_records(EventSink& sink, std::span<Event> scratch, std::size_t count,
                         RecordAt record_at) {
  // Later times than any clock's, of damaged records: their differences would overflow.
  constexpr std::int64_t kLatest_us = std::int64_t{1} << 61;
  const std::size_t taken = take_record_run(sink, scratch, count, record_at);
  if (taken > 0) return taken;
  const EventRecord record = record_at(std::size_t{0});
  if (record.t_us > kLatest_us || record.t_us < -kLatest_us) {
    ++sink.counters().malformed_words;
  } else {
    sink.append({record.t_us}, static_cast<int>(record.x), static_cast<int>(record.y),
                record.brighter);
  }
  return 1;
}

}  // namespace puck
