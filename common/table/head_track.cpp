#include "common/table/head_track.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

constexpr std::int64_t kTimeBeginsAnewUs = 1'000'000;

bool is_finite(const HeadPose& p) {
  return std::isfinite(p.yaw_deg) && std::isfinite(p.pitch_deg) && std::isfinite(p.roll_deg) &&
         std::isfinite(p.yaw_deg_s) && std::isfinite(p.pitch_deg_s) && std::isfinite(p.roll_deg_s);
}

struct Angle {
  double deg = 0;
  double deg_s = 0;
};

// Cubic Hermite interpolation at the share `u` of the time `dt_s` between two angles.
Angle between(Angle a, Angle b, double dt_s, double u) {
  const double rise = b.deg - a.deg;
  const double c = 3 * rise - (2 * a.deg_s + b.deg_s) * dt_s;
  const double d = (a.deg_s + b.deg_s) * dt_s - 2 * rise;
  return {a.deg + u * (a.deg_s * dt_s + u * (c + u * d)), a.deg_s + u * (2 * c + 3 * u * d) / dt_s};
}

HeadPose pose_of(Angle yaw, Angle pitch, Angle roll) {
  return {yaw.deg, pitch.deg, roll.deg, yaw.deg_s, pitch.deg_s, roll.deg_s};
}

}  // namespace

HeadTrack::HeadTrack(const HeadTrackParams& params) : params_(params) {
  const auto require = [](bool holds, const char* what, std::int64_t got_us) {
    if (!holds) {
      throw std::invalid_argument(what + std::to_string(static_cast<double>(got_us) / 1000));
    }
  };
  require(params_.max_ahead_us >= 0 && params_.max_ahead_us <= 100'000,
          "head.max_ahead_ms must be between 0 and 100, got ", params_.max_ahead_us);
  require(params_.max_gap_us > 0 && params_.max_gap_us <= 100'000,
          "head.max_gap_ms must be above 0 and at most 100, got ", params_.max_gap_us);
}

void HeadTrack::add(Timestamp t, const HeadPose& pose) {
  if (!is_finite(pose)) return;
  if (count_ > 0) {
    const std::int64_t since_us = t - kept(0).t;
    if (since_us < -kTimeBeginsAnewUs) forget();
    if (since_us >= -kTimeBeginsAnewUs && since_us <= 0) return;
  }
  // The newest pose is always kept; the previous one is dropped where they are too close in time.
  if (count_ > 1 && kept(0).t - kept(1).t < kSpacingUs) {
    next_ = (next_ + kCapacity - 1) % kCapacity;
    --count_;
  }
  moments_[next_] = {t, pose};
  next_ = (next_ + 1) % kCapacity;
  count_ = std::min(count_ + 1, kCapacity);
}

std::optional<HeadPose> HeadTrack::at(Timestamp t) const {
  if (count_ == 0) return std::nullopt;
  const Moment& newest = kept(0);
  if (t >= newest.t) {
    const std::int64_t ahead_us = t - newest.t;
    if (ahead_us > params_.max_ahead_us) return std::nullopt;
    const double ahead_s = static_cast<double>(ahead_us) * 1e-6;
    HeadPose pose = newest.pose;
    pose.yaw_deg += ahead_s * pose.yaw_deg_s;
    pose.pitch_deg += ahead_s * pose.pitch_deg_s;
    pose.roll_deg += ahead_s * pose.roll_deg_s;
    return pose;
  }
  // Queries are for the recent past, so the search from the newest on is short.
  for (std::size_t back = 1; back < count_; ++back) {
    const auto& [from, a] = kept(back);
    if (t < from) continue;
    const auto& [to, b] = kept(back - 1);
    if (to - from > params_.max_gap_us) return std::nullopt;
    const double dt_s = static_cast<double>(to - from) * 1e-6;
    const double u = static_cast<double>(t - from) / static_cast<double>(to - from);
    return pose_of(between({a.yaw_deg, a.yaw_deg_s}, {b.yaw_deg, b.yaw_deg_s}, dt_s, u),
                   between({a.pitch_deg, a.pitch_deg_s}, {b.pitch_deg, b.pitch_deg_s}, dt_s, u),
                   between({a.roll_deg, a.roll_deg_s}, {b.roll_deg, b.roll_deg_s}, dt_s, u));
  }
  return std::nullopt;
}

}  // namespace puck
