#include "common/calibration/contour_samples.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr std::int64_t kWindowUs = 2'000;
constexpr std::size_t kMostSamples = 400'000;
// Slower contours carry little information, and noise is a large share of their events.
constexpr double kLeastSpeedPx_s = 60;
// Where the contour moves along its tangent, its events have other causes.
constexpr double kLeastNormalShare = 0.3;
constexpr double kNearContourPx = 5;
constexpr double kRingPx = 2;
constexpr double kOutsideFromPx = 3;
constexpr double kOutsideToPx = 7;
constexpr int kFewestOnRing = 8;
// Highest share of events, relative to the ring's, in a band of the same width outside it.
constexpr double kMostOutside = 0.2;
// Share of samples with the minority sign: below kFewestOfPrint they are noise, above kMostOfPrint
// the signs carry no information.
constexpr double kFewestOfPrint = 0.02;
constexpr double kMostOfPrint = 0.3;
// Good enough to select the ring's events.
constexpr ContourCalibration kRough{};

}  // namespace

ContourSamples::ContourSamples(const TruthMotion& truth, SensorSize sensor,
                               const PuckSizeModel& size_model, double lean_deg)
    : truth_(truth),
      sensor_(sensor),
      size_model_(size_model),
      lean_deg_(lean_deg),
      rough_(contour(kRough)) {}

void ContourSamples::add(const EventPacket& packet) {
  for (const Event& event : packet.events) add(event, packet.time_of(event));
}

void ContourSamples::add(const Event& event, Timestamp time) {
  const std::int64_t window = time.us / kWindowUs;
  if (window != window_) {
    close_window();
    window_ = window;
  }
  const auto state = truth_.at(time);
  if (!state) return;
  const double speed = std::hypot(state->velocity.x, state->velocity.y);
  if (speed < kLeastSpeedPx_s) return;
  has_motion_ = true;
  ContourSample sample;
  sample.dx = event.x - state->position.x;
  sample.dy = event.y - state->position.y;
  sample.centre = state->position;
  const double reach = rough_.size_at(sample.centre).width / 2 + kOutsideToPx + kNearContourPx;
  if (std::abs(sample.dx) > reach || std::abs(sample.dy) > reach) return;
  sample.velocity = state->velocity;

  const ContourOffset offset =
      rough_.ring_at(sample.centre, kRough.wall_share).offset(sample.dx, sample.dy, 0);
  const double normal_speed =
      offset.normal_x * state->velocity.x + offset.normal_y * state->velocity.y;
  const double distance = offset.distance_px + kRough.behind_px(normal_speed);
  if (std::abs(distance) < kRingPx) ++ring_events_;
  if (distance > kOutsideFromPx && distance < kOutsideToPx) ++outside_events_;
  sample.is_bright = (event.polarity != 0) == (normal_speed > 0);
  if (std::abs(distance) < kNearContourPx && std::abs(normal_speed) >= kLeastNormalShare * speed) {
    pending_.push_back(sample);
  }
}

void ContourSamples::finish() {
  close_window();
  leave_out_print();
}

// A print's outer edge has the opposite sign of the contour nearby.
void ContourSamples::leave_out_print() {
  const auto bright = std::count_if(samples_.begin(), samples_.end(),
                                    [](const ContourSample& sample) { return sample.is_bright; });
  const auto dark = static_cast<std::ptrdiff_t>(samples_.size()) - bright;
  const auto others = static_cast<double>(std::min(bright, dark));
  const auto all = static_cast<double>(samples_.size());
  if (others < kFewestOfPrint * all || others > kMostOfPrint * all) return;
  std::erase_if(samples_, [is_bright = bright > dark](const ContourSample& sample) {
    return sample.is_bright != is_bright;
  });
}

void ContourSamples::close_window() {
  if (has_motion_) ++windows_;
  if (ring_events_ >= kFewestOnRing && outside_events_ <= kMostOutside * ring_events_) {
    ++clear_windows_;
    for (const ContourSample& sample : pending_) {
      if (seen_++ % keep_every_ == 0) samples_.push_back(sample);
    }
  }
  if (samples_.size() > kMostSamples) {
    for (std::size_t i = 0; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
    samples_.resize((samples_.size() + 1) / 2);
    keep_every_ *= 2;
  }
  pending_.clear();
  has_motion_ = false;
  ring_events_ = 0;
  outside_events_ = 0;
}

}  // namespace puck
