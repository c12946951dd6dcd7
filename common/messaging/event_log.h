#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/messaging/event_packet_view.h"
#include "common/messaging/log_file.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/single_publisher.h"

namespace puck {

/// What became of the packets of events in a log, so far.
struct EventLogCounters {
  std::int64_t packets = 0;  ///< Handed out …
  std::int64_t events = 0;   ///< … and the events in them.
  std::int64_t packets_malformed = 0;
  std::int64_t packets_late = 0;       ///< Late, twice, or older than what had come.
  std::int64_t packets_of_others = 0;  ///< Of a publisher that is not followed, or of a sensor.
  std::int64_t packets_missing = 0;    ///< Sent, but not in the log.
  std::int64_t events_missing = 0;     ///< In missing and late packets.
  std::int64_t events_dropped = 0;     ///< By the source, before they were published.
};

/// The events that a log of LCM holds on PUCK_EVENTS: checked, in order, of one publisher at a
/// time, as a tracker that had heard them would have taken them. What is damaged is left out and
/// counted. One thread.
class EventLog {
 public:
  enum class Sessions {
    kFirst,  ///< Only the run of the publisher that comes first.
    /// When a publisher has fallen silent, the next one too: its sensor time is moved to go on from
    /// the one before as much later as the logger heard it.
    kJoined,
  };

  /// `prefix`: that of the channels. Throws LogFileError, also for a log without events there.
  EventLog(std::filesystem::path path, std::string_view prefix, Sessions sessions);

  SensorSize sensor_size() const { return sensor_; }
  /// The publisher's run whose events came last.
  std::int64_t session() const { return publisher_.session(); }

  /// The next events in place of those in `packet`: of one packet, all of it unless it has more
  /// than `max_events`. False at the end of the log; `packet` is then empty.
  bool read(EventPacket& packet, std::size_t max_events);
  void rewind();

  const EventLogCounters& counters() const { return counters_; }
  /// What a person should know of the log as far as it has been read, one line each.
  std::vector<std::string> problems() const;

 private:
  bool next_packet();
  bool take(const EventPacketView& packet, std::int64_t heard_utime);
  bool follows(const EventPacketView& packet, std::int64_t heard_utime);
  void count(const EventPacketView& packet);
  void begin_session(const EventPacketView& packet, std::int64_t heard_utime);
  std::string nothing_found() const;

  std::filesystem::path path_;
  std::string channel_;
  Sessions sessions_;
  std::unique_ptr<LogReader> log_;
  LogRecord record_;
  std::string similar_channel_;  // One with events under another prefix; empty: none seen.

  SinglePublisher publisher_;
  LossAccount losses_;  // Of this session.
  SensorSize sensor_;
  std::int64_t shift_us_ = 0;
  Timestamp newest_;
  std::int64_t newest_utime_ = 0;

  EventPacket packet_;
  std::size_t used_ = 0;  // Events of it that have been handed out.
  EventLogCounters counters_;
  EventLogCounters before_;  // What earlier sessions count for, of what is counted a session.
};

}  // namespace puck
