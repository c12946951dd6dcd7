#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <stop_token>

#include "common/events/event_packet.h"
#include "common/messaging/event_packet_view.h"
#include "common/messaging/receipt.h"
#include "common/runtime/latency_histogram.h"
#include "common/runtime/live_tracker.h"
#include "common/runtime/packet_watch.h"
#include "common/runtime/stepped_tracker.h"
#include "services/launch/service.h"
#include "services/tracker/packet_intake.h"
#include "services/tracker/tracker_params.h"

namespace puck {

/// The paper's Figure 2 on the bus. The service's own thread is the event thread: it receives event
/// packets, and LiveTracker updates the surface with every event. The tracking thread in
/// LiveTracker detects and tracks on the newest surface as fast as it can and publishes estimates.
/// PacketIntake decides which packets are tracked; each of its runs has a tracker of its own.
///
/// With tracker.reproducible there is only the first thread (SteppedTracker), and no packet is
/// skipped.
class TrackerService : public Service {
 public:
  static TrackerServiceParams read_params(Config& config) { return read_tracker_params(config); }

  TrackerService(const TrackerServiceParams& params, ServiceContext& context);

  void run(std::stop_token stop) override;
  void report(StatusReport& report) const override;

 private:
  void receive(const EventPacketView& packet, const Receipt& receipt);
  void take(const EventPacketView& packet, const Receipt& receipt);
  void begin_track(const EventPacketView& packet);
  void end_track();
  void check_calibration(SensorSize sensor);
  PacketOrigin origin_of(const EventPacketView& packet, const Receipt& receipt) const;
  void publish(const TrackedEstimate& tracked, SensorSize sensor);
  void watch_input();

  TrackerServiceParams params_;
  ServiceContext& context_;

  // Event thread.
  PacketIntake intake_;
  EventPacket events_;
  bool masks_hot_pixels_ = false;
  std::int64_t events_thinned_ = 0;    // of this run, once it has ended
  std::int64_t events_masked_ = 0;     // of this run
  std::int64_t packets_not_live_ = 0;  // of this run: of a log, or the camera's clock is not known
  std::int64_t rejected_packets_ = 0;  // malformed

  PacketWatch watch_;  // Used by both threads.

  // Publishing thread: whichever makes the step. Both threads may read the histograms.
  Timestamp published_event_{-1};
  std::chrono::steady_clock::time_point published_packet_;  // time of its receipt
  LatencyHistogram packet_to_look_;
  LatencyHistogram packet_to_estimate_;
  LatencyHistogram sensor_to_estimate_;  // live events only, corrected for the camera's clock
  LatencyHistogram backlog_;

  // One of them tracks a run. Last members: the thread uses the others.
  std::optional<LiveTracker> live_;
  std::optional<SteppedTracker> stepped_;  // with tracker.reproducible
};

}  // namespace puck
