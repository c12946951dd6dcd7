#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Counts of a reader of events.
struct EventCounters {
  std::int64_t events = 0;           ///< Returned to the caller.
  std::int64_t before_start = 0;     ///< Dropped: before the first known time or row.
  std::int64_t outside_sensor = 0;   ///< Dropped: no such pixel.
  std::int64_t backwards = 0;        ///< Dropped: older than the newest, and too late to reorder.
  std::int64_t reordered = 0;        ///< Put in order, as they were not in the file.
  std::int64_t missing = 0;          ///< Known to be lost before the recording.
  std::int64_t other_data = 0;       ///< Skipped: records of other sensors or cameras.
  std::int64_t malformed_words = 0;  ///< Words or lines that are not valid in the format.
  std::int64_t time_glitches = 0;    ///< Ignored time words that contradict their neighbours.
  std::int64_t time_wraps = 0;       ///< Times that the counter of the file began again from 0.
  std::int64_t truncated_bytes = 0;  ///< Incomplete word or line at the end.

  friend bool operator==(const EventCounters&, const EventCounters&) = default;

  EventCounters& operator+=(const EventCounters& other);
  std::int64_t dropped() const { return before_start + outside_sensor + backwards + missing; }
};

/// Decodes a byte stream to events. Accepts pieces of any length, cut anywhere, with the same
/// result. One thread at a time.
class EventDecoder {
 public:
  virtual ~EventDecoder() = default;

  /// Appends events to `packet` until it holds `max_events`, the next event lies more than 2^32 − 1
  /// µs after its start, or the bytes are used up. Returns the number of bytes used: call again
  /// with the rest. An empty packet gets its start from its first event. Allocates only where the
  /// packet has to grow.
  virtual std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                             std::size_t max_events) = 0;

  /// Ends the stream. Events held back until the next time word are then returned by `decode` with
  /// no bytes. Counts an incomplete word.
  virtual void finish() = 0;

  /// True while decoded events wait for space in a packet.
  virtual bool has_backlog() const = 0;

  virtual const EventCounters& counters() const = 0;

  /// Of all decoded events, also of those in the backlog; only once there is one.
  virtual Timestamp newest() const = 0;

  /// Remarks on the stream so far, without its name, one line each.
  virtual std::vector<std::string> notes() const { return {}; }
};

/// Encodings of Prophesee RAW data. EVT 2.1's legacy form has the halves of each word swapped.
enum class RawEncoding : std::uint8_t { kEvt2, kEvt21, kEvt21Legacy, kEvt3, kEvt4 };

/// Drops and counts events outside `sensor`, or more than `reorder_us` older than the newest.
/// Throws std::invalid_argument when `sensor` is not a valid size.
std::unique_ptr<EventDecoder> make_event_decoder(RawEncoding encoding, SensorSize sensor,
                                                 std::int64_t reorder_us = 0);

}  // namespace puck
