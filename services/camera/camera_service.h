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
#include "services/camera/publish_limit.h"
#include "services/camera/replay.h"
#include "services/camera/replay_controls.h"
#include "services/camera/sensor_zero.h"
#include "services/camera/simulated_source.h"
#include "services/camera/source_watch.h"
#include "services/launch/service.h"

namespace puck {

/// Takes events from a source, waits until their time, and publishes them in packets. A recording
/// obeys ReplayControls. With the simulated table it also publishes TRUTH and HEAD, and moves the
/// robot's mallet by ARM_STATE. One thread.
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
  bool take(EventSource::Outcome outcome);
  bool send_chunk(std::stop_token stop);
  bool send_rest(std::stop_token stop);
  bool begin_session(std::stop_token stop);
  void end_search(bool is_found);
  bool is_interrupted(const std::stop_token& stop) const;
  void say_end(const std::string& what);
  bool wait_at_end(std::stop_token stop);
  void set_ages();
  void prepare(SensorSize source_sensor);
  bool wait_until(Timestamp time, std::stop_token stop);
  bool wait_for_turn(std::stop_token stop);
  void skip_gap();
  void wait_through_gap(Timestamp until, Clock::time_point due);
  std::string gap_text() const;
  void serve_bus();
  void look_at_source();
  void say_waiting(const std::string& for_what);
  void note_pace(Timestamp time);
  void note_trouble(const std::string& what);
  void show_state();
  void publish_batch();
  std::int64_t sensor_zero_utime() const;
  std::int64_t events_dropped() const;
  void publish_truth(const SimulatedTruth& truth);

  CameraSettings settings_;
  ServiceContext& context_;
  SimulatedSource* simulated_ = nullptr;  // source_ if it is one; set by make_source().
  std::unique_ptr<EventSource> source_;
  SinglePublisher arm_;
  bool is_paced_;
  std::optional<Replay> replay_;  // Of a paced source.
  ReplayControls controls_;
  SourceWatch watch_;
  PublishLimit limit_;
  SensorZero live_zero_;

  // Set when the sensor's size is known.
  std::optional<EventFilter> filter_;
  std::optional<EventPublisher> publisher_;
  std::optional<EventBatcher> batcher_;

  EventSource::Chunk chunk_;
  std::size_t chunk_used_ = 0;  // Events of the chunk in the batch so far.
  bool has_chunk_ = false;      // It was not published to its end yet.
  EventSource::Chunk
      sought_;             // Fetched during a search, whose failure leaves chunk_ to go on with.
  Timestamp gap_told_;     // End of the newest gap that was told.
  double ages_speed_ = 1;  // Speed for which the batcher's ages are set.
  Clock::time_point sent_at_;  // The newest packet.
  std::int64_t dropped_before_session_ = 0;
  Clock::time_point batch_began_;
  Clock::time_point bus_due_;
  std::string trouble_;  // The newest; empty: none yet.
  Clock::time_point last_trouble_;
  std::string waits_for_;                     // Of a silent stream; empty: it is not silent.
  std::optional<Clock::time_point> gap_end_;  // While a gap is waited for.
  bool has_ended_ = false;
  Clock::time_point last_events_;
};

}  // namespace puck
