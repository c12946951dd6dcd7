#include "services/tracker/tracker_service.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>

#include <spdlog/fmt/fmt.h>

#include "common/messaging/conversions.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/host_time.h"
#include "common/messaging/wire_layout.h"
#include "common/runtime/scheduling.h"
#include "common/vision/surface_tracker.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHandle{20};
constexpr std::int64_t kSilentUs = 1'000'000;
// STATUS reports an overload for this time after its end.
constexpr std::int64_t kFloodToldUs = 1'000'000;
// A camera has noise in a still scene, too; after a longer silence it may be dead.
constexpr milliseconds kRestEnds{500};
// Packets overlap by less; a larger step back is a restarted clock. Accepted at most once in this
// time, so that jumping clocks do not keep the tracker busy.
constexpr std::int64_t kClockRestartedUs = 1'000'000;
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
    : params_(params), context_(context) {
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
    take_held();
    if (track_) track_->poll();
    watch_input();
    count_thinned();
    poll_status(context_, *this);
  }
  count_thinned();
  track_.reset();
}

void TrackerService::receive(const EventPacketView& packet, const Receipt& receipt) {
  switch (publisher_.hear(packet.session, packet.seq, receipt.monotonic_us)) {
    case SinglePublisher::Verdict::kOtherPublisher:
      ++others_packets_;
      context_.limited_log.warn("events", "ignores a second publisher of events: " +
                                              context_.peers.name_of(packet.session) + ", at " +
                                              to_string(receipt.sender));
      return;
    case SinglePublisher::Verdict::kLate:
      if (!publisher_.is_silent(receipt.monotonic_us)) {
        packets_.add(packet.session, packet.seq, packet.events_before, packet.count);
        ++dropped_packets_;
        return;
      }
      // Old numbers after a silence: a log is replayed.
      publisher_ = {};
      publisher_.hear(packet.session, packet.seq, receipt.monotonic_us);
      begin(packet, receipt);
      break;
    case SinglePublisher::Verdict::kNewPublisher:
      begin(packet, receipt);
      break;
    case SinglePublisher::Verdict::kAccepted:
      if (!track_ || clock_began_anew(packet, receipt)) begin(packet, receipt);
      break;
  }
  packets_.add(packet.session, packet.seq, packet.events_before, packet.count);
  if (SensorSize{packet.width, packet.height} != sensor_ ||
      packet.first_event_us < newest_event_.us) {
    ++dropped_packets_;
    context_.limited_log.warn("events",
                              "dropped a packet: other sensor size, or older than the newest "
                              "event");
    return;
  }
  heard_us_ = receipt.monotonic_us;
  skip_held();
  if (!params_.reproducible && catch_up_.leaves_out(receipt.monotonic_us, host_monotonic_us())) {
    hold(packet, receipt);
  } else {
    take(packet, receipt);
  }
}

void TrackerService::take(const EventPacketView& packet, const Receipt& receipt) {
  unpack(packet, events_);
  events_received_ += packet.count;
  if (masks_hot_pixels_) events_masked_ += params_.hot_pixels.remove_from(events_);
  if (events_.empty()) return;

  PacketOrigin origin = origin_of(packet, receipt);
  if (!origin.is_live) ++packets_not_live_;
  // Time in whole packets that waited behind this one while it waited itself.
  const std::int64_t waited_us = host_monotonic_us() - receipt.monotonic_us;
  const std::int64_t length_us = std::max<std::int64_t>(1, events_.newest() - newest_event_);
  origin.queued_us = waited_us / length_us * length_us;
  newest_event_ = events_.newest();
  watch_.expect(newest_event_, origin.received);
  track_->update(events_, origin, receipt.more_waiting);
}

// A packet is skipped only when another one comes, since the newest matters most. Until then it is
// kept without unpacking, so that a queue is skipped quickly.
void TrackerService::hold(const EventPacketView& packet, const Receipt& receipt) {
  held_data_.assign(packet.data.begin(), packet.data.end());
  held_packet_ = packet;
  held_packet_.data = held_data_;
  held_receipt_ = receipt;
  holds_packet_ = true;
}

void TrackerService::skip_held() {
  if (!std::exchange(holds_packet_, false)) return;
  events_received_ += held_packet_.count;
  events_skipped_ += held_packet_.count;
  ++packets_skipped_;
  skipped_us_ = host_monotonic_us();
  context_.limited_log.warn("events",
                            "overload: packets are skipped to keep up with the newest events");
}

void TrackerService::take_held() {
  if (std::exchange(holds_packet_, false)) take(held_packet_, held_receipt_);
}

bool TrackerService::clock_began_anew(const EventPacketView& packet, const Receipt& receipt) const {
  return packet.first_event_us < newest_event_.us - kClockRestartedUs &&
         receipt.monotonic_us - began_us_ > kClockRestartedUs;
}

void TrackerService::begin(const EventPacketView& packet, const Receipt& receipt) {
  track_.reset();
  began_us_ = receipt.monotonic_us;
  sensor_ = {packet.width, packet.height};
  newest_event_ = {packet.first_event_us};
  published_event_ = {-1};
  packets_ = {};
  catch_up_ = {};
  holds_packet_ = false;
  watch_.clear();
  packets_skipped_ = 0;
  packets_not_live_ = 0;
  events_skipped_ = 0;
  dropped_packets_ = 0;
  events_received_ = 0;
  events_thinned_ = 0;
  events_masked_ = 0;
  context_.log.info(fmt::format("following events of session {}, sensor {}x{}", packet.session,
                                packet.width, packet.height));
  check_calibration();
  PipelineParams pipeline = params_.pipeline;
  const Region& wanted = pipeline.detector.region;
  if (!wanted.empty() && wanted.intersect(Region::all_of(sensor_)).empty()) {
    context_.log.error("tracker.detection_region lies outside the sensor; searching all of it");
    pipeline.detector.region = {};
  }
  track_ = make_track(sensor_, pipeline, params_,
                      [this](const TrackedEstimate& tracked) { publish(tracked); });
}

