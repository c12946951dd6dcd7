#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

#include "common/events/event_packet.h"
#include "common/messaging/event_packet_view.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/single_publisher.h"
#include "common/runtime/latency_histogram.h"
#include "common/runtime/packet_watch.h"
#include "services/launch/service.h"
#include "services/tracker/catch_up.h"
#include "services/tracker/track.h"
#include "services/tracker/tracker_params.h"

namespace puck {

/// The paper's Figure 2. The service's own thread receives event packets from the bus and updates
/// the EROS surface event by event. The second one, a TrackingThread, searches the newest surface
/// as fast as it can and publishes estimates.
///
/// Follows one publisher of events: the first one heard, until it has been silent for 500 ms. All
/// state is reset for another publisher, another run of the same one, or a restarted sensor clock.
/// In an overload it skips whole packets to keep to the newest events.
///
/// With tracker.reproducible there is only the first thread, and no packet is skipped.
class TrackerService : public Service {
 public:
  static TrackerServiceParams read_params(Config& config) { return read_tracker_params(config); }

  TrackerService(const TrackerServiceParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

 private:
  void receive(const EventPacketView& packet, const Receipt& receipt);
  bool clock_began_anew(const EventPacketView& packet, const Receipt& receipt) const;
  void begin(const EventPacketView& packet, const Receipt& receipt);
  void check_calibration();
  void take(const EventPacketView& packet, const Receipt& receipt);
  void hold(const EventPacketView& packet, const Receipt& receipt);
  void skip_held();
  void take_held();
  PacketOrigin origin_of(const EventPacketView& packet, const Receipt& receipt) const;
  void publish(const TrackedEstimate& tracked);
  void watch_input();
  void count_thinned();

  TrackerServiceParams params_;
  ServiceContext& context_;

  // First thread.
  SinglePublisher publisher_;
  LossAccount packets_;
  CatchUp catch_up_;
  EventPacketView held_packet_;  // the newest one, which may be skipped …
  std::vector<std::uint8_t> held_data_;
  Receipt held_receipt_;
  bool holds_packet_ = false;  // … while this is true
  EventPacket events_;
  SensorSize sensor_;
  Timestamp newest_event_;
  bool masks_hot_pixels_ = false;
  std::int64_t events_received_ = 0;
  std::int64_t events_thinned_ = 0;  // thinned out because the tracking thread was behind
  std::int64_t events_masked_ = 0;
  std::int64_t packets_skipped_ = 0;  // skipped to keep to the newest
  std::int64_t events_skipped_ = 0;
  std::int64_t skipped_us_ = 0;        // CLOCK_MONOTONIC of the last skip; 0: none
  std::int64_t others_packets_ = 0;    // of publishers that are not followed
  std::int64_t packets_not_live_ = 0;  // of a log, or of a camera whose clock is not known
  std::int64_t dropped_packets_ = 0;   // late, or older than the surface
  std::int64_t rejected_packets_ = 0;  // malformed
  std::int64_t heard_us_ = 0;          // CLOCK_MONOTONIC; 0: never
  std::int64_t began_us_ = 0;          // CLOCK_MONOTONIC, start of this track

  PacketWatch watch_;  // used by both threads

  // Second thread; both threads may read the histograms.
  Timestamp published_event_{-1};
  std::chrono::steady_clock::time_point published_packet_;  // time of its receipt
  LatencyHistogram packet_to_look_;
  LatencyHistogram packet_to_estimate_;
  LatencyHistogram sensor_to_estimate_;  // live events only, corrected for the camera's clock
  LatencyHistogram backlog_;

  std::unique_ptr<Track> track_;  // last: its thread uses the members above
};

}  // namespace puck
