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

/// The paper's Figure 2. The thread that runs the service is its first thread: it takes packets of
/// events from the bus and updates the EROS surface event by event. The second, a TrackingThread,
/// looks at the newest surface as fast as it can and publishes where the puck is.
///
/// It follows one publisher of events: the first that it hears, until that one has been silent for
/// 500 ms. With another publisher, another run of the same, or a sensor's clock that begins anew,
/// everything starts anew. When events come faster than it can take them it leaves out whole
/// packets and keeps to the newest.
///
/// With tracker.reproducible there is only the first thread, and nothing is left out.
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
  EventPacketView held_packet_;  // the newest, which may be skipped …
  std::vector<std::uint8_t> held_data_;
  Receipt held_receipt_;
  bool holds_packet_ = false;  // … while this is true
  EventPacket events_;
  SensorSize sensor_;
  Timestamp newest_event_;
  bool masks_hot_pixels_ = false;
  std::int64_t events_received_ = 0;
  std::int64_t events_thinned_ = 0;  // kept from the tracking thread, which was behind
  std::int64_t events_masked_ = 0;
  std::int64_t packets_skipped_ = 0;  // left out to keep to the newest
  std::int64_t events_skipped_ = 0;
  std::int64_t skipped_us_ = 0;        // CLOCK_MONOTONIC, the last of them; 0: never
  std::int64_t others_packets_ = 0;    // of publishers that are not followed
  std::int64_t packets_not_live_ = 0;  // of a log, or of a camera whose clock is not known
  std::int64_t dropped_packets_ = 0;   // late, or older than what is on the surface
  std::int64_t rejected_packets_ = 0;  // malformed
  std::int64_t heard_us_ = 0;          // CLOCK_MONOTONIC; 0: never
  std::int64_t began_us_ = 0;          // CLOCK_MONOTONIC, of this track

  PacketWatch watch_;  // both threads

  // Second thread; the histograms may be read from both.
  Timestamp published_event_{-1};
  std::chrono::steady_clock::time_point published_packet_;  // its receipt
  LatencyHistogram packet_to_look_;
  LatencyHistogram packet_to_estimate_;
  LatencyHistogram sensor_to_estimate_;  // of live events: corrected for the camera's clock
  LatencyHistogram backlog_;

  std::unique_ptr<Track> track_;  // last: its thread uses what stands above
};

}  // namespace puck
