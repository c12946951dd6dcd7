#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/posix/file_descriptor.h"
#include "services/camera/event_source.h"
#include "services/camera/growing_time.h"
#include "services/camera/stream_source.h"
#include "services/camera/tcp_link.h"

namespace puck {

/// A program that sends a stream of events over TCP, header first, as a server or as a client of
/// ours. After the end of a connection or invalid data, the next connection continues.
class TcpSource final : public EventSource {
 public:
  TcpSource(std::unique_ptr<TcpLink> link, const EventFileOptions& options);

  Outcome next(Chunk& chunk) override;
  std::optional<SensorSize> sensor_size() const override { return sensor_; }
  std::string waiting_for() const override;
  std::int64_t events_dropped() const override;
  std::int64_t malformed_words() const override;

  /// Number of connections that ended.
  std::int64_t disconnections() const { return disconnections_; }

 private:
  bool is_connected();
  void disconnect(const std::string& reason);
  void check_sensor();

  std::unique_ptr<TcpLink> link_;
  EventFileOptions options_;
  FileDescriptor socket_;
  std::optional<DescriptorEvents> events_;  // While connected.
  std::optional<SensorSize> sensor_;
  bool is_new_clock_ = false;  // No event of this connection has been returned yet.
  GrowingTime time_;
  std::int64_t disconnections_ = 0;
  std::int64_t dropped_before_ = 0;  // In earlier connections.
  std::int64_t malformed_before_ = 0;
};

}  // namespace puck
