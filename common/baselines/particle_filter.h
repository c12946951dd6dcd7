#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/baselines/event_window.h"
#include "common/baselines/particle_set.h"
#include "common/baselines/particle_template.h"
#include "common/baselines/puck_seed.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "common/vision/presets.h"
#include "common/vision/surface_tracker.h"

namespace puck {

/// The defaults are those of the variant that the PUCK paper was compared with, except the shape.
struct ParticleFilterParams {
  ParticleSetParams set;
  TemplateShape shape = TemplateShape::kEllipse;
  /// Likelihood of a particle without support, as a share of the best possible one.
  double lowest_likelihood = 0.03;
  /// Events farther than this beyond the mean radius, in x or y, are ignored.
  double region_margin_px = 20;
  /// The window of newest events is never cut below this size.
  int smallest_window_events = 300;
  /// The window never grows beyond this size.
  int largest_window_events = 2000;
  /// The window is cut when it holds this many more events than the particles used.
  int window_slack_events = 30;
};

/// Number of events to keep in a window of `held` when the particles used `used` of them (weighted
/// mean).
int events_to_keep(int held, double used, const ParticleFilterParams& params);

/// The particle filter of Glover and Bartolozzi (IROS 2017) in the variant that the PUCK paper was
/// compared with. Each particle goes through the newest events, newest first, and keeps the number
/// of events that fits it best, so that the window is estimated together with place and size. It is
/// seeded at PUCK's detection and never detects that it has lost the puck.
///
/// The particles are updated every π·R new events near the puck; the estimate, with its newest
/// event and its count of events, is that of the last update. Its score is the likelihood of the
/// best particle: 1 when every pixel of the ring fired and none inside; 0 before the first update.
/// The velocity is not estimated.
class ParticleFilter final : public TrackingAlgorithm {
 public:
  /// `detection` configures the initial detection. Throws std::invalid_argument, naming the key,
  /// when a parameter is out of range.
  ParticleFilter(SensorSize sensor, const ParticleFilterParams& params,
                 const PuckSizeModel& size_model,
                 const PipelineParams& detection = preset_params(Preset::kReference));

  void update(const EventPacket& packet) override;
  PuckEstimate estimate() override;

 private:
  // State of the initial detection. The events before the seed fill its window.
  struct Search {
    SurfaceTracker detector;
    EventWindow history;
  };

  void start(const PuckSeed& seed);
  bool is_near(Pixel event) const;
  void step();
  void observe_events();

  ParticleFilterParams params_;
  PuckSizeModel size_model_;
  std::optional<Search> search_;

  ParticleTemplate template_;
  ParticleSet set_;
  EventWindow window_;
  int new_events_ = 0;               // in the window since the last update
  std::vector<double> likelihoods_;  // of each particle
  std::vector<int> used_events_;     // by each particle
  double score_ = 0;

  Timestamp newest_event_;  // of the last update, as the count
  std::int64_t events_applied_ = 0;
  std::int64_t events_received_ = 0;
};

}  // namespace puck
