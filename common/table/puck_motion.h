#pragma once

#include <optional>

#include "common/table/puck_track.h"
#include "common/table/table_geometry.h"

namespace puck {

/// How the puck glides and bounces. The defaults were measured by others on a table of this class.
struct PuckMotionParams {
  double damping_per_s = 0.23;     ///< v' = -damping v.
  double rail_restitution = 0.79;  ///< Share of the speed towards a rail that a bounce returns.
  double rail_grip = 0.84;         ///< Share of the speed along a rail that a bounce keeps.
  /// Standard deviation that the velocity gains in one second of gliding, m/s. Larger follows
  /// unmodelled forces sooner; smaller predicts more steadily.
  double velocity_noise_m_s = 0.01;
  /// Standard deviation of the velocity after a bounce, as a share of the speed before it. The
  /// default is for a table with unknown constants: they differ by as much between tables.
  double bounce_spread = 0.1;
};

/// The puck's motion on the table: gliding with linear damping, and bounces of its rim off the
/// rails and goal posts, which are points. Mallets are not modelled. An end rail is open at the
/// goal.
class PuckMotion {
 public:
  enum class LegEnd {
    kTimeUp,  ///< Still gliding.
    kBounce,  ///< Just after a bounce off a rail or a post.
    kGoal,    ///< In a goal with its whole disc, and assumed to rest there.
  };
  struct Leg {
    PuckTrack track;  ///< The track at the leg's end.
    double duration_s = 0;
    LegEnd end = LegEnd::kTimeUp;
  };
  struct Advanced {
    PuckTrack track;
    int bounces = 0;
    bool in_goal = false;
  };

  /// Throws std::invalid_argument that names the key when a value is out of range.
  explicit PuckMotion(const TableGeometry& table, const PuckMotionParams& params = {});

  const TableGeometry& table() const { return table_; }
  const PuckMotionParams& params() const { return params_; }

  /// Gliding only, without rails. `dt_s` must not be negative.
  PuckTrack glide(const PuckTrack& start, double dt_s) const;
  /// Gliding time to x = `x_m`, s; infinity when the puck comes to rest before it, or moves away.
  double time_to_x(const PuckState& start, double x_m) const;

  /// Up to and including the next bounce, but at most `limit_s`.
  Leg next_leg(const PuckTrack& start, double limit_s) const;
  /// The track after `dt_s`, through all bounces in between.
  Advanced advance(const PuckTrack& start, double dt_s) const;

 private:
  /// Contact with a goal post.
  struct Contact {
    double after_s = 0;
    double normal_x = 0;  ///< Unit vector towards the puck.
    double normal_y = 0;
  };

  std::optional<Contact> next_post(const PuckState& start) const;
  /// The track after a bounce. The contact's normal turns by the last argument per metre along the
  /// rail.
  PuckTrack bounced(const PuckTrack& at, double normal_x, double normal_y,
                    double curvature_1_m) const;

  TableGeometry table_;
  PuckMotionParams params_;
};

}  // namespace puck
