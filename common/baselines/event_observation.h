#pragma once

#include "common/baselines/event_window.h"
#include "common/baselines/particle_set.h"
#include "common/baselines/particle_template.h"

namespace puck {

/// What one particle makes of the newest events.
struct EventObservation {
  double likelihood = 0;
  /// Age of the oldest event among those that suit the particle best.
  int used_events = 0;
};

/// Adds up the template's values at the events, newest first, and takes the highest sum on the way,
/// so that each particle chooses how far back it looks. The likelihood lies between
/// `lowest_likelihood` times the ring's pixels and the ring's pixels.
EventObservation observe(const EventWindow& window, const Particle& particle,
                         const ParticleTemplate& shape, double lowest_likelihood);

}  // namespace puck
