#include "common/baselines/particle_filter_eros.h"

#include <algorithm>
#include <cmath>

#include "common/baselines/param_check.h"

namespace puck {

ParticleFilterEros::ParticleFilterEros(SensorSize sensor, const ParticleFilterErosParams& params,
                                       const PuckSizeModel& size_model,
                                       const PipelineParams& detection)
    : params_(params),
      size_model_(search_params(detection).sizes_of(size_model)),
      surface_(sensor, search_params(detection).eros),
      detector_(std::in_place, sensor, detection, size_model),
      template_(params.shape),
      set_(sensor, params.set),
      likelihoods_(set_.particles().size()) {
  require_share("particle_filter.lowest_likelihood", params.lowest_likelihood);
}

void ParticleFilterEros::update(const EventPacket& packet) {
  surface_.update(packet);
  if (detector_) detector_->update(packet);
}

PuckEstimate ParticleFilterEros::estimate() {
  if (detector_) {
    const PuckEstimate detected = detector_->estimate();
    if (detected.state != TrackState::kTracking) return detected;
    start({*detected.position, size_model_.at(*detected.position)});
    detector_.reset();
  } else if (surface_.events_applied() != events_seen_) {
    step();
  }
  events_seen_ = surface_.events_applied();

  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = set_.mean_position();
  estimate.size = template_.size_of_radius(set_.mean_radius_px());
  estimate.score = score_;
  estimate.newest_event = surface_.newest_event();
  estimate.events_applied = surface_.events_applied();
  return estimate;
}

void ParticleFilterEros::start(const PuckSeed& seed) {
  template_.fit(seed.size);
  set_.seed(seed.position, ParticleTemplate::radius_of_width(seed.size.width));
}

void ParticleFilterEros::step() {
  surface_.snapshot(region_needed(), snapshot_);
  blur_.apply(snapshot_.grey.view(), blurred_);
  template_.fit(size_model_.at(set_.mean_position()));

  const double highest = template_.positive_pixels();
  std::size_t i = 0;
  for (const Particle& particle : set_.particles()) {
    // The sum is over image pixels; the squared scale converts it to template pixels.
    likelihoods_[i++] = std::clamp(likelihood_of(particle) * particle.scale * particle.scale,
                                   params_.lowest_likelihood * highest, highest);
  }
  score_ = *std::max_element(likelihoods_.begin(), likelihoods_.end()) / highest;
  set_.weigh(likelihoods_);
  set_.resample();
  set_.predict();
}

Region ParticleFilterEros::region_needed() const {
  double left = set_.particles().front().position.x;
  double right = left;
  double top = set_.particles().front().position.y;
  double bottom = top;
  double reach = 0;
  for (const Particle& particle : set_.particles()) {
    left = std::min(left, particle.position.x);
    right = std::max(right, particle.position.x);
    top = std::min(top, particle.position.y);
    bottom = std::max(bottom, particle.position.y);
    reach = std::max(reach, (template_.half_side() + 0.5) / particle.scale);
  }
  const int x = static_cast<int>(std::floor(left));
  const int y = static_cast<int>(std::floor(top));
  const Region centres{x, y, static_cast<int>(std::ceil(right)) - x + 1,
                       static_cast<int>(std::ceil(bottom)) - y + 1};
  return centres.inflated(static_cast<int>(std::ceil(reach)) + GaussianBlur::kRadius)
      .intersect(Region::all_of(surface_.size()));
}

double ParticleFilterEros::likelihood_of(const Particle& particle) const {
  const double reach = (template_.half_side() + 0.5) / particle.scale;
  const int side = 2 * static_cast<int>(std::ceil(reach)) + 1;
  const Region box = Region::around(particle.position, side, side).intersect(snapshot_.region);
  double sum = 0;
  for (int y = box.y; y < box.bottom(); ++y) {
    for (int x = box.x; x < box.right(); ++x) {
      const int grey = blurred_(x - snapshot_.region.x, y - snapshot_.region.y);
      if (grey == 0) continue;
      const auto value = template_.at((x - particle.position.x) * particle.scale,
                                      (y - particle.position.y) * particle.scale);
      sum += value.value_or(0) * (grey / 255.0);
    }
  }
  return sum;
}

}  // namespace puck
