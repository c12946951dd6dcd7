#include "common/play/estimate_gate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// A position that is less certain is not usable.
constexpr double kMostUnsureM = 0.5;

// Covariance of (x, y, vx, vy) in the image; nothing if that of the position is invalid.
std::optional<Matrix4> image_covariance(const PuckEstimate& estimate, double default_sigma_px) {
  const Matrix4 covariance = symmetric_part(Matrix4(estimate.covariance.data()));
  const double xx = covariance(0, 0);
  const double xy = covariance(0, 1);
  const double yy = covariance(1, 1);
  if (xx == 0 && xy == 0 && yy == 0) {
    const double variance = default_sigma_px * default_sigma_px;
    return diagonal(variance, variance, 0, 0);
  }
  if (!(xx >= 0 && yy >= 0 && xy * xy <= xx * yy * (1 + 1e-9))) return std::nullopt;
  return covariance;
}

// Width of a disc of this radius in the image; nothing behind the camera. The height is less
// reliable: at a low angle, half of it is the puck's wall.
std::optional<double> width_at(const Homography& camera, const TablePoint& at, double radius_m) {
  const auto left = camera.to_image({at.x_m, at.y_m - radius_m});
  const auto right = camera.to_image({at.x_m, at.y_m + radius_m});
  const auto near = camera.to_image({at.x_m - radius_m, at.y_m});
  const auto far = camera.to_image({at.x_m + radius_m, at.y_m});
  if (!left || !right || !near || !far) return std::nullopt;
  return std::hypot(right->x - left->x, far->x - near->x);
}

}  // namespace

const char* to_string(EstimateVerdict verdict) {
  switch (verdict) {
    case EstimateVerdict::kGood:
      return "good";
    case EstimateVerdict::kNotTracking:
      return "not_tracking";
    case EstimateVerdict::kStale:
      return "stale";
    case EstimateVerdict::kOffTable:
      return "off_table";
    case EstimateVerdict::kImplausible:
      return "implausible";
    case EstimateVerdict::kWrongSize:
      return "wrong_size";
    case EstimateVerdict::kMalformed:
      return "malformed";
    case EstimateVerdict::kBlind:
      return "blind";
    case EstimateVerdict::kBelated:
      return "belated";
    case EstimateVerdict::kLate:
      return "late";
    case EstimateVerdict::kOtherPublisher:
      return "other_publisher";
    case EstimateVerdict::kClock:
      return "clock";
    case EstimateVerdict::kClockUnknown:
      return "clock_unknown";
  }
  return "unknown";
}

EstimateGate::EstimateGate(const EstimateGateParams& params, const TableGeometry& table)
    : params_(params), table_(table) {
  const auto require = [](bool holds, const std::string& what, double got) {
    if (!holds) throw std::invalid_argument(what + ", got " + std::to_string(got));
  };
  require(params_.max_age_us > 0 && params_.max_age_us <= 100'000,
          "bridge.max_age_ms must be above 0 and at most 100",
          static_cast<double>(params_.max_age_us) / 1000);
  require(params_.margin_m >= 0 && params_.margin_m <= 1, "bridge.margin_m must be between 0 and 1",
          params_.margin_m);
  require(params_.max_speed_m_s > 0 && params_.max_speed_m_s <= 100,
          "bridge.max_speed_m_s must be above 0 and at most 100", params_.max_speed_m_s);
  require(params_.default_sigma_px > 0 && params_.default_sigma_px <= 100,
          "bridge.default_sigma_px must be above 0 and at most 100", params_.default_sigma_px);
  require(params_.size_tolerance >= 1.1 && params_.size_tolerance <= 100,
          "bridge.size_tolerance must be between 1.1 and 100", params_.size_tolerance);
}

EstimateVerdict EstimateGate::judge(const PublishedEstimate& estimate, const HostNow& now,
                                    const SenderClock& sender, const TableView* view,
                                    TableMeasurement& measurement) {
  EstimateVerdict verdict = judge_order(estimate, now, sender);
  if (verdict == EstimateVerdict::kGood) {
    verdict = judge_content(estimate, now, *sender, view, measurement);
  } else if (verdict == EstimateVerdict::kLate && estimate.session == publisher_.session() &&
             judge_content(estimate, now, *sender, view, measurement) == EstimateVerdict::kGood) {
    verdict = EstimateVerdict::kBelated;
  }
  ++counts_[static_cast<std::size_t>(verdict)];
  return verdict;
}

