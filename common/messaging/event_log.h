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
#include "common/messages/single_publisher.h"
#include "common/messaging/event_packet_view.h"
#include "common/messaging/log_file.h"
#include "common/messaging/loss_accounting.h"

namespace puck {

/// Counters of the event packets read from a log.
struct EventLogCounters {
  std::int64_t packets = 0;  ///< Returned packets …
  std::int64_t events = 0;   ///< … and the events in them.
  std::int64_t packets_malformed = 0;
  std::int64_t packets_late = 0;       ///< Late, duplicate, or older than the previous packet.
  std::int64_t packets_of_others = 0;  ///< Of another publisher or sensor.
  std::int64_t packets_missing = 0;    ///< Published, but not in the log.
  std::int64_t events_missing = 0;     ///< In missing and late packets.
  std::int64_t events_dropped = 0;     ///< By the source before publication.
};

/// Reads the events on PUCK_EVENTS in an LCM log: checked, in order, of one publisher at a time, as
/// a live tracker would take them. Damaged packets are skipped and counted. One thread.
class EventLog {
 public:
  enum class Sessions {
    kFirst,  ///< Only the first run of a publisher.
    /// After a publisher has fallen silent, the next one too. Its sensor time is shifted so that
    /// the gap between the two is that of the logger's times of receipt. Where another log was
    /// appended to this one, the next publisher follows after kJointUs.
    kJoined,
  };

  /// Sensor time between the sessions of two logs of which one was appended to the other.
  static constexpr std::int64_t kJointUs = 1'000'000;

  /// `prefix`: of the channel names. Throws LogFileError, also for a log without events.
  EventLog(std::filesystem::path path, std::string_view prefix, Sessions sessions);

  SensorSize sensor_size() const { return sensor_; }
  /// Session of the newest events.
  std::int64_t session() const { return publisher_.session(); }
  /// Number of sessions read before that one.
  std::int64_t session_number() const { return session_number_; }

  /// Replaces the events in `packet` by the next ones: the rest of one packet, at most
  /// `max_events`. Returns false at the end of the log, with `packet` empty.
  bool read(EventPacket& packet, std::size_t max_events);
  /// Opens the log again. Throws LogFileError if it cannot be opened, and read() then goes on where
  /// it was; also if it has no events any more, and read() then throws too.
  void rewind();

  const EventLogCounters& counters() const { return counters_; }
  /// Messages for the user about what was read so far, one line each.
  std::vector<std::string> problems() const;

 private:
  bool next_packet();
  bool take(const EventPacketView& packet, std::int64_t heard_utime);
  bool follows(const EventPacketView& packet, std::int64_t heard_utime);
  void note_joint(std::int64_t record_number);
  bool begins_at_joint(const EventPacketView& packet);
  void count(const EventPacketView& packet);
  void begin_session(const EventPacketView& packet, std::int64_t heard_utime);
  std::string nothing_found() const;

  std::filesystem::path path_;
  std::string channel_;
  Sessions sessions_;
  std::unique_ptr<LogReader> log_;  // Null after a rewind() that found no events.
  LogRecord record_;
  std::int64_t newest_number_ = 0;  // Of the records.
  bool is_behind_joint_ = false;    // No packet of the appended log has been judged yet.
  std::string similar_channel_;     // A channel with events under another prefix; empty: none.

  SinglePublisher publisher_;
  std::int64_t newest_seq_ = 0;  // Of this session.
  std::int64_t session_number_ = 0;
  LossAccount losses_;  // Of this session.
  SensorSize sensor_;
  std::int64_t shift_us_ = 0;
  Timestamp newest_;
  std::int64_t newest_utime_ = 0;

  EventPacket packet_;
  std::size_t used_ = 0;  // Events of `packet_` returned so far.
  EventLogCounters counters_;
  EventLogCounters before_;  // Sums of earlier sessions, for counters that restart with each.
};

}  // namespace puck
