#include "common/baselines/particle_set.h"

#include <algorithm>

#include "common/baselines/param_check.h"

namespace puck {

ParticleSet::ParticleSet(SensorSize sensor, const ParticleSetParams& params)
    : sensor_(sensor), params_(params), random_(params.seed) {
  require_at_least("particle_filter.particles", params.particles, 1);
  require_at_least("particle_filter.position_spread_px", params.position_spread_px, 0.0);
  require_at_least("particle_filter.scale_spread", params.scale_spread, 0.0);
  require_above_zero("particle_filter.smallest_radius_px", params.smallest_radius_px);
  require_at_least("particle_filter.largest_radius_px", params.largest_radius_px,
                   params.smallest_radius_px);
  particles_.resize(static_cast<std::size_t>(params.particles));
  drawn_.reserve(particles_.size());
}

void ParticleSet::seed(Pixel position, double radius_px) {
  const double scale = scale_of_radius(radius_px);
  const double weight = 1.0 / static_cast<double>(particles_.size());
  std::fill(particles_.begin(), particles_.end(), Particle{position, scale, weight});
  update_means();
}

void ParticleSet::weigh(std::span<const double> likelihoods) {
  double sum = 0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    particles_[i].weight *= likelihoods[i];
    sum += particles_[i].weight;
  }
  for (Particle& particle : particles_) particle.weight /= sum;
  update_means();
}

void ParticleSet::resample() {
  double sum = 0;
  double sum_of_squares = 0;
  for (const Particle& particle : particles_) {
    sum += particle.weight;
    sum_of_squares += particle.weight * particle.weight;
  }
  if (params_.adaptive_resampling && !(sum_of_squares * params_.particles > 2)) return;
  drawn_.clear();
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    double left = random_.next() * sum;
    auto chosen = particles_.begin();
    while (left >= chosen->weight && chosen + 1 != particles_.end()) {
      left -= chosen->weight;
      ++chosen;
    }
    drawn_.push_back(*chosen);
  }
  particles_.swap(drawn_);
}

void ParticleSet::predict() {
  const double smallest = scale_of_radius(params_.largest_radius_px);
  const double largest = scale_of_radius(params_.smallest_radius_px);
  for (Particle& particle : particles_) {
    const double x = particle.position.x + random_.next_within(params_.position_spread_px);
    const double y = particle.position.y + random_.next_within(params_.position_spread_px);
    const double scale = particle.scale + random_.next_within(params_.scale_spread);
    particle.position = {std::clamp(x, 0.0, sensor_.width - 1.0),
                         std::clamp(y, 0.0, sensor_.height - 1.0)};
    particle.scale = std::clamp(scale, smallest, largest);
  }
}

double ParticleSet::scale_of_radius(double radius_px) const {
  return ParticleTemplate::kBaseRadius /
         std::clamp(radius_px, params_.smallest_radius_px, params_.largest_radius_px);
}

void ParticleSet::update_means() {
  mean_position_ = {};
  mean_radius_px_ = 0;
  for (const Particle& particle : particles_) {
    mean_position_.x += particle.weight * particle.position.x;
    mean_position_.y += particle.weight * particle.position.y;
    mean_radius_px_ += particle.weight * ParticleTemplate::kBaseRadius / particle.scale;
  }
}

}  // namespace puck
