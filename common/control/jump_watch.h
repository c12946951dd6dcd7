#pragma once

#include <cstdint>
#include <optional>

#include "common/table/table_point.h"

namespace puck {

struct JumpWatchParams {
  double max_speed_m_s = 20;                ///< Maximum speed of a puck.
  double noise_m = 0.03;                    ///< Tolerance for the noise of positions.
  std::int64_t believed_after_us = 20'000;  ///< Time without a jump before it is trusted again.
};

/// Checks that a track's positions can be those of one puck. A wrong track jumps, or alternates
/// between a place and its mirror image. One thread.
class JumpWatch {
 public:
  explicit JumpWatch(const JumpWatchParams& params) : params_(params) {}

  void see(const TablePoint& place, std::int64_t sensor_us, std::int64_t monotonic_us);
  /// Whether there was no jump for `believed_after_us`.
  bool is_believed(std::int64_t monotonic_us) const {
    return !jumped_us_ || monotonic_us - *jumped_us_ >= params_.believed_after_us;
  }
  std::int64_t jumps() const { return jumps_; }

 private:
  struct Seen {
    TablePoint place;
    std::int64_t sensor_us = 0;
  };

  JumpWatchParams params_;
  std::optional<Seen> last_;
  std::optional<std::int64_t> jumped_us_;
  std::int64_t jumps_ = 0;
};

}  // namespace puck
