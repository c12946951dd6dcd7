#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"
#include "common/messaging/single_publisher.h"
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
  std::int64_t probation_us =
      TrackProbationParams{}.probation_us;  ///< As TrackProbationParams has it.
  PuckMotionParams motion;
  MotionFilterParams filter;
  InterceptParams intercept;
  StrategyParams strategy;
  double max_trajectory_hz = 1000;
  double command_hz = 250;  ///< Commands a second; one whose target has moved goes out at once.
  std::int64_t valid_for_us = 100'000;  ///< Of a command.
  /// A camera of which the calibration holds no focal length may turn so far from where it was made
  /// before the table's place counts as unknown, deg.
  double max_head_deg = 0.5;
  HeadTrackParams head;
  /// Without HEAD the table's place counts as unknown. Else the camera counts as fixed until HEAD
  /// is heard for the first time.
  bool needs_head = false;
};

/// From estimates to the puck's motion on the table, the game, and commands for the arm. Fed with
/// messages and times, asked for messages, whose headers it leaves alone. It commands only on a
/// live, believable track, and only an arm that it hears. One thread.
class PlayBridge {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  /// `camera`: nothing when it is not known; then the head is not followed.
  PlayBridge(const PlayBridgeParams& params, const Homography& table_from_image,
             const TableGeometry& table, const std::optional<PinholeCamera>& camera = std::nullopt);

  /// `sender`: the clock of the message's session. An arm's word that is not of now is no arm.
  void hear(const puck_estimate_t& estimate, const HostNow& now, const SenderClock& sender);
  void hear(const arm_state_t& state, const HostNow& now, const SenderClock& sender) {
    arm_.hear(state, now, sender);
  }
  void hear(const head_state_t& head, const HostNow& now);

  /// What is due for publication at `now`; each is due once.
  std::optional<puck_trajectory_t> next_trajectory(const HostNow& now);
  std::optional<arm_command_t> next_command(const HostNow& now);
  std::optional<game_state_t> next_game(const HostNow& now);

  /// Where the camera looks is not known, so neither where the table is: no commands.
  bool is_blind_to_head() const { return is_blind_; }

  /// Whether the arm is heard, so that it can be commanded.
  bool hears_arm(const HostNow& now) const { return arm_.arm(now) != nullptr; }
  /// The session of somebody else whose commands the arm has followed for a while; 0: nobody.
  /// `own_session`: that of the commands that are made here.
  std::int64_t other_commander(std::int64_t own_session, const HostNow& now) const {
    return arm_.other_commander(own_session, now);
  }

  const EstimateGate& gate() const { return gate_; }
  const TrackProbation& probation() const { return probation_; }
  /// Good estimates that did not move the arm: on which nothing new rests, since the sensor's time
  /// stood still under them, and those of a track that is not trusted.
  std::int64_t frozen() const { return frozen_; }
  std::int64_t untrusted() const { return untrusted_; }
  std::int64_t outliers() const { return outliers_; }
  /// How often the track began anew: where the puck was, and elsewhere.
  std::int64_t hits() const { return filter_.hits(); }
  std::int64_t jumps() const { return filter_.jumps(); }
  std::int64_t commands() const { return commands_; }
  const GameBelief& game() const { return game_.belief(); }

 private:
  // The newest good estimate.
  struct Basis {
    std::int64_t session = 0;
    std::int64_t seq = 0;
    Timestamp sensor;              // of its newest event
    Timestamp sensor_at_receipt;   // the sensor's clock when it came
    std::int64_t received_us = 0;  // CLOCK_MONOTONIC
  };

  std::optional<TableView> view_of(Timestamp t) const;
  Timestamp sensor_now(const HostNow& now) const;
  std::optional<PuckTrack> live_track(const HostNow& now) const;
  void follow_session(const puck_estimate_t& estimate, const HostNow& now);

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
  bool tracked_ = false;  // the newest estimate was good
  std::int64_t events_session_ = 0;
  Timestamp newest_sensor_;
  std::int64_t newest_heard_us_ = 0;  // CLOCK_MONOTONIC
  bool trajectory_due_ = false;
  puck_estimate_t newest_{};

  ArmWatch arm_;
  TableView home_;
  std::optional<TableCamera> camera_;
  SinglePublisher head_publisher_;
  HeadTrack head_;
  bool hears_head_ = false;
  bool head_is_home_ = true;
  bool is_blind_;
  /// The sensor's clock less CLOCK_MONOTONIC, µs.
  std::optional<std::int64_t> sensor_ahead_us_;

  std::optional<std::int64_t> last_trajectory_us_;  // CLOCK_MONOTONIC, as all of these
  std::optional<std::int64_t> last_command_us_;
  std::int64_t last_basis_seq_ = -1;
  double last_target_m_ = 0;
  std::optional<std::int64_t> last_game_us_;
  GameBelief published_game_;
  std::vector<PathPoint> path_;
  std::int64_t outliers_ = 0;
  std::int64_t frozen_ = 0;
  std::int64_t untrusted_ = 0;
  std::int64_t commands_ = 0;
};

}  // namespace puck
