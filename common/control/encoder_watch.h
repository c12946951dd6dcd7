#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/motion/joint_table.h"

namespace puck {

/// Where the arm really is, by its encoders: joints, their velocities, the place on the line. One
/// thread.
class EncoderWatch {
 public:
  /// `table` must outlive it.
  explicit EncoderWatch(const JointTable& table) : table_(table) {}

  /// Forgets what it knows.
  void restart() { newest_.reset(); }

  /// What the back end gives now, which may be the same as before, or nothing. Says what is wrong
  /// with it: other joints than the table's, or an angle that is not finite or cannot be.
  const char* look(const std::optional<JointReading>& reading);

  bool has_reading() const { return newest_.has_value(); }
  /// The newest; there must be one.
  const JointReading& newest() const { return *newest_; }
  /// Looks for its place everywhere on the line, since that before may have been wrong.
  void find_place();
  /// Of the newest reading; there must be one.
  const JointAngles& deg() const { return newest_->position; }
  std::int64_t age_us(std::int64_t monotonic_us) const {
    return monotonic_us - newest_->received_us;
  }

  /// By the newest two readings.
  double joint_velocity_deg_s(std::size_t joint) const { return velocity_deg_s_[joint]; }
  const LinePlace& place() const { return place_; }
  double velocity_m_s() const { return velocity_m_s_; }

 private:
  const JointTable& table_;
  std::optional<JointReading> newest_;
  LinePlace place_;
  double velocity_m_s_ = 0;
  std::array<double, JointAngles::kMost> velocity_deg_s_{};
};

}  // namespace puck
