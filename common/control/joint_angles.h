#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "common/motion/joint_table.h"

namespace puck {

/// The angles of the arm's joints, deg, in the control board's order. Fixed capacity, so that the
/// loop does not allocate.
class JointAngles {
 public:
  static constexpr std::size_t kMost = JointTable::kMostJoints;

  JointAngles() = default;
  /// At most `kMost` angles; further ones are left out.
  explicit JointAngles(std::span<const double> deg) : size_(std::min(deg.size(), kMost)) {
    std::copy_n(deg.begin(), size_, deg_.begin());
  }

  std::size_t size() const { return size_; }
  double operator[](std::size_t joint) const { return deg_[joint]; }
  double& operator[](std::size_t joint) { return deg_[joint]; }
  std::span<const double> deg() const { return {deg_.data(), size_}; }

 private:
  std::array<double, kMost> deg_{};
  std::size_t size_ = 0;
};

/// The table's joint angles for a place on the line; the place is clamped to the line.
inline JointAngles joints_at(const JointTable& table, double y_m) {
  std::array<double, JointAngles::kMost> deg{};
  table.at(y_m, deg);
  return JointAngles(std::span<const double>(deg).first(table.size()));
}

}  // namespace puck
