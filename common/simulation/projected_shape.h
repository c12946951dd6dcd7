#pragma once

#include <variant>

#include "common/simulation/camera_view.h"
#include "common/simulation/convex_outline.h"
#include "common/simulation/vector3.h"
#include "common/table/table_point.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// An upright box in the image, with sub-pixel edges.
struct PixelBox {
  Pixel centre;
  PuckSize size;
};

/// The image of an upright cylinder that stands on or above the table.
class ProjectedCylinder {
 public:
  ProjectedCylinder(const CameraView& view, TablePoint centre, double radius_m, double bottom_m,
                    double top_m);

  /// Writes to `shares` how much of each of `count` pixels from column `first` of row `y` it
  /// covers, from 0 to 1.
  void coverage(int y, int first, int count, float* shares) const;
  const ConvexOutline& outline() const { return outline_; }
  /// The exact bounding box of the silhouette.
  PixelBox box() const { return box_; }

 private:
  Vector3 centre_to_camera_;
  Vector3 first_ray_;  ///< Ray of pixel (0, 0).
  Vector3 ray_x_;      ///< Change of the ray from pixel to pixel in a row.
  Vector3 ray_y_;      ///< Change of the ray from row to row.
  double radius_m_;
  double bottom_m_;
  double top_m_;
  PixelBox box_;
  ConvexOutline outline_;
};

/// A rod with round ends of different radius: a hand with its forearm.
class ProjectedCapsule {
 public:
  ProjectedCapsule(const CameraView& view, Vector3 from, double from_radius_m, Vector3 to,
                   double to_radius_m);

  void coverage(int y, int first, int count, float* shares) const;
  const ConvexOutline& outline() const { return outline_; }

 private:
  struct Circle {
    Pixel centre;
    double radius_px = 0;
  };
  static Circle circle_of(const CameraView& view, Vector3 centre, double radius_m);

  Circle from_;
  Circle to_;
  ConvexOutline outline_;
};

/// A shape of uniform luminance.
struct SceneShape {
  std::variant<ProjectedCylinder, ProjectedCapsule> shape;
  float luminance = 0;
  /// The shape contains the previous one, which hides part of it: a puck's top, then the whole
  /// puck, of which only the side remains visible.
  bool holds_previous = false;

  const ConvexOutline& outline() const {
    return std::visit([](const auto& s) -> const ConvexOutline& { return s.outline(); }, shape);
  }
  void coverage(int y, int first, int count, float* shares) const {
    std::visit([&](const auto& s) { s.coverage(y, first, count, shares); }, shape);
  }
};

}  // namespace puck
