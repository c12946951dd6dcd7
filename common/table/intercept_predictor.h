#pragma once

#include <optional>
#include <vector>

#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

struct InterceptParams {
  double horizon_s = 2.0;          ///< Crossings later than this are not looked for.
  double min_approach_m_s = 0.05;  ///< Slower ones towards the line do not count.
  int max_bounces = 4;             ///< Nothing is predicted beyond.
  /// A puck that stays in the opponent's half for longer is his to hit: nothing is predicted
  /// beyond.
  double opponent_after_s = 0.5;
};

/// Where and when the puck's centre crosses x = `x_m` towards the robot.
struct Intercept {
  double x_m = 0;
  double y_m = 0;
  double in_s = 0;  ///< After the state from which it was predicted.
  double speed_m_s = 0;
  int bounces = 0;  ///< At rails, until then.
  double sigma_y_m = 0;
  double sigma_t_s = 0;
};

/// A place on the predicted path.
struct PathPoint {
  double t_s = 0;  ///< After the state from which it was predicted.
  TablePoint position;
};

/// Predicts where the puck crosses the robot's line. The line is where the puck's rim touches a
/// mallet that stands in its way: the mallet's line, a mallet's radius and a puck's radius on. So a
/// mallet whose centre stands at the crossing's y blocks the puck, from wherever it comes.
class InterceptPredictor {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  explicit InterceptPredictor(const PuckMotion& motion, const InterceptParams& params = {});

  double line_x_m() const { return line_x_m_; }

  /// Nothing when the puck moves away, as it will meet the opponent's mallet before it comes back,
  /// and so where it stays long in the opponent's half; when it is beyond the line, comes to rest
  /// before, or would need longer or more bounces than the parameters allow.
  std::optional<Intercept> predict(const PuckTrack& track) const;

  /// Fills `path` with the predicted places every `step_s` up to `horizon_s`, the bounces between
  /// them included; ends at a goal, at the robot's mallet if it is known, and where the opponent
  /// may have hit.
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