EstimateVerdict EstimateGate::judge_order(const PublishedEstimate& estimate, const HostNow& now,
                                          const SenderClock& sender) {
  switch (freshness_of(estimate.utime, now, sender, params_.max_clock_error_us)) {
    case Freshness::kClockUnknown:
      return EstimateVerdict::kClockUnknown;
    case Freshness::kOld:
    case Freshness::kFromFuture:
      return EstimateVerdict::kClock;
    case Freshness::kOfNow:
      break;
  }
  switch (publisher_.hear(estimate.session, estimate.seq, now.monotonic_us)) {
    case SinglePublisher::Verdict::kLate:
      return EstimateVerdict::kLate;
    case SinglePublisher::Verdict::kOtherPublisher:
      return EstimateVerdict::kOtherPublisher;
    case SinglePublisher::Verdict::kNewPublisher:
    case SinglePublisher::Verdict::kAccepted:
      break;
  }
  return EstimateVerdict::kGood;
}

EstimateVerdict EstimateGate::judge_content(const PublishedEstimate& estimate, const HostNow& now,
                                            const ClockOffset& sender, const TableView* view,
                                            TableMeasurement& measurement) const {
  const std::optional<std::int64_t>& event_utime = estimate.event_utime;
  if (!is_sensor_time(estimate.newest_event) || event_utime.value_or(0) < 0) {
    return EstimateVerdict::kMalformed;
  }
  if (!estimate.is_tracking()) return EstimateVerdict::kNotTracking;
  const Pixel& place = *estimate.position;
  const double numbers = place.x + place.y + estimate.velocity.x + estimate.velocity.y;
  const bool finite =
      std::isfinite(numbers) && std::all_of(estimate.covariance.begin(), estimate.covariance.end(),
                                            [](double value) { return std::isfinite(value); });
  if (!finite) return EstimateVerdict::kMalformed;
  const auto covariance = image_covariance(estimate, params_.default_sigma_px);
  if (!covariance || !(estimate.covariance[10] >= 0 && estimate.covariance[15] >= 0))
    return EstimateVerdict::kMalformed;

  if (event_utime && !estimate.resting &&
      sender.to_own(*event_utime) < now.utime - params_.max_age_us) {
    return EstimateVerdict::kStale;
  }

  // The age of the estimate's own utime was checked above.
  if (event_utime && *event_utime > estimate.utime + params_.max_age_us) {
    return EstimateVerdict::kImplausible;
  }

  if (view == nullptr) return EstimateVerdict::kBlind;
  const std::optional<PuckTrack> track = view->to_table({place, estimate.velocity, *covariance});
  if (!track || !table_.contains(track->state.position, params_.margin_m)) {
    return EstimateVerdict::kOffTable;
  }
  const auto& [position, velocity] = track->state;
  if (!has_size_of_puck(estimate, *view, position)) return EstimateVerdict::kWrongSize;
  if (!(std::hypot(velocity.x_m_s, velocity.y_m_s) <= params_.max_speed_m_s)) {
    return EstimateVerdict::kImplausible;
  }
  const Matrix4& p = track->covariance;
  if (!(p(0, 0) + p(1, 1) <= kMostUnsureM * kMostUnsureM)) return EstimateVerdict::kImplausible;
  measurement = {estimate.newest_event,   position,
                 p.topLeftCorner<2, 2>(), velocity,
                 estimate.resting,        p.bottomRightCorner<2, 2>()};
  return EstimateVerdict::kGood;
}

bool EstimateGate::has_size_of_puck(const PublishedEstimate& estimate, const TableView& view,
                                    const TablePoint& position) const {
  if (estimate.size.width == 0) return true;
  const auto width_px = width_at(view.homography(), position, table_.puck_radius_m);
  if (!width_px) return true;
  const double ratio = estimate.size.width / *width_px;
  return ratio <= params_.size_tolerance && ratio >= 1 / params_.size_tolerance;
}

}  // namespace puck
