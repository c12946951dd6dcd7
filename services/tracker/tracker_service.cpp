#include "services/tracker/tracker_service.h"

#include <chrono>
#include <stdexcept>
#include <string>

#include "common/messaging/conversions.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/host_time.h"
#include "common/vision/make_pipeline.h"
#include "common/vision/puck_search.h"
#include "common/vision/surface_tracker.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kHandle{20};
constexpr std::int64_t kSilentUs = 1'000'000;
// A camera that sees nothing move still has noise; one that sends nothing for so long may be dead.
constexpr milliseconds kRestEnds{500};
// Packets overlap by less; a sensor's clock that steps back by more has been started anew. Believed
// once in as long a time, so that clocks that jump to and fro do not keep the tracker busy.
constexpr std::int64_t kClockRestartedUs = 1'000'000;

std::int64_t utime_of(std::chrono::system_clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

StatusLatency named(const char* name, const LatencyHistogram& histogram) {
  const LatencySummary s = histogram.summary();
  return {name, s.p50_us, s.p99_us, s.max_us, s.samples};
}

}  // namespace

TrackerService::Track::Track(SensorSize sensor, const TrackerServiceParams& params,
                             TrackingThread::Publish publish)
    : surface(sensor, params.pipeline.eros),
      thread(surface, make_pipeline(sensor, params.pipeline, params.size_model),
             PuckSearch(sensor, params.pipeline, params.size_model), params.thread,
             std::move(publish)) {}

TrackerService::TrackerService(const TrackerServiceParams& params, ServiceContext& context)
    : params_(params), context_(context) {
  // Parameters that cannot work are refused at the start, not with the first packet.
  // On the largest sensor, since it is not known yet how far the detection region may reach.
  const SurfaceTracker trial({SensorSize::kMax, SensorSize::kMax}, params.pipeline,
                             params.size_model);
  context_.bus.subscribe<event_packet_t>(
      [this](const event_packet_t& packet, const Receipt& receipt) { receive(packet, receipt); });
}

void TrackerService::run(std::stop_token stop) {
  while (!stop.stop_requested()) {
    context_.bus.handle(kHandle);
    watch_input();
    count_thinned();
    poll_status(context_, *this);
  }
  count_thinned();
  track_.reset();
}

