#pragma once

#include <cstdint>

#include "common/vision/contour_filter.h"
#include "common/vision/contour_params.h"
#include "common/vision/puck_contour.h"
#include "common/vision/puck_signature.h"
#include "common/vision/recent_pixels.h"
#include "common/vision/ring_evidence.h"
#include "common/vision/track_looks.h"
#include "common/vision/wall_edge.h"

namespace puck {

/// An event as the contour tracks take it.
struct ContourEvent {
  std::int64_t time_us = 0;
  double x = 0;
  double y = 0;
  bool on = false;
  bool first = false;  ///< Its pixel has not fired with this sign of late.
  bool still = false;  ///< It is of something that stands still while the head turns.
};

/// What is the same for all contour tracks of a tracker.
struct ContourContext {
  PuckContour contour;
  ContourFilterParams filter;
  ContourIngredients ingredients;
  PuckSignature signature;
  /// Whether the signature was learned from a track that is beyond doubt.
  bool is_trusted = false;
  /// Whether the puck that is followed is known to have no print on its face.
  bool is_plain = false;
  /// Nothing is tracked yet.
  bool is_first = false;
  /// NoiseFloor's.
  double noise_per_pixel_us = 0;
  /// SideWatch's.
  bool may_be_aside = false;
};

/// One belief about where the puck is: a filter that events correct, and what the events of the
/// last milliseconds say about it.
class ContourTrack {
 public:
  ContourTrack(const ContourContext& context, const ContourFilter::Start& start,
               std::int64_t time_us, double wall_share);

  /// Takes an event; returns what it says for this track: above 0 for it, below 0 against it, 0 if
  /// it says nothing: it lies too far off, or may be of a print on the puck's face.
  double take(const ContourEvent& event, const ContourContext& context);

  /// Moves on to a decision: fades the evidence and judges it. `blind`: unsupported for long.
  void decide(std::int64_t time_us, bool blind, const ContourContext& context);

  /// To be called at each decision while the puck rests: keeps the track sure of its place, and
  /// stray events from moving it.
  void park();

  /// A puck at rest sets off: it may have any speed.
  void set_off() { filter_.restart(filter_.start_at(filter_.position())); }

  /// A puck at rest is here now, and moves with the scene of a turning head.
  void carry_to(Pixel position, PixelVelocity velocity, const ContourContext& context);

  /// A search saw the puck so far from where this track has it.
  void correct_place(double dx, double dy, const ContourContext& context);

  /// Puts the track at rest somewhere. What speaks for a faint puck is of where it has been
  /// before, and does not count any more.
  void stop_at(Pixel position, std::int64_t time_us, const ContourContext& context);

  /// Nothing speaks for this track any more, until new events do.
  void forget_evidence();

  const ContourFilter& filter() const { return filter_; }
  /// PuckContour::ring_at's, as this track believes it.
  double wall_share() const { return wall_share_; }
  /// As of the last decision, from −1 to 1.
  double quality() const { return quality_; }
  /// The same without regard to how many events there are.
  double shape_quality() const { return shape_quality_; }
  /// All that is decided by.
  TrackLooks looks() const;
  bool is_good() const { return looks().is_good(); }
  /// Contour events that are to be expected in the memory of the evidence; 0 while it is not known.
  double expected_events(const PuckSignature& signature) const;
  /// When the last event on the ring came, and where the puck was then.
  std::int64_t last_ring_us() const { return last_ring_us_; }
  Pixel last_ring_position() const { return last_ring_position_; }
  /// Events since then that lay beside the ring.
  int clutter_since_ring() const { return clutter_since_ring_; }
  /// What was gathered for the signature since the last call.
  PuckSignature::Sample take_sample();

 private:
  void follow_contour(const ContourContext& context);
  double swept_px2_per_s() const;
  double bloom_px(const ContourContext& context) const;
  double smear_px(const ContourContext& context) const;
  // By how much it is larger or smaller than brightness, its place in the image and its speed
  // explain.
  double unexplained_growth_px() const;
  double shape_penalty(const ContourContext& context) const;
  double purity(const ContourContext& context) const;
  double contrast_sign(const ContourContext& context) const;
  // Like PuckSignature::contrast_sign, of the track's own events of late.
  double own_contrast() const;

  ContourFilter filter_;
  double turning_px_s_;  // PuckContour's, which looks() has no context to ask for
  double wall_share_;
  // It has been faster than what is fixed to the table, so that what lies in its middle may be a
  // print: a mark with something in its middle is no puck.
  bool has_moved_ = false;
  ContourRing ring_;
  Pixel ring_made_at_;
  RingAreas areas_;
  WallEdge wall_edge_;
  RingEvidence evidence_;
  RecentPixels recent_pixels_;
  double quality_ = 0;
  double clarity_ = 0;
  double printed_quality_ = 0;
  double shape_quality_ = 0;
  double strength_ = 0;
  double bloom_px_ = 0;  // by how much it looks larger than it is
  double smear_px_ = 0;  // by how much it may look smaller
  // Events that the sensor makes by itself in the memory of the evidence.
  double ring_noise_ = 0;
  double inside_noise_ = 0;
  double near_noise_ = 0;
  std::int64_t decided_us_ = 0;
  bool blind_ = false;
  bool is_parked_ = false;  // until the next decision
  std::int64_t last_ring_us_ = 0;
  Pixel last_ring_position_;
  int clutter_since_ring_ = 0;
  PuckSignature::Sample sample_;
  int recent_events_ = 0;      // believed since the last decision
  double signed_speed_ = 0;    // Σ p·(n·v) of the events on the ring, fading
  double absolute_speed_ = 0;  // Σ |n·v|
};

}  // namespace puck
