#pragma once

namespace puck {

/// How the opponent plays and when the puck is served again.
struct GameParams {
  double shot_speed_min_m_s = 1.5;
  double shot_speed_max_m_s = 4.0;
  double bank_share = 0.3;     ///< Share of the shots that go by a side rail.
  double aim_error_deg = 1.5;  ///< Standard deviation of a shot's direction.
  double wait_min_s = 0.15;    ///< A strike starts at least so long after the puck came.
  double wait_max_s = 0.5;
  /// Share of the times that the puck comes to the opponent in which it comes to rest there and is
  /// left so for a while before it is hit.
  double rest_probability = 0;
  double rest_min_s = 1;
  double rest_max_s = 3;
  /// Share of the times that the puck comes to the opponent in which his free hand hides it for a
  /// while.
  double reach_probability = 0;
  double reach_min_s = 0.2;
  double reach_max_s = 0.6;
  double second_puck_speed_m_s = 0;  ///< Of one that glides about by itself; 0: there is none.
  double serve_after_s = 1.0;        ///< The puck is out of play for so long after a goal.
  bool served_at_start = false;      ///< As all later ones; else the first puck lies there.
  double stuck_after_s = 2.0;  ///< A puck that rests for so long, or that the opponent did not
                               ///< hit for three times so long, is taken off and served again.
};

}  // namespace puck
