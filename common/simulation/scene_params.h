#pragma once

namespace puck {

/// Appearance of the table and the objects on it. Luminances are relative; only ratios matter.
struct SceneParams {
  double table_luminance = 0.60;
  double line_luminance = 0.24;  ///< Centre line, circles, goal arcs.
  double star_luminance = 0.30;  ///< The four stars.
  double rail_luminance = 0.30;
  double goal_luminance = 0.10;  ///< The openings in the end rails.
  double puck_luminance = 0.18;
  double puck_side_luminance = 0;   ///< Luminance of the puck's side wall; 0: as its top.
  double puck_print_luminance = 0;  ///< Luminance of a ring printed on its top; 0: no ring.
  double mallet_luminance = 0.42;
  double skin_luminance = 0.50;   ///< Hand and forearm of the opponent.
  double robot_luminance = 0.70;  ///< Hand and forearm of the robot.
  double floor_luminance = 0.20;
  double floor_contrast = 0.8;   ///< Contrast of the floor's tiles, in ln(luminance).
  double wall_luminance = 0.45;  ///< Wall behind the opponent.

  /// Round logos printed on the table, at fixed places away from the markings and each other.
  static constexpr int kMostLogos = 8;
  int logo_count = 0;
  double logo_radius_m = 0.0325;
  double logo_luminance = 0.18;

  double line_width_m = 0.012;
  double circle_radius_m = 0.15;    ///< Radius of the circle in the middle.
  double goal_arc_radius_m = 0.34;  ///< Radius of the arc around the middle of each goal.
  double star_radius_m = 0.05;      ///< Radius to a star's points.
  double rail_width_m = 0.07;
  double puck_height_m = 0.012;  ///< Thickness of the puck.
  /// Radius to the middle of the printed ring, which must fit on the puck's top, and the ring's
  /// width.
  double puck_print_radius_m = 0.021;
  double puck_print_width_m = 0.005;
  double mallet_height_m = 0.03;  ///< Height of a mallet's base.
  double table_height_m = 0.81;   ///< Height of the playing surface above the floor.
};

}  // namespace puck
