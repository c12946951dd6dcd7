#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "common/events/sensor_size.h"
#include "common/vision/contour/contour_filter.h"
#include "common/vision/contour/puck_contour.h"
#include "common/vision/geometry/region.h"
#include "common/vision/hypotheses/decision_params.h"
#include "common/vision/hypotheses/evidence.h"
#include "common/vision/hypotheses/puck_belief.h"

namespace puck {

/// An event as the hypotheses take it.
struct TimedEvent {
  std::int64_t time_us = 0;
  float x = 0;
  float y = 0;
  bool on = false;
  bool first = false;  ///< EventHistory::is_first.
};

/// What is the same for all hypotheses of a tracker.
struct TrackingContext {
  PuckContour contour;
  ContourFilterParams filter;
  EvidenceParams evidence;
  DecisionParams decision;
  GameTraits game;
};

/// One possible puck: a contour filter on single events, and the belief that it is the puck.
class Hypothesis {
 public:
  enum class Origin : std::uint8_t {
    kSearch,     ///< A search saw something there.
    kManoeuvre,  ///< The puck was stopped, hit or bounced just now.
    kWall,       ///< The side wall makes events, or makes none, contrary to what was assumed.
  };

  Hypothesis(Origin origin, const ContourFilter::Start& start, double wall_share, double log_odds,
             std::int64_t time_us, const TrackingContext& context);

  /// Takes events in the order of their times.
  void take(std::span<const TimedEvent> events, const TrackingContext& context);

  /// Moves on to a decision, if that is later than the last. Returns true when a packet of evidence
  /// was full, and is in packet().
  bool decide(std::int64_t time_us, const TrackingContext& context);

  /// A hypothesis about the same object as `parent` takes over what is known of its looks.
  void inherit(const Hypothesis& parent);

  /// Factor of the odds that it is a mark: mark_prior until it has moved by itself.
  double mark() const { return mark_prior * own_motion.mark(); }

  /// Takes over the belief of another hypothesis of the same state, which is to be removed.
  void merge(const Hypothesis& other);

  Origin origin() const { return origin_; }
  const ContourFilter& filter() const { return filter_; }
  const PuckBelief& belief() const { return belief_; }
  /// PuckContour::ring_at's.
  double wall_share() const { return wall_share_; }
  const ContourRing& ring() const { return ring_; }
  /// Time constant of its speed.
  double damping_s() const;
  double width_px() const { return 2 * ring_.half_width(); }
  /// The pixels whose events of the next `seconds` take() may use.
  Region reach(double seconds) const;
  std::int64_t decided_us() const { return decided_us_; }
  /// The last full packet, and what it said.
  const EvidencePacket& packet() const { return closed_; }
  double nats() const { return nats_; }
  /// Areas of the contour, and the expected contour events a swept px²; of packet() right after
  /// decide() has returned true.
  const EvidenceAreas& areas() const { return areas_; }
  double expected_density() const { return expected_density_; }

  std::int64_t born_us() const { return born_us_; }
  /// When it last had more than a few events that noise does not explain.
  std::int64_t heard_us() const { return heard_us_; }
  int packets() const { return packets_; }
  /// Events near the contour since the last decision.
  double recent_events() const { return recent_events_; }

  OwnMotion own_motion;
  /// Factor of the odds that it is a mark of the scene, from where it was found.
  double mark_prior = 1;
  /// It has been counted in GameTraits::marks.
  bool is_counted_mark = false;
  /// Among all hypotheses, as of the last decision.
  double posterior = 0;
  /// Probability that the puck is seen elsewhere, as of the last decision.
  double elsewhere = 0;
  /// It has been the track.
  bool was_main = false;
  /// Its object has never been the track.
  bool is_newcomer = true;

 private:
  bool is_beyond_gate(double distance, const ContourOffset& offset,
                      const DecisionParams& params) const;
  void follow_contour(const TrackingContext& context);
  void sweep(double seconds, SensorSize sensor, double leading_share);
  void measure_clutter(double seconds);
  void take_back(std::int64_t time_us);
  void slow_down(const TrackingContext& context);
  double density(const GameTraits& game) const;

  Origin origin_;
  ContourFilter filter_;
  PuckBelief belief_;
  double wall_share_;
  ContourRing ring_;
  EvidenceAreas areas_;
  double seen_ = 1;  // share of the contour that lies in the image
  EvidencePacket open_;
  EvidencePacket closed_;
  double nats_ = 0;
  double expected_density_ = 0;
  std::int64_t born_us_;
  std::int64_t decided_us_;
  std::int64_t heard_us_;
  int packets_ = 0;
  double recent_events_ = 0;
  // Of the repeated events every stride_-th is used, with that weight: they say little more of an
  // edge than the first of their pixel.
  int stride_ = 1;
  int repeats_ = 0;  // since the last decision
  // Since the last decision: events near the contour, and those of them that are not on it.
  double counted_ = 0;
  double beside_ = 0;
  double clutter_px2_s_ = 0;  // events beside the contour, fading
  // Of this hypothesis alone, fading.
  double own_dark_ = 0;
  double own_bright_ = 0;
  double own_events_ = 0;
  double own_swept_ = 0;
  ContourFilter start_filter_;  // when the packet began
};

}  // namespace puck
