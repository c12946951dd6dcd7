#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/table/head_pose.h"

namespace puck {

struct HeadTrackParams {
  /// A pose is carried on by its speeds for so long, until the next one comes, µs.
  std::int64_t max_ahead_us = 10'000;
  /// Between two poses further apart than this nothing is known, µs.
  std::int64_t max_gap_us = 100'000;
};

/// Where the head was, from poses at single moments. One thread.
class HeadTrack {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit HeadTrack(const HeadTrackParams& params = {});

  /// Poses in the order of their times; one that is not newer than the newest is dropped, and so is
  /// one of which a number is not finite. One more than a second older: time begins anew.
  void add(Timestamp t, const HeadPose& pose);
  void forget() { count_ = 0; }

  bool is_empty() const { return count_ == 0; }

  /// Between two poses by the cubics that have their angles and speeds; beyond the newest by its
  /// speeds. Nothing before the oldest that is kept, or where the poses are too far away.
  std::optional<HeadPose> at(Timestamp t) const;

 private:
  // Kept apart by kSpacingUs at least, so that they reach 100 ms back however often they come.
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
