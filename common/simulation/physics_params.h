#pragma once

namespace puck {

/// How the puck glides and bounces.
struct PhysicsParams {
  double damping_1_s = 0.25;           ///< Decay rate of its speed while it glides.
  double rail_normal_keep = 0.85;      ///< Share of the speed across a rail kept by a bounce.
  double rail_tangential_keep = 0.95;  ///< Share of the speed along a rail kept by a bounce.
  double mallet_restitution = 0.8;
  double max_speed_m_s = 15;  ///< Limit of the speed after a hit.
};

}  // namespace puck
