#pragma once

#include <cstdint>
#include <optional>

#include "common/table/table_point.h"

namespace puck {

struct JumpWatchParams {
  double max_speed_m_s = 20;                ///< No puck is faster.
  double noise_m = 0.03;                    ///< It may seem to have moved so much further.
  std::int64_t believed_after_us = 20'000;  ///< Without a jump.
};

/// Whether the places at which a tracker sees the puck can be those of one puck. One that is sure
/// of itself and wrong sees it jump, or here and at its mirror image by turns. One thread.
class JumpWatch {
 public:
  explicit JumpWatch(const JumpWatchParams& params) : params_(params) {}

  void see(const TablePoint& place, std::int64_t sensor_us, std::int64_t monotonic_us);
  /// Nothing has jumped for a while.
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
