#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Where events come from. One thread.
class EventSource {
 public:
  enum class Outcome {
    kEvents,      ///< `chunk` holds the next events, or time went on without any.
    kNothingYet,  ///< A stream is silent; the call waited for it for a few ms.
    kEnd,         ///< There will be no more.
  };
  /// A stretch of sensor time with all the events in it.
  struct Chunk {
    EventPacket packet;
    Timestamp until;  ///< No later chunk has an event before this.
    /// The sensor's clock has been joined anew to the one before: when it was 0 has changed.
    bool new_clock = false;
    /// CLOCK_REALTIME, µs, when a live source's events came; 0: just now.
    std::int64_t came_utime = 0;
  };

  /// As many events as a chunk has where there are more. Of a live source smaller ones are joined,
  /// so that they do not fill the queue.
  static constexpr std::size_t kChunkEvents = 8192;

  virtual ~EventSource() = default;

  /// Replaces the chunk by the next one, in its memory. A source that plays is asked again when the
  /// chunk's time has come. Events are in the order of their times from call to call, too.
  virtual Outcome next(Chunk& chunk) = 0;

  /// Nothing until a stream has told it.
  virtual std::optional<SensorSize> sensor_size() const = 0;

  /// Whether events come when they happen, so that nobody has to hold them back until then.
  virtual bool is_live() const { return false; }

  /// What a silent stream waits for, for a person.
  virtual std::string waiting_for() const { return {}; }

  /// Events that were found but could not be used, so far; overflowed ones included.
  virtual std::int64_t events_dropped() const { return 0; }
  /// Events that a live source had to let go because they were not fetched in time, so far.
  virtual std::int64_t events_overflowed() const { return 0; }
  /// Words of the input that made no sense, so far.
  virtual std::int64_t malformed_words() const { return 0; }
  /// What a person should know about an input that has ended.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace puck
