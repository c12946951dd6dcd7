#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "common/play/play_bridge.h"
#include "tools/play/court.h"
#include "tools/play/estimate_link.h"
#include "tools/play/frame_tracker.h"
#include "tools/play/play_setup.h"
#include "tools/play/stepped_arm.h"

namespace puck {

/// Camera, tracker, bridge and arm in one thread and in steps, with the messages of the services.
/// The same setup and seed give the same game, to the bit.
class ClosedLoop {
 public:
  /// Throws std::invalid_argument that names a value out of its range.
  ClosedLoop(const PlaySetup& setup, std::int64_t seed);

  /// Advances everything by one step of the world.
  void step();

  const SimulatedTruth& truth() const { return court_->truth(); }
  Timestamp now() const { return truth().time; }
  const PlayBridge& bridge() const { return bridge_; }

  /// Whether the newest received estimate has a track.
  bool is_tracked() const { return is_tracked_; }
  /// The bridge's last target for the arm; empty before its first command.
  std::optional<double> target_m() const { return target_m_; }

  /// Called with every estimate, before delay and losses.
  void on_estimate(std::function<void(const PuckEstimate&)> call) {
    on_estimate_ = std::move(call);
  }
  /// Called with every TRAJECTORY, which is made only for this call.
  void on_trajectory(std::function<void(const TableTrajectory&)> call) {
    on_trajectory_ = std::move(call);
  }

 private:
  void look();
  void deliver();
  void send(const PuckEstimate& estimate, std::int64_t extra_us);
  void hear_head();

  PlaySetup setup_;
  std::unique_ptr<Court> court_;
  std::optional<FrameTracker> frames_;
  EstimateLink link_;
  PlayBridge bridge_;
  SteppedArm arm_;
  std::function<void(const PuckEstimate&)> on_estimate_;
  std::function<void(const TableTrajectory&)> on_trajectory_;
  std::int64_t estimates_ = 0;
  std::int64_t commands_ = 0;
  std::int64_t heads_ = 0;
  bool is_tracked_ = false;
  std::optional<double> target_m_;
};

}  // namespace puck
