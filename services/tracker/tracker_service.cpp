#include "services/tracker/tracker_service.h"

#include <chrono>
#include <stdexcept>
#include <string>

#include <spdlog/fmt/fmt.h>

#include "common/messages/host_time.h"
#include "common/messages/single_publisher.h"
#include "common/messaging/conversions.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/wire_layout.h"
#include "common/runtime/scheduling.h"
#include "common/vision/surface_tracker.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHandle{20};
// STATUS reports an overload for this time after its end.
constexpr std::int64_t kFloodToldUs = 1'000'000;
// A camera has noise in a still scene, too; after a longer silence it may be dead.
constexpr milliseconds kRestEnds{500};
// An older packet, by its camera's clock, comes from a replayed log.
constexpr std::int64_t kLiveUs = 200'000;

std::int64_t utime_of(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

StatusLatency named(const char* name, const LatencyHistogram& histogram) {
  const LatencySummary s = histogram.summary();
  return {name, s.p50_us, s.p99_us, s.max_us, s.samples};
}

}  // namespace

TrackerService::TrackerService(const TrackerServiceParams& params, ServiceContext& context)
    : params_(params), context_(context), intake_(!params.reproducible) {
  context_.peers.need({"puck-camera"});
  // Invalid parameters must fail at the start, not with the first packet. The trial uses the
  // largest sensor, since the limits of the detection region are not known yet.
  const SurfaceTracker trial({SensorSize::kMax, SensorSize::kMax}, params.pipeline,
                             params.size_model);
  context_.bus.subscribe<EventPacketView>(
      [this](const EventPacketView& packet, const Receipt& receipt) { receive(packet, receipt); });
}

void TrackerService::run(std::stop_token stop) {
  // Lets the camera pass on a packet before it prepares the next one.
  take_short_turns();
  while (!stop.stop_requested()) {
    context_.bus.handle(kHandle);
    if (const auto* held = intake_.release()) take(held->packet, held->receipt);
    if (stepped_) stepped_->poll();
    watch_input();
    poll_status(context_, *this);
  }
  end_track();
}

void TrackerService::receive(const EventPacketView& packet, const Receipt& receipt) {
  const std::int64_t skipped_before = intake_.counters().packets_skipped;
  const PacketIntake::Verdict verdict = intake_.admit(packet, receipt, host_monotonic_us());
  if (intake_.counters().packets_skipped > skipped_before) {
    context_.limited_log.warn("events",
                              "overload: packets are skipped to keep up with the newest events");
  }
  switch (verdict) {
    case PacketIntake::Verdict::kBegin:
      end_track();
      [[fallthrough]];
    case PacketIntake::Verdict::kTake:
      take(packet, receipt);
      break;
    case PacketIntake::Verdict::kUnfit:
      context_.limited_log.warn("events",
                                "dropped a packet: other sensor size, or older than the newest "
                                "event");
      break;
    case PacketIntake::Verdict::kOtherPublisher:
      context_.limited_log.warn("events", "ignores a second publisher of events: " +
                                              context_.peers.name_of(packet.session) + ", at " +
                                              to_string(receipt.sender));
      break;
    case PacketIntake::Verdict::kHeld:
    case PacketIntake::Verdict::kLate:
      break;
  }
}

void TrackerService::take(const EventPacketView& packet, const Receipt& receipt) {
  if (!live_ && !stepped_) begin_track(packet);
  unpack(packet, events_);
  if (masks_hot_pixels_) events_masked_ += params_.hot_pixels.remove_from(events_);
  if (events_.empty()) return;

  PacketOrigin origin = origin_of(packet, receipt);
  if (!origin.is_live) ++packets_not_live_;
  origin.queued_us =
      intake_.note_taken(events_.newest(), receipt.monotonic_us, host_monotonic_us());
  watch_.expect(events_.newest(), origin.received);
  if (live_) {
    live_->update(events_, origin, receipt.more_waiting);
  } else {
    stepped_->update(events_, origin);
  }
}

void TrackerService::begin_track(const EventPacketView& packet) {
  const SensorSize sensor{packet.width, packet.height};
  published_event_ = {-1};
  watch_.clear();
  packets_not_live_ = 0;
  events_thinned_ = 0;
  events_masked_ = 0;
  context_.log.info(fmt::format("following events of session {}, sensor {}x{}", packet.session,
                                packet.width, packet.height));
  check_calibration(sensor);
  PipelineParams pipeline = params_.pipeline;
  Region& wanted = search_params(pipeline).detector.region;
  if (!wanted.empty() && wanted.intersect(Region::all_of(sensor)).empty()) {
    context_.log.error("tracker.detection_region lies outside the sensor; searching all of it");
    wanted = {};
  }
  const auto publish_it = [this, sensor](const TrackedEstimate& tracked) {
    publish(tracked, sensor);
  };
  if (params_.reproducible) {
    stepped_.emplace(sensor, pipeline, params_.size_model, params_.thread, publish_it);
  } else {
    live_.emplace(sensor, pipeline, params_.size_model, params_.thread, publish_it);
  }
}

void TrackerService::end_track() {
  if (live_) events_thinned_ = live_->events_thinned();
  live_.reset();
  stepped_.reset();
}

