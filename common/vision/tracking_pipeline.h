#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/timestamp.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_estimate.h"
#include "common/vision/region.h"
#include "common/vision/sighting_trail.h"
#include "common/vision/surface_snapshot.h"

namespace puck {

/// What the surface is searched for, and where.
struct SearchRequest {
  Region region;  ///< Of the puck's centre; empty: nothing is searched for.
  /// A puck whose side wall makes events where the calibration says that it does not, or the other
  /// way round (ContourCalibration::other_wall_share): its contour is of another height.
  bool other_wall = false;
  /// PuckContour::other_wall_share as the tracker knows it by now; 0: as it is calibrated.
  double other_wall_share = 0;
  /// Only edges that have made events of late are looked at (FreshPixels), where that is known
  /// (PipelineParams::searches_fresh).
  bool fresh_only = false;

  friend bool operator==(const SearchRequest&, const SearchRequest&) = default;
};

/// A place that looks like the puck.
struct SearchCandidate {
  Pixel position;    ///< Of the puck's centre, if it has the side wall that was searched for.
  double score = 0;  ///< EllipseKernel::contrast there, 0 to 1.
  /// Along which earlier searches have found it. A search leaves it out; the tracker fills it in
  /// where it counts.
  SightingTrail trail;
};

/// What a search of a part of the surface found.
struct SearchResult {
  Timestamp time;         ///< Newest event on the surface that was searched.
  SearchRequest request;  ///< What was searched for.
  /// Best first, each at least half a puck from the others; empty: nothing looks like the puck.
  std::vector<SearchCandidate> candidates;
};

/// What the tracking thread drives, and offline SurfaceTracker. The pipeline says what it needs;
/// whoever drives it hands that over, in this order:
///
///     pipeline.take(start, events);  // those of events_needed() since the last time, in pieces
///     pipeline.step(snapshot);       // a copy of region_needed(), not older than these events
///
/// and after each of the two looks at search_wanted(). A search may take long and runs elsewhere;
/// its result comes back when it is done: offline at once, live some steps later. A step follows
/// it, even when there is nothing new, so that what was found is told at once.
///
/// A plain object without thread, clock or surface of its own. The same calls give the same
/// estimates, to the bit. One thread at a time.
class TrackingPipeline {
 public:
  virtual ~TrackingPipeline() = default;

  /// Region whose single events are wanted; empty: none. May change with each take and step.
  virtual Region events_needed() const = 0;

  /// Events are handed over in pieces that end at multiples of this sensor time, so that what is
  /// decided between two pieces is decided at fixed times; 0: no matter. Constant.
  virtual std::int64_t decision_period_us() const = 0;

  /// Takes events in the order of their times, which are relative to `start`; at least one, all in
  /// events_needed(), and with no multiple of the decision period between them. Live, they have
  /// been thinned evenly when there were too many.
  virtual void take(Timestamp start, std::span<const Event> events) = 0;

  /// The part of the surface that the next step looks at; empty: none of it, the snapshot then
  /// carries only its stamps.
  virtual Region region_needed() const = 0;

  /// Makes an estimate on a snapshot of region_needed(). Times never go backwards.
  virtual PuckEstimate step(const SurfaceSnapshot& snapshot) = 0;

  /// What is to be searched for now, if anything. Asked after each take of events and each step,
  /// but not from when it has answered until the result has come.
  virtual SearchRequest search_wanted() = 0;

  /// Takes the result of the search that was wanted. Live, it may be older than what has been
  /// tracked since.
  virtual void take(const SearchResult& result) = 0;
};

}  // namespace puck
