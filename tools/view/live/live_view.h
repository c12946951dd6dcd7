#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/events/event_packet.h"
#include "common/messages/single_publisher.h"
#include "common/messaging/event_packet_view.h"
#include "puck/puck_estimate_t.hpp"
#include "tools/view/interface/newest_events.h"
#include "tools/view/interface/picture_wishes.h"
#include "tools/view/interface/view_scene.h"
#include "tools/view/interface/view_state.h"
#include "tools/view/live/latency_window.h"
#include "tools/view/live/live_chart.h"
#include "tools/view/live/live_surface.h"
#include "tools/view/live/live_table.h"

namespace puck {

/// What the messages of one camera and one tracker show. Of several cameras, follows the one heard
/// first, and the same with trackers. Times `now_us` are CLOCK_MONOTONIC. One thread.
class LiveView {
 public:
  void take(const EventPacketView& packet, std::int64_t now_us);
  void take(const puck_estimate_t& message, std::int64_t now_us);
  void take(const ground_truth_t& message, std::int64_t now_us);
  void take(const puck_trajectory_t& message, std::int64_t now_us) { table_.take(message, now_us); }
  void take(const arm_state_t& message, std::int64_t now_us) { table_.take(message, now_us); }
  void take(const game_state_t& message, std::int64_t now_us) { table_.take(message, now_us); }

  /// Fills all but `heat`; for a heat map, `surface`. False while no camera and no tracker told the
  /// sensor's size.
  bool fill(const PictureWishes& wishes, std::int64_t now_us, ViewScene& scene);

  /// Fills in all but source, services, channels and messages. Samples as ViewSource::state().
  void add_to(ViewState& state, Timestamp since, std::int64_t run, std::int64_t now_us);

  /// Sensor size by the estimates, if it differs from the camera's.
  std::optional<SensorSize> other_sensor() const;
  SensorSize sensor() const { return sensor_; }
  /// Time of the newest event packet with events; empty: none yet.
  std::optional<std::int64_t> events_heard_us() const { return events_heard_us_; }

 private:
  void begin_run(SensorSize sensor);
  void add_to_trail(const PuckEstimate& estimate);
  void forget_old_estimate(std::int64_t now_us);

  SinglePublisher cameras_;
  SinglePublisher trackers_;
  std::int64_t run_ = 0;
  SensorSize sensor_{};
  SensorSize tracker_sensor_{};
  Timestamp time_;
  std::optional<std::int64_t> events_heard_us_;
  EventPacket packet_;  // Keeps its memory.
  NewestEvents events_;
  std::optional<PuckEstimate> estimate_;  // Empty also when the tracker has fallen silent.
  std::int64_t estimate_heard_us_ = 0;
  std::deque<ViewTrack::TrailPoint> trail_;
  LiveSurface surface_;
  LiveChart chart_;
  LiveTable table_;
  LatencyWindow packet_to_estimate_{"packet to estimate"};
  LatencyWindow event_to_estimate_{"event to estimate"};
};

}  // namespace puck
