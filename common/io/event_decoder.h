#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// What a reader of events has seen so far.
struct EventCounters {
  std::int64_t events = 0;           ///< Handed out.
  std::int64_t before_start = 0;     ///< Dropped: came before their time or row was known.
  std::int64_t outside_sensor = 0;   ///< Dropped: no such pixel.
  std::int64_t backwards = 0;        ///< Dropped: older than one that was handed out before.
  std::int64_t missing = 0;          ///< Known to have been lost before they were recorded.
  std::int64_t other_data = 0;       ///< Passed over: records of other sensors or cameras.
  std::int64_t malformed_words = 0;  ///< Words or lines of a form that the format does not have.
  std::int64_t time_glitches = 0;    ///< Time words that their neighbours contradict; ignored.
  std::int64_t truncated_bytes = 0;  ///< Left at the end: too few for a word or a line.

  friend bool operator==(const EventCounters&, const EventCounters&) = default;

  std::int64_t dropped() const { return before_start + outside_sensor + backwards + missing; }
};

/// A byte stream becomes events. It may be fed with pieces of any length, cut anywhere; the events
/// do not depend on where. One thread at a time.
class EventDecoder {
 public:
  virtual ~EventDecoder() = default;

  /// Appends events to `packet` until it holds `max_events`, or the next one lies more than
  /// 2^32 − 1 µs after its start, or the bytes are used up. Returns how many bytes were used: call
  /// again with the others. An empty packet gets its start from its first event. Allocates only
  /// where the packet has to grow.
  virtual std::size_t decode(std::span<const std::byte> bytes, EventPacket& packet,
                             std::size_t max_events) = 0;

  /// Says that no more bytes will come. Events that were held back until the next time word then
  /// come out of `decode` with no bytes. Counts a word that was cut.
  virtual void finish() = 0;

  /// True while events wait for a packet that has room.
  virtual bool has_backlog() const = 0;

  virtual const EventCounters& counters() const = 0;
};

enum class RawEncoding : std::uint8_t { kEvt2, kEvt3 };

/// Events outside `sensor` are dropped and counted. Throws std::invalid_argument when `sensor` is
/// not a valid size.
std::unique_ptr<EventDecoder> make_event_decoder(RawEncoding encoding, SensorSize sensor);

}  // namespace puck