// A camera without matching calibration is tracked as well as possible.
void TrackerService::check_calibration(SensorSize sensor) {
  if (!params_.has_own_size_model) {
    context_.log.warn(
        "tracker.size_model is empty: the puck's size is that of the paper authors' table; name a "
        "file made by puck-calibrate size");
  }
  const PuckSizeModel sizes = search_params(params_.pipeline).sizes_of(params_.size_model);
  for (const std::string& doubt : doubts_about(sizes, sensor)) {
    context_.log.warn("tracker.size_model: " + doubt);
  }
  masks_hot_pixels_ = true;
  try {
    params_.hot_pixels.check_sensor(sensor, "tracker.hot_pixel_mask");
  } catch (const std::invalid_argument& error) {
    masks_hot_pixels_ = false;
    context_.log.error(std::string(error.what()) + ": the mask is ignored");
  }
}

PacketOrigin TrackerService::origin_of(const EventPacketView& packet,
                                       const Receipt& receipt) const {
  PacketOrigin origin;
  origin.session = packet.session;
  const SenderClock camera = context_.status.clock_of(packet.session);
  origin.is_live = freshness_of(packet.utime, {receipt.utime, receipt.monotonic_us}, camera,
                                kLiveUs) == Freshness::kOfNow;
  origin.is_recorded = packet.recorded;
  origin.sensor_zero_utime = packet.sensor_zero_utime;
  if (origin.is_live && packet.sensor_zero_utime != 0) {
    origin.sensor_zero_utime = camera->to_own(packet.sensor_zero_utime);
  }
  origin.received_utime = receipt.utime;
  origin.received =
      std::chrono::steady_clock::time_point(std::chrono::microseconds(receipt.monotonic_us));
  const LossCounters& losses = intake_.losses();
  const PacketIntake::Counters& counters = intake_.counters();
  origin.counters = {losses.received,      losses.lost,       counters.packets_dropped,
                     rejected_packets_,    losses.items_lost, counters.events_skipped,
                     packet.events_dropped};
  return origin;
}

void TrackerService::publish(const TrackedEstimate& tracked, SensorSize sensor) {
  const PacketOrigin& origin = tracked.origin;
  PublishedEstimate estimate{{}, tracked.estimate};
  estimate.sensor = sensor;
  estimate.events_session = origin.session;
  // After the camera has fallen silent, a resting puck may have moved.
  if (tracked.input_age > kRestEnds) estimate.resting = false;
  estimate.is_live = origin.is_live && !origin.is_recorded;
  if (origin.sensor_zero_utime != 0) {
    const std::int64_t utime = origin.sensor_zero_utime + estimate.newest_event.us;
    // An impossible time counts as unknown, since it would prevent publication.
    if (utime > 0 && utime <= kMostOnWire) estimate.event_utime = utime;
  }
  estimate.packet_received_utime = origin.received_utime;
  estimate.tracking_started_utime = utime_of(tracked.tracking_started);
  estimate.backlog_us = tracked.backlog_us + origin.queued_us;
  estimate.backlog_events = tracked.backlog_events;
  estimate.packets = origin.counters;
  context_.bus.publish(estimate);

  // Only the first estimate with a new event gives its latency; the first one of a track is based
  // on no event.
  if (estimate.events_applied == 0) return;
  if (estimate.newest_event <= published_event_) return;
  published_event_ = estimate.newest_event;
  watch_.answer(published_event_, std::chrono::steady_clock::now(), packet_to_estimate_);
  if (origin.received != published_packet_) {
    published_packet_ = origin.received;
    packet_to_look_.record(
        std::chrono::duration_cast<std::chrono::microseconds>(tracked.packet_to_look).count());
  }
  backlog_.record(estimate.backlog_us);
  // For a log or an unknown clock the difference is meaningless.
  if (origin.is_live && estimate.event_utime) {
    sensor_to_estimate_.record(estimate.utime - *estimate.event_utime);
  }
}

void TrackerService::watch_input() {
  rejected_packets_ = context_.bus.counters<EventPacketView>().rejected;
  const std::int64_t now_us = host_monotonic_us();
  if (intake_.heard_us() == 0) {
    context_.status.set_state(ServiceState::kWaiting, "for events");
  } else if (now_us - intake_.heard_us() > SinglePublisher::kSilentAfterUs) {
    context_.status.set_state(ServiceState::kWaiting, "for events: none for 500 ms");
  } else if (intake_.skipped_us() != 0 && now_us - intake_.skipped_us() < kFloodToldUs) {
    context_.status.set_state(ServiceState::kDegraded,
                              "overload: more events arrive than can be processed");
  } else {
    context_.status.set_state(ServiceState::kRunning);
  }
}

void TrackerService::report(StatusReport& report) const {
  const LossCounters& losses = intake_.losses();
  const PacketIntake::Counters& counters = intake_.counters();
  report.counters = {
      {"events_received", counters.events_received},
      {"events_masked", events_masked_},
      {"packets_received", losses.received},
      {"packets_lost", losses.lost},
      {"packets_late", counters.packets_dropped},
      {"packets_rejected", rejected_packets_},
      {"packets_skipped", counters.packets_skipped},
      {"packets_of_others", counters.packets_of_others},
      {"packets_not_live", packets_not_live_},
      {"events_lost", losses.items_lost},
      {"events_skipped", counters.events_skipped},
      {"events_thinned", live_ ? live_->events_thinned() : events_thinned_},
      {"estimates", context_.bus.counters<PublishedEstimate>().published},
  };
  report.latencies = {named("packet_to_look", packet_to_look_),
                      named("packet_to_estimate", packet_to_estimate_),
                      named("sensor_to_estimate", sensor_to_estimate_), named("backlog", backlog_)};
}

}  // namespace puck
