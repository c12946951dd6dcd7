#pragma once

#include <array>
#include <cstddef>

#include "common/vision/pixel.h"

namespace puck {

/// The simplest tracker there is, as a second opinion: every event within two semi-axes of the blob
/// draws it a little closer. Coarser than the contour by far, but it follows any shot, knows no
/// speed that could run away, and is never published.
class BlobWitness {
 public:
  explicit BlobWitness(Pixel position) { put(position); }

  /// Puts it somewhere else, at rest.
  void put(Pixel position) {
    position_ = position;
    past_.fill(position);
  }

  /// Moves it a share of the way, from 0 to 1, to a place.
  void draw_to(Pixel place, double share) {
    position_.x += share * (place.x - position_.x);
    position_.y += share * (place.y - position_.y);
  }

  /// How large the puck is here. To be called at each decision.
  void set_size(PuckSize size) {
    per_semi_x_ = 2 / size.width;
    per_semi_y_ = 2 / size.height;
  }

  void take(double x, double y) {
    const double dx = x - position_.x;
    const double dy = y - position_.y;
    const double u = dx * per_semi_x_;
    const double v = dy * per_semi_y_;
    if (u * u + v * v >= kGateSquared) return;
    position_.x += kGain * dx;
    position_.y += kGain * dy;
  }

  /// Notes the position for the velocity. To be called at each decision.
  void note() {
    for (std::size_t i = past_.size() - 1; i > 0; --i) past_[i] = past_[i - 1];
    past_[0] = position_;
  }

  Pixel position() const { return position_; }
  /// Over the last 2 ms.
  PixelVelocity velocity() const {
    constexpr double kPer_s = 500;
    return {(past_.front().x - past_.back().x) * kPer_s,
            (past_.front().y - past_.back().y) * kPer_s};
  }

 private:
  static constexpr double kGateSquared = 4;  // two semi-axes
  static constexpr double kGain = 0.015;
  static constexpr std::size_t kPast = 5;

  Pixel position_;
  double per_semi_x_ = 0;
  double per_semi_y_ = 0;
  std::array<Pixel, kPast> past_{};
};

}  // namespace puck