// A camera without matching calibration is tracked as well as possible.
void TrackerService::check_calibration() {
  if (!params_.has_own_size_model) {
    context_.log.warn(
        "tracker.size_model is empty: the puck's size is that of the paper authors' table; name a "
        "file made by puck-calibrate size");
  }
  const PuckSizeModel sizes = params_.pipeline.sizes_of(params_.size_model);
  for (const std::string& doubt : doubts_about(sizes, sensor_)) {
    context_.log.warn("tracker.size_model: " + doubt);
  }
  masks_hot_pixels_ = true;
  try {
    params_.hot_pixels.check_sensor(sensor_, "tracker.hot_pixel_mask");
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
  const LossCounters& counters = packets_.counters();
  origin.counters = {counters.received,   counters.lost,   dropped_packets_,     rejected_packets_,
                     counters.items_lost, events_skipped_, packet.events_dropped};
  return origin;
}

void TrackerService::publish(const TrackedEstimate& tracked) {
  puck_estimate_t message = to_message(tracked.estimate, sensor_);
  const PacketOrigin& origin = tracked.origin;
  message.events_session = origin.session;
  // After the camera has fallen silent, a resting puck may have moved.
  if (tracked.input_age > kRestEnds) message.flags &= ~puck_estimate_t::FLAG_RESTING;
  if (origin.is_live && !origin.is_recorded) message.flags |= puck_estimate_t::FLAG_LIVE;
  if (origin.sensor_zero_utime != 0) {
    const std::int64_t utime = origin.sensor_zero_utime + tracked.estimate.newest_event.us;
    // An impossible time counts as unknown, since it would prevent publication.
    if (utime >= 0 && utime <= kMostOnWire) message.event_utime = utime;
  }
  message.packet_received_utime = origin.received_utime;
  message.tracking_started_utime = utime_of(tracked.tracking_started);
  message.backlog_us = tracked.backlog_us + origin.queued_us;
  message.backlog_events = tracked.backlog_events;
  message.packets_received = origin.counters.received;
  message.packets_lost = origin.counters.lost;
  message.packets_late = origin.counters.late;
  message.packets_rejected = origin.counters.rejected;
  message.events_lost = origin.counters.events_lost;
  message.events_skipped = origin.counters.events_skipped;
  message.events_dropped = origin.counters.events_dropped;
  context_.bus.publish(message);

  // Only the first estimate with a new event gives its latency; the first one of a track is based
  // on no event.
  if (tracked.estimate.events_applied == 0) return;
  if (tracked.estimate.newest_event <= published_event_) return;
  published_event_ = tracked.estimate.newest_event;
  watch_.answer(published_event_, std::chrono::steady_clock::now(), packet_to_estimate_);
  if (origin.received != published_packet_) {
    published_packet_ = origin.received;
    packet_to_look_.record(
        std::chrono::duration_cast<std::chrono::microseconds>(tracked.packet_to_look).count());
  }
  backlog_.record(message.backlog_us);
  // For a log or an unknown clock the difference is meaningless.
  if (origin.is_live && message.event_utime != 0) {
    sensor_to_estimate_.record(message.utime - message.event_utime);
  }
}

void TrackerService::watch_input() {
  rejected_packets_ = context_.bus.counters<EventPacketView>().rejected;
  if (heard_us_ == 0) {
    context_.status.set_state(ServiceState::kWaiting, "for events");
  } else if (host_monotonic_us() - heard_us_ > kSilentUs) {
    context_.status.set_state(ServiceState::kWaiting, "for events: none for 500 ms");
  } else if (skipped_us_ != 0 && host_monotonic_us() - skipped_us_ < kFloodToldUs) {
    context_.status.set_state(ServiceState::kDegraded,
                              "overload: more events arrive than can be processed");
  } else {
    context_.status.set_state(ServiceState::kRunning);
  }
}

void TrackerService::count_thinned() {
  if (track_) events_thinned_ = track_->events_thinned();
}

void TrackerService::report(StatusReport& report) const {
  const LossCounters& counters = packets_.counters();
  report.counters = {
      {"events_received", events_received_},
      {"events_masked", events_masked_},
      {"packets_received", counters.received},
      {"packets_lost", counters.lost},
      {"packets_late", dropped_packets_},
      {"packets_rejected", rejected_packets_},
      {"packets_skipped", packets_skipped_},
      {"packets_of_others", others_packets_},
      {"packets_not_live", packets_not_live_},
      {"events_lost", counters.items_lost},
      {"events_skipped", events_skipped_},
      {"events_thinned", events_thinned_},
      {"estimates", context_.bus.counters<puck_estimate_t>().published},
  };
  report.latencies = {named("packet_to_look", packet_to_look_),
                      named("packet_to_estimate", packet_to_estimate_),
                      named("sensor_to_estimate", sensor_to_estimate_), named("backlog", backlog_)};
}

}  // namespace puck
