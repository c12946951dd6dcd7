#pragma once

#include <array>

#include "common/vision/puck_contour.h"

namespace puck {

/// Areas around a contour in which events are counted, px², and what those inside may be.
struct RingAreas {
  double ring = 1;
  double inside = 1;
  double outside = 1;
  /// Of a print on the puck's face: what is denser inside than around the ring is no clutter then.
  bool may_have_print = false;
  /// SideView::sectors.
  int sectors = kContourSectors;
};

/// What events say about a contour, over the last 15 ms, fading: how many lie on it with the right
/// sign, how many with the wrong one, inside it and around it.
class RingEvidence {
 public:
  /// The contour's events lie within this distance of it, px …
  static constexpr double kRing_px = 1.5;
  /// … and what is farther outside than this says nothing.
  static constexpr double kReach_px = 7;
  /// Events fade with this time constant, µs.
  static constexpr double kMemory_us = 15'000;

  static RingAreas areas_of(const ContourRing& ring) {
    return {ring.band_area(kRing_px), ring.inside_area(kRing_px),
            ring.outside_area(kRing_px, kReach_px)};
  }

  void fade(double keep);

  /// Counts an event on the ring; returns what it is worth as evidence, at most 1: less in a
  /// direction that has had more than its share, so that a straight edge is no puck.
  double add_ring(int sector, bool saturates);
  void add_wrong_sign() { wrong_ += 1; }
  /// Count an event well inside the ring, or outside; return what it is worth: at most 0.
  double add_inside(const RingAreas& areas);
  double add_outside(const RingAreas& areas);
  /// For an event that may be of the puck's side wall, outside or inside the ring: it says nothing
  /// of whether the ring stands out, but may be of something on the puck.
  void add_wall(bool is_inside) { (is_inside ? wall_inside_ : wall_outside_) += 1; }
  /// For an event that is counted besides: it is of the same pixel as another of late.
  void add_repeat() { repeats_ += 1; }

  /// So much lies inside the ring, compared with what lies on it, that the face has a print.
  bool shows_print(const RingAreas& areas) const;

  double ring_events() const { return ring_ + wrong_; }
  double inside_events() const { return inside_ + wall_inside_; }
  double near_events() const {
    return ring_ + wrong_ + inside_ + outside_ + wall_inside_ + wall_outside_ - repeats_;
  }

  /// From −1 to 1: how far the ring stands out, less where it covers few directions.
  /// `noise_per_px2`: events that the sensor makes by itself in 15 ms, neither for the ring nor
  /// against it.
  double quality(const RingAreas& areas, double noise_per_px2 = 0) const;
  /// How far the ring stands out from what little there is: few events are no reason to doubt, nor
  /// are few directions; 1 if there is nothing.
  double agreement(const RingAreas& areas) const;
  /// How many more events lie on the ring than its surroundings would put there.
  double strength(const RingAreas& areas) const;
  /// Share of the directions that the ring's events cover, of those in the image; 0 to 1.
  double cover(const RingAreas& areas) const;

 private:
  double stands_out(const RingAreas& areas, double noise_per_px2, double doubt) const;
  // More lies inside than around, but no more than a print makes.
  bool is_print_inside(const RingAreas& areas) const;
  double clutter_density(const RingAreas& areas) const;

  double ring_ = 0;
  double wrong_ = 0;
  double inside_ = 0;
  double outside_ = 0;
  double wall_inside_ = 0;
  double wall_outside_ = 0;
  double repeats_ = 0;
  std::array<double, kContourSectors> sectors_{};
};

}  // namespace puck
