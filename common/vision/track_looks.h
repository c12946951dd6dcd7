#pragma once

#include "common/vision/pixel.h"

namespace puck {

/// What a decision about a track regards: ContourTrack::looks() of its last decision, or numbers
/// of a test's own.
struct TrackLooks {
  Pixel position;
  double speed_px_s = 0;
  double turning_px_s = 300;  ///< PuckContour::turning_px_s().
  double slide = 1;           ///< ContourFilter::slide().
  /// By how much its contour is larger than the size model says, less what brightness makes of it,
  /// what it may be larger by at the image's sides, and smaller by when it is fast.
  double growth_px = 0;
  double quality = 0;    ///< From −1 to 1.
  double agreement = 0;  ///< From −1 to 1: quality, but that few events are no reason to doubt.
  double clarity = 0;    ///< From −1 to 1: quality, but that the sensor's noise says nothing.
  /// From −1 to 1: quality, were what lies inside a print on the puck's face.
  double printed_quality = 0;
  double strength = 0;  ///< How many more events lie on the ring than clutter would put there.
  double cover = 0;     ///< RingEvidence::cover.
  /// On the ring, inside and around it, of late, but neither repeats nor noise.
  double near_events = 0;
  double inside_events = 0;  ///< Well inside the ring, of late, no noise, but repeats as well.

  /// Believed as it stands.
  constexpr bool is_good() const { return quality > 0.5 && strength > 6; }
  /// Faster than the head's turn could move what is fixed to the table.
  constexpr bool is_fast() const { return speed_px_s > turning_px_s; }
  /// It may only seem to move, along two parallel edges: a line's, a tile's, an arm's.
  constexpr bool may_slide() const { return slide > 1.5; }
  /// Far more of its events lie on the ring than chance puts there.
  constexpr bool is_strong() const { return strength > 25; }
  /// … and of those so many that hardly anything but a puck or a mallet has them.
  constexpr bool is_very_strong() const { return strength > 80; }
  /// It moves as nothing that is fixed to the table does, and is no larger than a puck, with events
  /// on enough sides.
  constexpr bool moves_as_pucks_do() const { return is_fast() && cover > 0.35 && !is_oversized(); }
  /// It moves as a puck does, is hardly larger than one, and so strong that it is one even if what
  /// lies beside or on it spoils its quality; stronger yet, if it looks a little large.
  constexpr bool is_clear() const {
    return moves_as_pucks_do() && quality > 0.6 && is_very_strong() &&
           (!is_large() || strength > 300);
  }
  /// Larger than most pucks.
  constexpr bool is_large() const { return growth_px >= 0.35; }
  /// Events on most sides, and of the puck's size: a hand or a mallet is no such ring, or a larger
  /// one.
  constexpr bool is_whole_ring() const { return cover > 0.5 && !is_large(); }
  /// A mallet's contour, followed as a puck's, makes it look larger.
  constexpr bool is_oversized() const { return growth_px >= 0.45; }
  /// No puck's contour is so much smaller than the calibration's.
  constexpr bool is_undersized() const { return growth_px <= -0.6; }
  /// Of what is no puck most has to grow or to shrink to lie on a puck's ring.
  constexpr bool has_pucks_size() const { return !is_large() && growth_px > -0.35; }
  /// Something is on the puck, a hand or a mallet; or a print, while it moves.
  constexpr bool is_covered() const { return inside_events > 12; }
  /// Next to nothing happens there.
  constexpr bool is_quiet() const { return near_events < 6; }
};

}  // namespace puck
