#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "common/io/event_filter.h"
#include "common/messages/single_publisher.h"
#include "common/messaging/event_publisher.h"
#include "services/camera/camera_settings.h"
#include "services/camera/event_batcher.h"
#include "services/camera/event_source.h"
#include "services/camera/pacer.h"
#include "services/camera/publish_limit.h"
#include "services/camera/sensor_zero.h"
#include "services/camera/simulated_source.h"
#include "services/launch/service.h"

namespace puck {

/// Takes events from a source, waits until their time, and publishes them in packets. With the
/// simulated table it also publishes TRUTH and HEAD, and moves the robot's mallet by ARM_STATE. One
/// thread.
class CameraService final : public Service {
 public:
  static CameraSettings read_params(Config& config) { return read_camera_settings(config); }

  /// Opens the source. Throws EventFileError, std::runtime_error or std::invalid_argument. A filter
  /// that does not fit the sensor is refused when the source reports its sensor's size.
  CameraService(const CameraSettings& settings, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

 private:
  using Clock = std::chrono::steady_clock;

  std::unique_ptr<EventSource> make_source();
  void listen_to_arm();

  bool play(std::stop_token stop);
  bool send_chunk(std::stop_token stop);
  void say_left_out();
  void wait_at_end(std::stop_token stop);
  void prepare(SensorSize source_sensor);
  bool wait_until(Timestamp time, std::stop_token stop);
  bool wait_for_turn(std::stop_token stop);
  void serve_bus();
  void say_waiting(const std::string& for_what);
  void note_pace(Timestamp time);
  void note_trouble(const std::string& what);
  void note_recovery();
  void publish_batch();
  std::int64_t sensor_zero_utime() const;
  std::int64_t events_dropped() const;
  void publish_truth(const SimulatedTruth& truth);
  void warn_of_drops();
  void warn_of_lost_messages();
  void watch_overflow();

  CameraSettings settings_;
  ServiceContext& context_;
  SimulatedSource* simulated_ = nullptr;  // source_ if it is one; set by make_source().
  std::unique_ptr<EventSource> source_;
  SinglePublisher arm_;
  bool is_paced_;
  Pacer pacer_;
  PublishLimit limit_;
  SensorZero live_zero_;
  std::int64_t pacer_zero_utime_ = 0;

  // Set when the sensor's size is known.
  std::optional<EventFilter> filter_;
  std::optional<EventPublisher> publisher_;
  std::optional<EventBatcher> batcher_;

  EventSource::Chunk chunk_;
  Clock::time_point batch_began_;
  Clock::time_point bus_due_;
  Clock::time_point last_trouble_;
  Clock::time_point last_events_;
  std::int64_t drops_told_ = 0;
  std::int64_t messages_told_ = 0;
  std::int64_t overflow_seen_ = 0;
};

}  // namespace puck
