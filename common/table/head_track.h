#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/head_pose.h"

namespace puck {

struct HeadTrackParams {
  /// The newest pose is extrapolated with its speeds for at most this long, µs.
  std::int64_t max_ahead_us = 10'000;
  /// Poses further apart in time than this are not interpolated, µs.
  std::int64_t max_gap_us = 100'000;
};

/// History of the head's pose, from poses at single moments. One thread.
class HeadTrack {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit HeadTrack(const HeadTrackParams& params = {});

  /// Adds a pose. Drops one that is not newer than the newest, or with a number that is not finite.
  /// A pose more than a second older than the newest restarts the track.
  void add(Timestamp t, const HeadPose& pose);
  void forget() { count_ = 0; }

  bool is_empty() const { return count_ == 0; }

  /// Between two poses, the cubics with their angles and speeds; beyond the newest, its speeds.
  /// `std::nullopt` before the oldest kept pose, or where the poses are too far away in time.
  std::optional<HeadPose> at(Timestamp t) const;

 private:
  // Kept poses are at least kSpacingUs apart, so that they cover 100 ms at any rate.
  static constexpr std::size_t kCapacity = 256;
  static constexpr std::int64_t kSpacingUs = 500;

  struct Moment {
    Timestamp t;
    HeadPose pose;
  };
  const Moment& kept(std::size_t back) const {
    return moments_[(next_ + kCapacity - 1 - back) % kCapacity];
  }

  HeadTrackParams params_;
  std::array<Moment, kCapacity> moments_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace puck
