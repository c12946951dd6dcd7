#pragma once

namespace puck {

/// How the opponent plays and when the puck is served again.
struct GameParams {
  double shot_speed_min_m_s = 1.5;
  double shot_speed_max_m_s = 4.0;
  double bank_share = 0.3;     ///< Share of the shots that bounce off a side rail.
  double aim_error_deg = 1.5;  ///< Standard deviation of a shot's direction.
  double wait_min_s = 0.15;    ///< Shortest wait from the puck's arrival to the strike.
  double wait_max_s = 0.5;
  /// Probability, each time the puck comes to the opponent, that it rests there before it is hit.
  double rest_probability = 0;
  double rest_min_s = 1;
  double rest_max_s = 3;
  /// Probability, each time the puck comes to the opponent, that his free hand hides it for a
  /// while.
  double reach_probability = 0;
  double reach_min_s = 0.2;
  double reach_max_s = 0.6;
  double second_puck_speed_m_s = 0;  ///< Of a puck outside the game; 0: no such puck.
  double serve_after_s = 1.0;        ///< Time without a puck after a goal.
  bool served_at_start = false;      ///< If not, the first puck lies on the table.
  double stuck_after_s = 2.0;  ///< A puck that rests this long, or that the opponent does not hit
                               ///< for three times this long, is taken off and served again.
};

}  // namespace puck
