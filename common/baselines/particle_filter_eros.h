#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/baselines/particle_set.h"
#include "common/baselines/particle_template.h"
#include "common/baselines/puck_seed.h"
#include "common/events/sensor_size.h"
#include "common/vision/correlation/gaussian_blur.h"
#include "common/vision/interfaces/tracking_algorithm.h"
#include "common/vision/presets.h"
#include "common/vision/surface/surface.h"
#include "common/vision/surface_tracker.h"

namespace puck {

struct ParticleFilterErosParams {
  ParticleSetParams set;
  TemplateShape shape = TemplateShape::kEllipse;
  /// Likelihood of a particle without support, as a share of the best possible one.
  double lowest_likelihood = 0.03;
};

/// The particles of ParticleFilter on the blurred EROS surface instead of single events: a
/// particle's likelihood is the sum of its template times the surface. It estimates no window,
/// since the surface decays by itself. It updates once for each estimate that is requested after
/// new events, as PUCK's own tracking thread does. Seeded at PUCK's detection on the same surface,
/// it never detects that it has lost the puck.
///
/// The estimate's score is the likelihood of the best particle: 1 when the whole ring is bright and
/// the inside dark; 0 before the first update. The velocity is not estimated.
class ParticleFilterEros final : public TrackingAlgorithm {
 public:
  /// `detection` configures the initial detection and the surface's decay. Throws
  /// std::invalid_argument, naming the key, when a parameter is out of range.
  ParticleFilterEros(SensorSize sensor, const ParticleFilterErosParams& params,
                     const PuckSizeModel& size_model,
                     const PipelineParams& detection = preset_params(Preset::kReference));

  void update(const EventPacket& packet) override;
  PuckEstimate estimate() override;

 private:
  void start(const PuckSeed& seed);
  void step();
  Region region_needed() const;
  double likelihood_of(const Particle& particle) const;

  ParticleFilterErosParams params_;
  PuckSizeModel size_model_;
  Surface surface_;
  std::optional<SurfaceTracker> detector_;  // until the puck is detected

  ParticleTemplate template_;
  ParticleSet set_;
  GaussianBlur blur_;
  SurfaceSnapshot snapshot_;
  Image<std::uint8_t> blurred_;  // covers the snapshot's region
  std::vector<double> likelihoods_;
  double score_ = 0;
  std::int64_t events_seen_ = 0;
};

}  // namespace puck
