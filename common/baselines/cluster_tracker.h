#pragma once

#include <cstdint>
#include <optional>

#include "common/baselines/puck_seed.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"

namespace puck {

/// The defaults are those of the public port (event-driven v1.7). The parts that concern its pool
/// of trackers (choice of the likeliest tracker, freeing, repulsion, their thresholds) do not apply
/// to a single tracker and are left out.
struct ClusterTrackerParams {
  /// Share of the distance to each event by which the position moves. Larger follows faster pucks,
  /// with more jitter.
  double position_share = 0.1;
  /// Weight of each event in the shape.
  double shape_share = 0.01;
  /// Weight of each event's displacement in the velocity.
  double velocity_share = 0.2;
  /// Events this far away or farther are ignored. Below half the puck's width, the tracker settles
  /// on a part of the contour.
  double max_distance_px = 10;
  /// Above 0: the maximum distance in widths of the puck at the tracker's place, instead of in px.
  double max_distance_widths = 0;
  /// The shape stays round and follows only the events' distance.
  bool round_shape = false;
  /// Activity, in events, from which a cluster is active; the score is relative to it.
  double active_from = 20;
  /// Time constant of the activity's decay.
  double activity_decay_us = 10'000;
  /// The activity decays once every this many events.
  int regulation_events = 50;
};

/// The port's defaults with a distance in proportion to the puck's size, so that the whole contour
/// counts: the parameters for a fair comparison. The port's 10 px are for smaller objects.
ClusterTrackerParams puck_cluster_params();

/// The cluster tracker of Lagorce et al. (TNNLS 2015) as the PUCK paper used it for comparison: a
/// single Gaussian blob, seeded at PUCK's detection. An event too far away is ignored; any other
/// event attracts position and shape. It never detects that it has lost the puck.
///
/// The seed's shape, and the size in the estimate, follow from the events lying on the contour: an
/// ellipse's contour of width w has the variance w²/8 along x.
///
/// The estimate's score is the activity relative to that of an active cluster, at most 1: it
/// measures the recent number of events, whether or not they are the puck's. The velocity is as
/// coarse as the original's: each event's displacement divided by the time since the previous
/// event.
class ClusterTracker final : public TrackingAlgorithm {
 public:
  /// `detection` configures the initial detection. Throws std::invalid_argument, naming the key,
  /// when a parameter is out of range.
  ClusterTracker(SensorSize sensor, const ClusterTrackerParams& params,
                 const PuckSizeModel& size_model,
                 const PipelineParams& detection = preset_params(Preset::kReference));

  void update(const EventPacket& packet) override;
  PuckEstimate estimate() override;

 private:
  // Covariance of the events' offsets from the position, px².
  struct Covariance {
    double xx = 0;
    double xy = 0;
    double yy = 0;
  };

  void start(const PuckSeed& seed, Timestamp now);
  void apply(Pixel event, Timestamp time);
  void regulate(Timestamp now);
  double max_distance_px() const;

  ClusterTrackerParams params_;
  PuckSizeModel size_model_;
  std::optional<SurfaceTracker> detector_;  // until the puck is detected

  Pixel position_;
  PixelVelocity velocity_;
  Covariance shape_;
  double activity_ = 0;
  Timestamp last_own_event_;
  Timestamp last_regulation_;
  int events_to_regulation_ = 0;
  Timestamp newest_event_;
  std::int64_t events_applied_ = 0;
};

}  // namespace puck
