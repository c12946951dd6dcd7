#include "common/baselines/event_observation.h"

#include <algorithm>

namespace puck {

EventObservation observe(const EventWindow& window, const Particle& particle,
                         const ParticleTemplate& shape, double lowest_likelihood) {
  const double highest = shape.positive_pixels();
  const double lowest = lowest_likelihood * highest;
  double score = 0;
  EventObservation best{lowest, 0};
  for (int age = 0; age < window.size(); ++age) {
    const Pixel event = window[age];
    const auto value = shape.at((event.x - particle.position.x) * particle.scale,
                                (event.y - particle.position.y) * particle.scale);
    if (!value) continue;
    score += *value;
    if (score >= best.likelihood) best = {score, age};
  }
  // A large particle collects more events than a small one; its area normalises the sum.
  best.likelihood = std::clamp(best.likelihood * particle.scale * particle.scale, lowest, highest);
  return best;
}

}  // namespace puck
