#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/vision/geometry/pixel.h"

namespace puck {

/// How a camera that only turns has turned since the start: where a pixel of now lies in the image
/// of then, however far away what it shows is. The focal length may be rough: it only says by how
/// much more the image's border moves than its middle.
class CameraTurn {
 public:
  /// Small turns, each as the px by which it moves the image: to the side, up and down, and, about
  /// the optical axis, at a focal length from the middle.
  using Steps = std::array<double, 3>;

  CameraTurn(Pixel middle, double focal_px) : middle_(middle), focal_px_(focal_px) {}

  Pixel then_of(Pixel now) const { return seen_by(turn_, now); }
  /// The inverse: where a pixel of then lies in the image of now.
  Pixel now_of(Pixel then) const {
    const auto& t = turn_;
    return seen_by({t[0], t[3], t[6], t[1], t[4], t[7], t[2], t[5], t[8]}, then);
  }

  /// By how much a pixel of then moves along x and y for each px of the steps.
  struct Slopes {
    Steps x;
    Steps y;
  };
  Slopes slopes_at(Pixel then) const {
    const double x = (then.x - middle_.x) / focal_px_;
    const double y = (then.y - middle_.y) / focal_px_;
    return {{1 + x * x, x * y, -y}, {x * y, 1 + y * y, x}};
  }

  /// Turns it by so much more.
  void turn(const Steps& steps);

 private:
  using Rotation = std::array<double, 9>;  // row by row

  // Where what is at a place is in the image of a camera whose rays are turned so.
  Pixel seen_by(const Rotation& rays, Pixel place) const {
    const double x = (place.x - middle_.x) / focal_px_;
    const double y = (place.y - middle_.y) / focal_px_;
    const double depth = rays[6] * x + rays[7] * y + rays[8];
    return {middle_.x + focal_px_ * (rays[0] * x + rays[1] * y + rays[2]) / depth,
            middle_.y + focal_px_ * (rays[3] * x + rays[4] * y + rays[5]) / depth};
  }

  Pixel middle_;
  double focal_px_;
  Rotation turn_{1, 0, 0, 0, 1, 0, 0, 0, 1};  // rays of then from rays of now
};

/// How a camera has turned of late, from which follows how fast the image of what stands still
/// moves, under a shaking head as well. One thread at a time.
class TurnTrail {
 public:
  /// How the camera is turned at `time_us`, later than at the last call.
  void note(const CameraTurn& turn, std::int64_t time_us);
  /// Forgets all notes.
  void clear() { count_ = 0; }

  /// Velocity of what stands still and is at `place` as of the last note, px/s; none before kNotes
  /// notes.
  std::optional<PixelVelocity> still_velocity_at(Pixel place) const;

 private:
  struct Note {
    CameraTurn turn{{}, 1};
    std::int64_t time_us = 0;
  };
  // At one a millisecond: over fewer the alignment's noise shows, over more a shake is missed.
  static constexpr std::size_t kNotes = 12;

  std::array<Note, kNotes> notes_;  // a ring
  std::size_t count_ = 0;
};

}  // namespace puck
