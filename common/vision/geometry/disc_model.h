#pragma once

#include "common/vision/geometry/pixel.h"

namespace puck {

/// Thickness of an ordinary puck, in diameters: 1.2 cm of 6.5 cm.
inline constexpr double kOrdinaryThickness = 0.19;
/// Upper bound on a wall's visible height, in widths.
inline constexpr double kHighestWall = 0.5;

/// The image of a flat cylinder, the puck, that lies on a plane in front of a pinhole camera: what
/// the paper's Equation (2) approximates by two planes.
///
/// With the plane's unit normal n, the camera's distance H from it, the focal length f, the puck's
/// diameter D and a pixel's ray d = ((x − cx) / f, (y − cy) / f, 1), the plane lies in the depth
/// H / (n·d). A length along the horizon at that depth is f (n·d) / H times as long in the image:
///   w = D f / H · (n·d),                                affine in x and y, zero at the horizon.
/// A length along the plane away from the camera is shortened once more by n·d:
///   disc height = w (n·d) = w² / face_on,               face_on = D f / H,
/// and slants with κ = dx/dy = (x − cx) / (y − horizon), which widens the box to √(w² + κ²
/// height²). A thickness T = thickness · D adds w T/D (1 / cos φ − (n·d) tan φ) to the height, φ
/// being the tilt of the optical axis below the horizon: sin φ is n·d in the principal point. To
/// the sides the upper rim leans outward by w T/D sin φ |x − cx| / f, which widens the box, too. So
/// the boxes' widths and heights fix w's three coefficients, face_on, the thickness, and, weakly,
/// cx; f is face_on cos φ over w's growth from row to row.
struct DiscModel {
  /// The width beyond the horizon.
  static constexpr double kSmallestWidth_px = 1e-3;

  double width_0 = 0;  ///< w at the image's top left corner, px, and its growth, px/px.
  double width_x = 0;
  double width_y = 0;
  double face_on_px = 1;      ///< Diameter as it would be seen from straight above.
  double thickness = 0;       ///< Of the puck, in diameters.
  double principal_x_px = 0;  ///< Where the optical axis meets the image.
  double principal_y_px = 0;

  PuckSize at(Pixel position) const;
  /// Height that the thickness adds in the image's middle, in widths. 0 below the thickness of any
  /// puck: the annotations leave the wall out.
  double wall_of_width() const;
  /// The same for an ordinary puck.
  double ordinary_wall() const;
  /// A wall's visible height relative to that in the image's middle, both in widths: it grows with
  /// the distance.
  double wall_profile(Pixel position) const;
  /// Tilt of the optical axis below the horizon, degrees.
  double tilt_deg() const;
  double focal_px() const;
  /// Whether the sizes grow enough towards the camera for tilt and focal length to mean anything.
  bool has_perspective() const;

 private:
  double width_at(Pixel position) const;
  double sine_of_tilt() const;
};

}  // namespace puck
