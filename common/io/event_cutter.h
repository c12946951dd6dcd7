#pragma once

#include <cstddef>
#include <optional>

#include "common/events/event_packet.h"
#include "common/events/timestamp.h"
#include "common/io/event_reader.h"

namespace puck {

/// Cuts a reader's packets at times of the caller's choice. The reader must outlive this object and
/// must not be read by others. One thread.
class EventCutter {
 public:
  explicit EventCutter(EventReader& events) : events_(events) {}

  /// Time of the next event; empty at the end. Throws std::runtime_error at a pause of more than an
  /// hour: it means a damaged time, and waiting for its end, or asking a tracker at every ms of it,
  /// would not end. Throws EventFileError as EventReader::read.
  std::optional<Timestamp> next_time();

  /// Takes the next events up to and including `until`, within the reader's current packet, into
  /// `piece`. Requires a next event at or before `until`.
  void take_until(Timestamp until, EventPacket& piece);

 private:
  EventReader& events_;
  EventPacket packet_;
  std::size_t used_ = 0;
  std::optional<Timestamp> before_;  // Last returned time.
};

}  // namespace puck
