#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "common/events/event_packet.h"
#include "common/io/event_reader.h"
#include "common/posix/interruption.h"

namespace puck {

/// Reads packets in a thread of its own, a few ahead, so that reading and writing share the time.
/// One consumer.
class ReadAhead {
 public:
  static constexpr std::size_t kPacketEvents = 16384;

  /// Takes over the reader until the end. `interruption`: ends the reader's wait for a pipe.
  ReadAhead(EventReader& events, Interruption& interruption);
  ~ReadAhead() { interruption_.request(); }
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// Exchanges `packet`, whose memory is used again, for the next one. Returns false at the end.
  /// Throws what the reader threw, after the packets before it.
  bool next(EventPacket& packet);

  /// As EventReader::share_read, for the packets read ahead.
  std::optional<double> share_read();

  /// Ends the reading; the reader is free again.
  void stop();

 private:
  static constexpr std::size_t kMostPackets = 8;

  void run(const std::stop_token& stop);

  EventReader& events_;
  Interruption& interruption_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<EventPacket> full_;
  std::deque<EventPacket> used_;
  bool is_at_end_ = false;
  std::optional<double> share_read_;
  std::exception_ptr error_;
  std::jthread thread_;
};

}  // namespace puck
