#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/region.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "common/vision/surface/surface_snapshot.h"

namespace puck {

/// Region and appearance of the puck in a search.
struct SearchRequest {
  Region region;  ///< Of the puck's centre; empty: no search.
  /// Searches for a puck with the opposite assumption on whether its side wall makes events
  /// (ContourCalibration::other_wall_share): its contour has another height.
  bool other_wall = false;
  /// Uses only recently active edges (FreshPixels), where the caller keeps them.
  bool fresh_only = false;

  friend bool operator==(const SearchRequest&, const SearchRequest&) = default;
};

/// A place that looks like the puck.
struct SearchCandidate {
  Pixel position;    ///< Of the puck's centre, given the request's side wall.
  double score = 0;  ///< EllipseKernel::contrast there, or the soft ring's score; 0 to 1.
};

/// Result of a search of a part of the surface.
struct SearchResult {
  Timestamp time;         ///< Newest event on the searched surface.
  SearchRequest request;  ///< The request.
  /// Best first, each at least half a puck from the others; empty: nothing looks like the puck.
  std::vector<SearchCandidate> candidates;
};

/// Interface of the pipelines, which the tracking thread calls, and offline SurfaceTracker. The
/// pipeline names the data that it needs; the caller hands them over in this order:
///
///     pipeline.take(start, events);  // if needs_events(): those since the last call, in pieces
///     pipeline.step(snapshot);       // a copy of region_needed(), not older than these events
///     pipeline.work_off();           // optional, to have the estimate earlier
///
/// and checks search_wanted() after each of the first two calls. A search may take long and runs
/// elsewhere; its result follows when it is done: offline at once, live some steps later. A step
/// follows each result, even without new events, so that the result is published at once.
///
/// A plain object without thread, clock or surface of its own. The same calls give the same
/// estimates, to the bit. One thread at a time.
class TrackingPipeline {
 public:
  virtual ~TrackingPipeline() = default;

  /// Whether the pipeline takes single events. Constant.
  virtual bool needs_events() const = 0;

  /// Events come in pieces that end at multiples of this sensor time, so that decisions between
  /// pieces are made at fixed times; 0: pieces of any length. Constant.
  virtual std::int64_t decision_period_us() const = 0;

  /// Takes events in the order of their times, which are relative to `start`; at least one, and
  /// none across a multiple of the decision period. Live, excess events have been left out evenly.
  virtual void take(Timestamp start, std::span<const Event> events) = 0;

  /// The part of the surface that the next step needs; empty: none, so the snapshot carries only
  /// its stamps.
  virtual Region region_needed() const = 0;

  /// Makes an estimate on a snapshot of region_needed(). Times never go backwards.
  virtual PuckEstimate step(const SurfaceSnapshot& snapshot) = 0;

  /// Does the work that no estimate depends on yet. To be called after a step, when its estimate
  /// has been published; if nobody does, the next take() or decision does it, with the same
  /// results.
  virtual void work_off() {}

  /// The search that the pipeline wants now, if any. Called after each take of events and each
  /// step, but not between a request and its result.
  virtual SearchRequest search_wanted() = 0;

  /// Takes the result of the requested search. Live, the track may be newer than the result.
  virtual void take(const SearchResult& result) = 0;
};

}  // namespace puck
