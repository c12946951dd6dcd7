#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "common/posix/file_descriptor.h"
#include "services/camera/event_source.h"
#include "services/camera/growing_time.h"
#include "services/camera/stream_source.h"

namespace puck {

/// A server that sends a stream of events over TCP, header first. Connects again one second after
/// a failed connection or invalid data.
class TcpSource final : public EventSource {
 public:
  /// Looks up the host and tries all its addresses in turn. Throws std::runtime_error if the host
  /// is not found.
  TcpSource(const std::string& host, int port, const EventFileOptions& options);
  ~TcpSource() override;
  TcpSource(const TcpSource&) = delete;
  TcpSource& operator=(const TcpSource&) = delete;

  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return sensor_; }
  bool is_live() const override { return true; }
  std::string waiting_for() const override { return waiting_for_; }
  std::int64_t events_dropped() const override;
  std::int64_t malformed_words() const override;

  /// Number of connections that delivered bytes and then failed.
  std::int64_t disconnections() const { return disconnections_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Address;

  void connect();
  bool is_connected();
  void disconnect(const std::string& reason);
  void check_sensor();

  std::string name_;
  EventFileOptions options_;
  std::vector<Address> addresses_;  // All addresses of the host, tried in turn.
  std::size_t next_address_ = 0;
  FileDescriptor socket_;
  std::optional<DescriptorEvents> events_;
  Clock::time_point next_attempt_;
  std::string waiting_for_;
  std::optional<SensorSize> sensor_;
  bool is_new_clock_ = false;  // No event of this connection has been returned yet.
  GrowingTime time_;
  std::int64_t disconnections_ = 0;
  std::int64_t dropped_before_ = 0;  // In earlier connections.
  std::int64_t malformed_before_ = 0;
};

}  // namespace puck
