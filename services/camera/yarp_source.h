#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "common/io/event_reader.h"
#include "common/io/yarp_stream.h"
#include "common/yarp/port_reader.h"
#include "services/camera/event_source.h"
#include "services/camera/growing_time.h"

namespace puck {

/// An iCub's event camera, by the YARP port that its grabber sends on. Connects again after every
/// error, after growing pauses.
class YarpSource final : public EventSource {
 public:
  /// `options` must hold the sensor's size. Throws EventFileError if they do not, and
  /// std::invalid_argument if the name server's host is unknown.
  YarpSource(const PortReaderParams& params, const EventFileOptions& options);

  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return sensor_; }
  std::string waiting_for() const override { return port_.waiting_for(); }
  void interrupt() override { port_.interrupt(); }
  std::int64_t events_dropped() const override;
  std::int64_t malformed_words() const override;
  std::optional<PortCounts> port_counts() const override;

 private:
  using Clock = std::chrono::steady_clock;

  void take_message(const PortMessage& message);
  void close_stream();
  bool take_events(Chunk& chunk);

  PortReader port_;
  EventFileOptions options_;
  std::string name_;
  SensorSize sensor_;
  std::optional<YarpStream> stream_;  // Of a connection, until its last event has been taken.
  bool is_stream_finished_ = false;
  bool is_new_clock_ = false;  // No event of this stream has been taken yet.
  Clock::time_point first_message_;
  GrowingTime time_;
  // In earlier connections.
  std::int64_t dropped_before_ = 0;
  std::int64_t malformed_before_ = 0;
  std::int64_t malformed_messages_before_ = 0;
};

}  // namespace puck