void TrackerService::receive(const event_packet_t& packet, const Receipt& receipt) {
  switch (publisher_.hear(packet.session, packet.seq, receipt.monotonic_us)) {
    case SinglePublisher::Verdict::kOtherPublisher:
      ++others_packets_;
      context_.limited_log.warn("events", "a second publisher of events is not followed");
      return;
    case SinglePublisher::Verdict::kLate:
      if (!publisher_.is_silent(receipt.monotonic_us)) {
        packets_.add(packet.session, packet.seq, packet.events_before, packet.count);
        ++dropped_packets_;
        return;
      }
      // Old numbers after a silence: a log is played once more.
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
  unpack(packet, events_);
  if (SensorSize{packet.width, packet.height} != sensor_ || events_.start < newest_event_) {
    ++dropped_packets_;
    context_.limited_log.warn("events",
                              "a packet of another sensor, or from before the newest event, is "
                              "dropped");
    return;
  }
  heard_us_ = receipt.monotonic_us;
  events_received_ += packet.count;
  if (masks_hot_pixels_) events_masked_ += params_.hot_pixels.remove_from(events_);
  if (events_.empty()) return;
  newest_event_ = events_.newest();
  track_->surface.update(events_, origin_of(packet, receipt));
}

bool TrackerService::clock_began_anew(const event_packet_t& packet, const Receipt& receipt) const {
  return packet.first_event_us < newest_event_.us - kClockRestartedUs &&
         receipt.monotonic_us - began_us_ > kClockRestartedUs;
}

void TrackerService::begin(const event_packet_t& packet, const Receipt& receipt) {
  track_.reset();
  began_us_ = receipt.monotonic_us;
  sensor_ = {packet.width, packet.height};
  newest_event_ = {packet.first_event_us};
  published_event_ = {-1};
  packets_ = {};
  dropped_packets_ = 0;
  events_received_ = 0;
  events_thinned_ = 0;
  events_masked_ = 0;
  context_.log.info("following events of session {:x}, sensor {}x{}", packet.session, packet.width,
                    packet.height);
  check_calibration();
  TrackerServiceParams params = params_;
  const Region& wanted = params.pipeline.detector.region;
  if (!wanted.empty() && wanted.intersect(Region::all_of(sensor_)).empty()) {
    context_.log.error("tracker.detection_region lies outside the sensor; searching all of it");
    params.pipeline.detector.region = {};
  }
  track_ =
      std::make_unique<Track>(sensor_, params, [this](const TrackedEstimate& t) { publish(t); });
}

// A camera that nobody calibrated for is followed all the same, as well as it can be.
void TrackerService::check_calibration() {
  for (const std::string& doubt : doubts_about(params_.size_model, sensor_)) {
    context_.log.warn("tracker.size_model: {}", doubt);
  }
  masks_hot_pixels_ = true;
  try {
    params_.hot_pixels.check_sensor(sensor_, "tracker.hot_pixel_mask");
  } catch (const std::invalid_argument& error) {
    masks_hot_pixels_ = false;
    context_.log.error("{}: it is not used", error.what());
  }
}

PacketOrigin TrackerService::origin_of(const event_packet_t& packet, const Receipt& receipt) const {
  PacketOrigin origin;
  origin.session = packet.session;
  origin.sensor_zero_utime = packet.sensor_zero_utime;
  origin.received_utime = receipt.utime;
  origin.received =
      std::chrono::steady_clock::time_point(std::chrono::microseconds(receipt.monotonic_us));
  const LossCounters& counters = packets_.counters();
  origin.counters = {counters.received, counters.lost,       dropped_packets_,
                     rejected_packets_, counters.items_lost, packet.events_dropped};
  return origin;
}

void TrackerService::publish(const TrackedEstimate& tracked) {
  puck_estimate_t message = to_message(tracked.estimate, sensor_);
  const PacketOrigin& origin = tracked.origin;
  message.events_session = origin.session;
  // Nobody knows whether a puck still rests where it did once its camera has fallen silent.
  if (tracked.input_age > kRestEnds) message.flags &= ~puck_estimate_t::FLAG_RESTING;
  if (origin.sensor_zero_utime != 0) {
    message.event_utime = origin.sensor_zero_utime + tracked.estimate.newest_event.us;
  }
  message.packet_received_utime = origin.received_utime;
  message.tracking_started_utime = utime_of(tracked.tracking_started);
  message.backlog_us = tracked.backlog_us;
  message.backlog_events = tracked.backlog_events;
  message.packets_received = origin.counters.received;
  message.packets_lost = origin.counters.lost;
  message.packets_late = origin.counters.late;
  message.packets_rejected = origin.counters.rejected;
  message.events_lost = origin.counters.events_lost;
  message.events_dropped = origin.counters.events_dropped;
  context_.bus.publish(message);

  // Only the first estimate with a new event says how long that event took.
  if (tracked.estimate.newest_event <= published_event_) return;
  published_event_ = tracked.estimate.newest_event;
  packet_to_estimate_.record(std::chrono::duration_cast<std::chrono::microseconds>(
                                 std::chrono::steady_clock::now() - origin.received)
                                 .count());
  backlog_.record(tracked.backlog_us);
  if (message.event_utime != 0) sensor_to_estimate_.record(message.utime - message.event_utime);
}

void TrackerService::watch_input() {
  rejected_packets_ = context_.bus.counters<event_packet_t>().rejected;
  if (heard_us_ == 0) {
    context_.status.set_state(ServiceState::kWaiting, "for events");
  } else if (host_monotonic_us() - heard_us_ > kSilentUs) {
    context_.status.set_state(ServiceState::kWaiting, "for events, which have stopped coming");
  } else {
    context_.status.set_state(ServiceState::kRunning);
  }
}

void TrackerService::count_thinned() {
  if (track_) events_thinned_ = track_->surface.events_thinned();
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
      {"packets_of_others", others_packets_},
      {"events_lost", counters.items_lost},
      {"events_thinned", events_thinned_},
      {"estimates", context_.bus.counters<puck_estimate_t>().published},
  };
  report.latencies = {named("packet_to_estimate", packet_to_estimate_),
                      named("sensor_to_estimate", sensor_to_estimate_), named("backlog", backlog_)};
}

}  // namespace puck
