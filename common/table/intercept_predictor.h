#pragma once

#include <optional>
#include <vector>

#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

struct InterceptParams {
  double horizon_s = 2.0;          ///< Latest crossing that is searched for.
  double min_approach_m_s = 0.05;  ///< Slower crossings are ignored.
  int max_bounces = 4;             ///< The prediction ends after this many bounces.
  /// A puck that stays in the opponent's half for longer may be hit by him: the prediction ends.
  double opponent_after_s = 0.5;
};

/// Time and place at which the puck's centre crosses x = `x_m` towards the robot.
struct Intercept {
  double x_m = 0;
  double y_m = 0;
  double in_s = 0;  ///< Time from the predicted state.
  double speed_m_s = 0;
  int bounces = 0;  ///< Rail bounces before the crossing.
  double sigma_y_m = 0;
  double sigma_t_s = 0;
};

/// A point of the predicted path.
struct PathPoint {
  double t_s = 0;  ///< Time from the predicted state.
  TablePoint position;
};

/// Predicts where the puck crosses the robot's line: x of the puck's centre when its rim touches a
/// mallet on the line, that is the mallet's line plus both radii. A mallet whose centre is at the
/// crossing's y blocks the puck from every direction.
class InterceptPredictor {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit InterceptPredictor(const PuckMotion& motion, const InterceptParams& params = {});

  double line_x_m() const { return line_x_m_; }

  /// `std::nullopt` when the puck moves away or stays long in the opponent's half (the opponent may
  /// hit it first), is beyond the line, comes to rest before it, or would need longer or more
  /// bounces than the parameters allow.
  std::optional<Intercept> predict(const PuckTrack& track) const;

  /// Fills `path` with the predicted points every `step_s` up to `horizon_s`, including the bounces
  /// between them; ends at a goal, at the robot's mallet if known, and where the opponent may hit.
  void predict_path(const PuckTrack& track, const std::optional<TablePoint>& robot_mallet,
                    double horizon_s, double step_s, std::vector<PathPoint>& path) const;

 private:
  bool is_in_opponents_half(const PuckTrack& track) const {
    return track.state.position.x_m > motion_.table().length_m / 2;
  }

  PuckMotion motion_;
  InterceptParams params_;
  double line_x_m_;
};

}  // namespace puck
