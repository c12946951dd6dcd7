#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "common/control/arm_back_end.h"
#include "common/control/arm_motion.h"
#include "common/control/command_guard.h"
#include "common/control/jump_watch.h"
#include "common/control/simulated_back_end.h"
#include "common/control/track_watch.h"
#include "common/messages/arm_command.h"
#include "common/messages/arm_state.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"
#include "common/messages/published_estimate.h"
#include "common/runtime/latency_histogram.h"
#include "common/table/homography.h"
#include "common/table/table_geometry.h"

namespace puck {

enum class ArmMode : std::uint8_t {
  kCommanded,  ///< Follows ARM_COMMAND.
  kFollow,     ///< Follows the puck straight from ESTIMATE, as the paper's demonstration did.
};

/// The table as the camera sees it, for mode follow.
struct ArmView {
  Homography table_from_image;
  TableGeometry table;
};

struct ArmControllerParams {
  ArmMode mode = ArmMode::kCommanded;
  double line_x_m = 0.15;  ///< The mallet moves on x = this, table frame.
  double margin_m = 0.05;  ///< In mode follow: estimates further off the table are rejected.
  CommandGuardParams guard;
  TrackWatchParams track;
  ArmMotionParams arm;
  SimulatedBackEndParams simulated;
  JumpWatchParams jumps;        ///< Limits of the puck's motion, in mode follow.
  std::optional<ArmView> view;  ///< Required in mode follow.
};

/// Decides whether and where the mallet moves, and moves the arm. Driven by messages, times and
/// steps. One thread.
class ArmController {
 public:
  /// `session`: session of the arm's ARM_STATE. `back_end`: if null, simulated joints at rest in
  /// the middle of the line. Throws std::invalid_argument that names the key when a value is out of
  /// its range.
  ArmController(const ArmControllerParams& params, std::int64_t session,
                std::unique_ptr<ArmBackEnd> back_end = nullptr);

  /// `sender`: the clock of the message's session.
  void hear(const ArmCommand& command, const HostNow& now, const SenderClock& sender) {
    guard_.hear(command, now, sender);
  }
  void hear(const PublishedEstimate& estimate, const HostNow& now, const SenderClock& sender);

  /// Decides again and advances the motion by `dt_s`, the time since the previous step.
  void step(const HostNow& now, double dt_s);
  /// Call it when steps were left out for so long that the arm has come to rest.
  void rest() { motion_.rest(); }
  /// Brings the arm to rest and ignores all targets from now on.
  void end() { is_ending_ = true; }
  /// Whether all set-points are at rest.
  bool rests() const { return motion_.set_points_rest(); }

  /// State at the last step, without the header.
  ArmState state() const;

  const CommandGuard& guard() const { return guard_; }
  std::int64_t estimates(TrackWatch::Verdict verdict) const {
    return estimates_[static_cast<std::size_t>(verdict)];
  }
  /// Latency from an estimate's publication to the set-point based on it, corrected for the offset
  /// of the tracker's clock.
  const LatencyHistogram& estimate_to_motion() const { return estimate_to_motion_; }
  /// Position of the mallet from the encoders.
  double position_m() const { return motion_.encoders().place().y_m; }
  double velocity_m_s() const { return motion_.encoders().velocity_m_s(); }
  const ArmMotion& motion() const { return motion_; }
  const ArmBackEnd& back_end() const { return *back_end_; }

  // Number of estimates that repeated the previous one or were rejected.
  std::int64_t frozen_estimates() const { return track_.frozen(); }
  std::int64_t sensor_clock_disagreements() const { return track_.clock_disagreements(); }
  std::int64_t jumped_estimates() const { return jumps_.jumps(); }  ///< In mode follow.
  std::int64_t off_table_estimates() const { return off_table_; }   ///< In mode follow.

 private:
  // What the arm is to do now, and the estimate that this is based on.
  struct Order {
    std::optional<double> target_m;  // nothing: stand still
    std::string_view reason;         // why it stands still: a literal
    MessageId command;
    MessageId estimate;

    bool rests_on_the_same_as(const Order& other) const {
      return command == other.command && estimate == other.estimate;
    }
  };

  Order decide(const HostNow& now, const PublishedEstimate* track) const;
  Order decide_as_commanded(const HostNow& now, const PublishedEstimate* track) const;
  Order decide_to_follow(const PublishedEstimate* track, const HostNow& now) const;
  std::optional<TablePoint> place_of(const PublishedEstimate& track) const;
  void measure_latency(const Order& order, const HostNow& now);

  ArmControllerParams params_;
  CommandGuard guard_;
  TrackWatch track_;
  JumpWatch jumps_;
  std::int64_t off_table_ = 0;
  ArmMotion motion_;
  std::unique_ptr<ArmBackEnd> back_end_;
  bool was_faulty_ = false;
  bool is_ending_ = false;
  Order order_;
  MessageId alive_;  // the live track at the last step
  std::int64_t estimate_to_motion_us_ = 0;
  LatencyHistogram estimate_to_motion_;
  bool was_ever_ordered_ = false;
  std::array<std::int64_t, TrackWatch::kVerdicts> estimates_{};  // by verdict
};

}  // namespace puck
