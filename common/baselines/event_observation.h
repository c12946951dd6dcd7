#pragma once

#include "common/baselines/event_window.h"
#include "common/baselines/particle_set.h"
#include "common/baselines/particle_template.h"

namespace puck {

/// One particle's observation of the newest events.
struct EventObservation {
  double likelihood = 0;
  /// Number of newest events at which the particle's likelihood is highest.
  int used_events = 0;
};

/// Sums the template's values at the events, newest first, and takes the highest partial sum, so
/// that each particle chooses its own window. The likelihood lies between `lowest_likelihood` times
/// the ring's pixels and the ring's pixels.
EventObservation observe(const EventWindow& window, const Particle& particle,
                         const ParticleTemplate& shape, double lowest_likelihood);

}  // namespace puck
