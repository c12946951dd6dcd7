#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "services/camera/control_verdict.h"

namespace puck {

/// A source of events. One thread.
class EventSource {
 public:
  enum class Outcome {
    kEvents,      ///< `chunk` holds the next events, or an interval without events.
    kNothingYet,  ///< A stream had no data for a few ms, or a search goes on.
    kEnd,         ///< The source has ended.
    kNotFound,    ///< The place sought is beyond the end; the source is where it was before.
  };
  /// An interval of sensor time with all its events.
  struct Chunk {
    EventPacket packet;
    Timestamp until;  ///< Later chunks have no event before this time.
    /// The sensor's clock is a new one, joined to the previous one; its zero has changed.
    bool new_clock = false;
    /// A new session begins at this time, with these events; set behind a search, and by a log with
    /// several sessions.
    std::optional<Timestamp> session_from{};
    /// Receipt of a live source's events, CLOCK_REALTIME, µs; 0: just now.
    std::int64_t came_utime = 0;
  };
  /// Of a source that receives messages.
  struct PortCounts {
    std::int64_t connections = 0;
    std::int64_t failures = 0;  ///< Of connections and attempts to connect.
    std::int64_t messages = 0;
    std::int64_t lost = 0;       ///< Messages that their sequence numbers show as lost.
    std::int64_t malformed = 0;  ///< Messages without a camera's events.
  };

  /// Number of events of a full chunk. Smaller chunks of a live source are joined, so that they do
  /// not fill the queue.
  static constexpr std::size_t kChunkEvents = 8192;

  virtual ~EventSource() = default;

  /// Replaces the chunk by the next one, reusing its memory. A paced source is called when the
  /// chunk's time has come. Times never go back, also from call to call.
  virtual Outcome next(Chunk& chunk) = 0;

  /// Nothing until a stream has reported it.
  virtual std::optional<SensorSize> sensor_size() const = 0;

  /// Whether it is a recording, which seek() moves through.
  virtual bool is_recording() const { return false; }
  /// Begins the search for the events from a position on, µs since the recording's first event.
  /// next() then returns kNothingYet until it has them, or kNotFound. The verdict is kSearching or
  /// a refusal, after which the source is where it was. Throws EventFileError if the recording
  /// cannot be read again; next() then goes on where it was, or throws too.
  virtual ControlVerdict seek(std::int64_t) { return ControlVerdict::kNoRecording; }
  /// The position of a time of the newest chunk.
  virtual std::int64_t position_us(Timestamp time) const { return time.us; }

  /// What a silent stream waits for, as text for people; empty: not known yet.
  virtual std::string waiting_for() const { return {}; }

  /// Ends a wait of next() and all later ones. Safe from any thread.
  virtual void interrupt() {}

  /// Number of unusable events in the input, overflowed ones included.
  virtual std::int64_t events_dropped() const { return 0; }
  /// Number of events that a live source dropped because they were not fetched in time.
  virtual std::int64_t events_overflowed() const { return 0; }
  /// Number of malformed words in the input.
  virtual std::int64_t malformed_words() const { return 0; }
  /// Nothing for a source without messages.
  virtual std::optional<PortCounts> port_counts() const { return std::nullopt; }
  /// Messages for the user about an input that has ended.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace puck
