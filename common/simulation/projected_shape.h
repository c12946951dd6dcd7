#pragma once

#include <variant>

#include "common/simulation/camera_view.h"
#include "common/simulation/convex_outline.h"
#include "common/simulation/vector3.h"
#include "common/table/table_point.h"
#include "common/vision/pixel.h"
#include "common/vision/region.h"

namespace puck {

/// An upright box around something in the image, in fractions of a pixel.
struct PixelBox {
  Pixel centre;
  PuckSize size;
};

/// An upright cylinder that stands on or above the table, as a camera sees it.
class ProjectedCylinder {
 public:
  ProjectedCylinder(const CameraView& view, TablePoint centre, double radius_m, double bottom_m,
                    double top_m);

  /// For `count` pixels from column `first` of row `y` on: the share of each that it covers.
  void coverage(int y, int first, int count, float* shares) const;
  const ConvexOutline& outline() const { return outline_; }
  /// Around the silhouette, exactly.
  PixelBox box() const { return box_; }

 private:
  Vector3 centre_to_camera_;
  Vector3 first_ray_;  ///< Of pixel (0, 0).
  Vector3 ray_x_;      ///< Change of the ray from pixel to pixel in a row …
  Vector3 ray_y_;      ///< … and from row to row.
  double radius_m_;
  double bottom_m_;
  double top_m_;
  PixelBox box_;
  ConvexOutline outline_;
};

/// A rod with round ends, thick as given at each: a hand with its forearm.
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

/// A shape of one tone.
struct SceneShape {
  std::variant<ProjectedCylinder, ProjectedCapsule> shape;
  float luminance = 0;
  /// It is the shape before it and more: a puck's top and then the whole of it, of which only the
  /// side is left to be seen.
  bool holds_previous = false;

  const ConvexOutline& outline() const {
    return std::visit([](const auto& s) -> const ConvexOutline& { return s.outline(); }, shape);
  }
  void coverage(int y, int first, int count, float* shares) const {
    std::visit([&](const auto& s) { s.coverage(y, first, count, shares); }, shape);
  }
};

}  // namespace puck
