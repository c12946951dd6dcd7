#include "tools/view/live/live_view.h"

#include <algorithm>

#include "common/messaging/conversions.h"
#include "common/messaging/event_packing.h"

namespace puck {
namespace {

constexpr const char* kTrackName = "puck-tracker";
// The camera's own packets are at most a few ms late.
constexpr std::int64_t kBackInTime_us = 1'000'000;
// A tracker publishes at least every 20 ms.
constexpr std::int64_t kOldEstimate_us = 500'000;
// Estimates may come 5000 times a second.
constexpr std::int64_t kTrailStep_us = 2'000;

bool is_known(SensorSize sensor) { return sensor.width > 0 && sensor.height > 0; }

double in_seconds(Timestamp time) { return static_cast<double>(time.us) / 1e6; }

/// Whether a message is followed, and whether it begins a new publisher's run.
bool follows(SinglePublisher::Verdict verdict) {
  return verdict == SinglePublisher::Verdict::kNewPublisher ||
         verdict == SinglePublisher::Verdict::kAccepted;
}

}  // namespace

void LiveView::take(const EventPacketView& packet, std::int64_t now_us) {
  const auto verdict = cameras_.hear(packet.session, packet.seq, now_us);
  if (!follows(verdict)) return;
  const SensorSize sensor{packet.width, packet.height};
  const Timestamp newest{packet.first_event_us + packet.duration_us};
  const bool is_new = verdict == SinglePublisher::Verdict::kNewPublisher &&
                      (events_.sensor() != sensor || newest < time_);
  if (is_new || events_.sensor() != sensor || time_ - newest > kBackInTime_us) begin_run(sensor);
  if (packet.count == 0) return;
  events_heard_us_ = now_us;
  forget_old_estimate(now_us);
  unpack(packet, packet_);
  events_.update(packet_);
  surface_.update(packet_, now_us);
  time_ = std::max(time_, newest);
  chart_.add_events(newest, packet.count);
}

void LiveView::take(const puck_estimate_t& message, std::int64_t now_us) {
  if (!follows(trackers_.hear(message.session, message.seq, now_us))) return;
  tracker_sensor_ = {message.image_width, message.image_height};
  if (!is_known(sensor_) && is_known(tracker_sensor_)) begin_run(tracker_sensor_);
  estimate_ = from_message(message);
  estimate_heard_us_ = now_us;
  if (message.packet_received_utime != 0) {
    packet_to_estimate_.add(message.utime - message.packet_received_utime, now_us);
  }
  if ((message.flags & puck_estimate_t::FLAG_LIVE) != 0 && message.event_utime != 0) {
    event_to_estimate_.add(message.utime - message.event_utime, now_us);
  }
  add_to_trail(*estimate_);
  chart_.set_estimate(*estimate_);
  // Without events, their clock is that of the estimates.
  if (events_heard_us_ && now_us - *events_heard_us_ < SinglePublisher::kSilentAfterUs) return;
  time_ = std::max(time_, estimate_->newest_event);
  chart_.advance(time_);
}

void LiveView::take(const ground_truth_t& message, std::int64_t now_us) {
  chart_.add_truth(from_message(message));
  table_.take(message, now_us);
}

bool LiveView::fill(const PictureWishes& wishes, std::int64_t now_us, ViewScene& scene) {
  if (!is_known(sensor_)) return false;
  forget_old_estimate(now_us);
  scene.sensor = sensor_;
  scene.time = time_;
  scene.seconds = in_seconds(time_);
  scene.no_backdrop.clear();
  if (wishes.view == PictureWishes::View::kTable) {
    scene.table = table_.table(now_us);
    scene.no_table = "no puck-bridge publishes on this bus: start it to see the table";
    return true;
  }
  if (wishes.backdrop == PictureWishes::Backdrop::kEvents) {
    scene.events = events_;
  } else {
    surface_.fill(scene, now_us);
  }
  scene.tracks[0].name = kTrackName;
  scene.tracks[0].estimate = estimate_;
  scene.tracks[0].trail.assign(trail_.begin(), trail_.end());
  scene.tracks[1] = {};
  scene.truth = chart_.truth_at(time_);
  return true;
}

void LiveView::add_to(ViewState& state, Timestamp since, std::int64_t run, std::int64_t now_us) {
  forget_old_estimate(now_us);
  state.is_live = true;
  state.sensor = sensor_;
  state.time = time_;
  state.seconds = in_seconds(time_);
  state.run = run_;
  state.chosen[0] = kTrackName;
  state.estimates[0] = estimate_;
  state.errors_px[0] = chart_.error_px();
  for (const ChartSample& sample : chart_.samples()) {
    if (run != run_ || sample.time > since) state.samples.push_back(sample);
  }
  state.latencies = {packet_to_estimate_.percentiles(now_us),
                     event_to_estimate_.percentiles(now_us)};
}

std::optional<SensorSize> LiveView::other_sensor() const {
  if (!is_known(events_.sensor()) || !is_known(tracker_sensor_)) return std::nullopt;
  if (events_.sensor() == tracker_sensor_) return std::nullopt;
  return tracker_sensor_;
}

void LiveView::begin_run(SensorSize sensor) {
  ++run_;
  sensor_ = sensor;
  events_.reset(sensor);
  surface_.reset(sensor);
  time_ = {};
  estimate_.reset();
  trail_.clear();
  chart_.clear();
}

// An old estimate would look like a present one.
void LiveView::forget_old_estimate(std::int64_t now_us) {
  if (!estimate_ || now_us - estimate_heard_us_ < kOldEstimate_us) return;
  estimate_.reset();
  chart_.set_estimate(estimate_);
}

void LiveView::add_to_trail(const PuckEstimate& estimate) {
  const Timestamp time = estimate.newest_event;
  if (!trail_.empty() && time < trail_.back().time) trail_.clear();
  if (!trail_.empty() && time - trail_.back().time < kTrailStep_us &&
      trail_.back().position.has_value() == estimate.position.has_value()) {
    return;
  }
  trail_.push_back({time, estimate.position});
  while (time - trail_.front().time > ViewTrack::kTrail_us) trail_.pop_front();
}

}  // namespace puck
