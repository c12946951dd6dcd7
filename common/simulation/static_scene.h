#pragma once

#include <array>

#include "common/simulation/scene_params.h"
#include "common/simulation/vector3.h"
#include "common/table/table_geometry.h"

namespace puck {

/// The parts that never move: the table with its markings and rails, the floor, the wall behind.
class StaticScene {
 public:
  StaticScene(const TableGeometry& table, const SceneParams& params);

  /// Luminance of the first surface that the ray hits.
  double luminance(Vector3 from, Vector3 direction) const;

 private:
  double table_luminance(double x_m, double y_m) const;
  bool on_line(double x_m, double y_m) const;
  bool on_star(double x_m, double y_m) const;
  bool on_logo(double x_m, double y_m) const;
  double floor_luminance(double x_m, double y_m) const;
  double wall_luminance(double y_m, double z_m) const;

  TableGeometry table_;
  SceneParams params_;
  struct Star {
    double x_m = 0;
    double y_m = 0;
  };
  std::array<Star, 4> stars_;
};

}  // namespace puck
