#pragma once

#include <cstdint>
#include <optional>

#include "common/messages/arm_command.h"
#include "common/messages/clock_offset.h"
#include "common/messages/head_state.h"
#include "common/messages/host_now.h"
#include "common/messages/single_publisher.h"
#include "common/messages/table_trajectory.h"
#include "common/play/arm_watch.h"
#include "common/play/estimate_gate.h"
#include "common/play/game_observer.h"
#include "common/play/strategy.h"
#include "common/play/track_probation.h"
#include "common/table/head_track.h"
#include "common/table/homography.h"
#include "common/table/intercept_predictor.h"
#include "common/table/motion_filter.h"
#include "common/table/puck_motion.h"
#include "common/table/table_camera.h"
#include "common/table/table_view.h"

namespace puck {

struct PlayBridgeParams {
  EstimateGateParams gate;
  std::int64_t probation_us = TrackProbationParams{}.probation_us;  ///< See TrackProbationParams.
  PuckMotionParams motion;
  MotionFilterParams filter;
  InterceptParams intercept;
  StrategyParams strategy;
  double max_trajectory_hz = 1000;
  double command_hz = 250;              ///< Rate of commands; a target that moved goes out at once.
  std::int64_t valid_for_us = 100'000;  ///< Validity of a command.
  /// Without a focal length in the calibration: turn of the head, deg, beyond which the table's
  /// place is unknown.
  double max_head_deg = 0.5;
  HeadTrackParams head;
  /// true: the table's place is unknown before the first HEAD. false: the camera counts as fixed
  /// until then.
  bool needs_head = false;
};

/// From estimates to the puck's motion on the table, the game, and commands for the arm. Driven by
/// messages and times; returns messages without headers. Commands only with a live, trusted track
/// and an arm that is heard. One thread.
class PlayBridge {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  /// `camera`: if empty, the head is not followed.
  PlayBridge(const PlayBridgeParams& params, const Homography& table_from_image,
             const TableGeometry& table, const std::optional<PinholeCamera>& camera = std::nullopt);

  /// `sender`: the clock of the message's session. ARM_STATE that is not current is ignored.
  void hear(const PublishedEstimate& estimate, const HostNow& now, const SenderClock& sender);
  void hear(const ArmState& state, const HostNow& now, const SenderClock& sender) {
    arm_.hear(state, now, sender);
  }
  void hear(const HeadState& head, const HostNow& now);

  /// Messages that are due at `now`; each is returned once.
  std::optional<TableTrajectory> next_trajectory(const HostNow& now);
  std::optional<ArmCommand> next_command(const HostNow& now);
  std::optional<GameState> next_game(const HostNow& now);

  /// The head pose is unknown, and with it the table's place in the image: no commands.
  bool is_blind_to_head() const { return is_blind_; }

  /// Whether an arm is heard that can be commanded.
  bool hears_arm(const HostNow& now) const { return arm_.arm(now) != nullptr; }
  /// Session of another publisher whose commands the arm has followed for 0.5 s; 0: none.
  /// `own_session`: session of this bridge's commands.
  std::int64_t other_commander(std::int64_t own_session, const HostNow& now) const {
    return arm_.other_commander(own_session, now);
  }

  const EstimateGate& gate() const { return gate_; }
  const TrackProbation& probation() const { return probation_; }
  /// Good estimates that did not move the arm: those whose sensor time did not advance, and those
  /// of a track that is not trusted.
  std::int64_t frozen() const { return frozen_; }
  std::int64_t untrusted() const { return untrusted_; }
  std::int64_t outliers() const { return outliers_; }
  /// Restarts of the track: after a hit at the puck's place, and elsewhere.
  std::int64_t hits() const { return filter_.hits(); }
  std::int64_t jumps() const { return filter_.jumps(); }
  std::int64_t commands() const { return commands_; }
  const GameBelief& game() const { return game_.belief(); }

 private:
  // The newest good estimate.
  struct Basis {
    MessageId id;
    Timestamp sensor_at_receipt;   // sensor time at its receipt
    std::int64_t received_us = 0;  // CLOCK_MONOTONIC
  };

  std::optional<TableView> view_of(Timestamp t) const;
  Timestamp sensor_now(const HostNow& now) const;
  std::optional<PuckTrack> live_track(const HostNow& now) const;
  void follow_session(const PublishedEstimate& estimate, const HostNow& now);

  PlayBridgeParams params_;
  TableGeometry table_;
  EstimateGate gate_;
  PuckMotion motion_;
  MotionFilter filter_;
  TrackProbation probation_;
  InterceptPredictor predictor_;
  Strategy strategy_;
  GameObserver game_;

  std::optional<Basis> basis_;
  bool tracked_ = false;  // the newest estimate is good
  std::int64_t events_session_ = 0;
  Timestamp newest_sensor_;
  std::int64_t newest_heard_us_ = 0;  // CLOCK_MONOTONIC
  bool trajectory_due_ = false;
  MessageId newest_;

  ArmWatch arm_;
  TableView home_;
  std::optional<TableCamera> camera_;
  SinglePublisher head_publisher_;
  HeadTrack head_;
  bool hears_head_ = false;
  bool head_is_home_ = true;
  bool is_blind_;
  /// Sensor time minus CLOCK_MONOTONIC, µs.
  std::optional<std::int64_t> sensor_ahead_us_;

  std::optional<std::int64_t> last_trajectory_us_;  // CLOCK_MONOTONIC, as all below
  std::optional<std::int64_t> last_command_us_;
  std::int64_t last_basis_seq_ = -1;
  double last_target_m_ = 0;
  std::optional<std::int64_t> last_game_us_;
  GameBelief published_game_;
  std::int64_t outliers_ = 0;
  std::int64_t frozen_ = 0;
  std::int64_t untrusted_ = 0;
  std::int64_t commands_ = 0;
};

}  // namespace puck
