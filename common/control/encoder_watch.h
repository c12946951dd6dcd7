#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/motion/joint_table.h"

namespace puck {

/// The arm's measured state from its encoders: joints, joint velocities, place on the line. One
/// thread.
class EncoderWatch {
 public:
  /// `table` must outlive it.
  explicit EncoderWatch(const JointTable& table) : table_(table) {}

  /// Forgets all readings.
  void restart() { newest_.reset(); }

  /// Takes the back end's current reading: a new one, the same as before, or none. Returns an error
  /// for joints other than the table's or an impossible angle; null: valid.
  const char* look(const std::optional<JointReading>& reading);

  bool has_reading() const { return newest_.has_value(); }
  /// Requires has_reading().
  const JointReading& newest() const { return *newest_; }
  /// Searches the whole line for the mallet's place, without the previous place as a start.
  void find_place();
  /// Require has_reading().
  const JointAngles& deg() const { return newest_->position; }
  std::int64_t age_us(std::int64_t monotonic_us) const {
    return monotonic_us - newest_->received_us;
  }

  /// Velocities from the newest two readings.
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
