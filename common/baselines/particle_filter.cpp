#include "common/baselines/particle_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/baselines/event_observation.h"
#include "common/baselines/param_check.h"

namespace puck {
namespace {

// Enough events of the whole image to contain a few hundred of the puck's.
constexpr int kHistoryEvents = 20'000;

Pixel place_of(const Event& event) {
  return {static_cast<double>(event.x), static_cast<double>(event.y)};
}

// Checked here, because the window allocates before the constructor's body runs.
int checked_window_events(const ParticleFilterParams& params) {
  require_at_least("particle_filter.smallest_window_events", params.smallest_window_events, 1);
  require_at_least("particle_filter.largest_window_events", params.largest_window_events,
                   params.smallest_window_events);
  return params.largest_window_events;
}

}  // namespace

int events_to_keep(int held, double used, const ParticleFilterParams& params) {
  if (held - used <= params.window_slack_events) return held;
  return std::min(held, std::max(static_cast<int>(used), params.smallest_window_events));
}

ParticleFilter::ParticleFilter(SensorSize sensor, const ParticleFilterParams& params,
                               const PuckSizeModel& size_model, const PipelineParams& detection)
    : params_(params),
      size_model_(search_params(detection).sizes_of(size_model)),
      search_(Search{{sensor, detection, size_model}, EventWindow(kHistoryEvents)}),
      template_(params.shape),
      set_(sensor, params.set),
      window_(checked_window_events(params)),
      likelihoods_(set_.particles().size()),
      used_events_(set_.particles().size()) {
  require_share("particle_filter.lowest_likelihood", params.lowest_likelihood);
  require_at_least("particle_filter.region_margin_px", params.region_margin_px, 0.0);
  require_at_least("particle_filter.window_slack_events", params.window_slack_events, 0);
}

void ParticleFilter::update(const EventPacket& packet) {
  if (search_) {
    search_->detector.update(packet);
    for (const Event& event : packet.events) search_->history.push(place_of(event));
    events_received_ += static_cast<std::int64_t>(packet.events.size());
    return;
  }
  for (const Event& event : packet.events) {
    ++events_received_;
    if (!is_near(place_of(event))) continue;
    window_.push(place_of(event));
    if (++new_events_ < std::numbers::pi * set_.mean_radius_px()) continue;
    step();
    newest_event_ = packet.time_of(event);
    events_applied_ = events_received_;
  }
}

PuckEstimate ParticleFilter::estimate() {
  if (search_) {
    const PuckEstimate detected = search_->detector.estimate();
    if (detected.state != TrackState::kTracking) return detected;
    start({*detected.position, size_model_.at(*detected.position)});
    newest_event_ = detected.newest_event;
    events_applied_ = detected.events_applied;
    search_.reset();
  }
  PuckEstimate estimate;
  estimate.state = TrackState::kTracking;
  estimate.position = set_.mean_position();
  estimate.size = template_.size_of_radius(set_.mean_radius_px());
  estimate.score = score_;
  estimate.newest_event = newest_event_;
  estimate.events_applied = events_applied_;
  return estimate;
}

void ParticleFilter::start(const PuckSeed& seed) {
  template_.fit(seed.size);
  set_.seed(seed.position, ParticleTemplate::radius_of_width(seed.size.width));
  const EventWindow& history = search_->history;
  for (int age = history.size() - 1; age >= 0; --age) {
    if (is_near(history[age])) window_.push(history[age]);
  }
  window_.keep_newest(params_.smallest_window_events);
}

bool ParticleFilter::is_near(Pixel event) const {
  const double reach = set_.mean_radius_px() + params_.region_margin_px;
  const Pixel mean = set_.mean_position();
  return std::abs(event.x - mean.x) <= reach && std::abs(event.y - mean.y) <= reach;
}

void ParticleFilter::step() {
  new_events_ = 0;
  template_.fit(size_model_.at(set_.mean_position()));
  observe_events();
  set_.weigh(likelihoods_);
  double used_events = 0;
  std::size_t i = 0;
  for (const Particle& particle : set_.particles()) {
    used_events += particle.weight * used_events_[i++];
  }
  window_.keep_newest(events_to_keep(window_.size(), used_events, params_));
  set_.resample();
  set_.predict();
}

void ParticleFilter::observe_events() {
  std::size_t i = 0;
  for (const Particle& particle : set_.particles()) {
    const EventObservation observation =
        observe(window_, particle, template_, params_.lowest_likelihood);
    likelihoods_[i] = observation.likelihood;
    used_events_[i] = observation.used_events;
    ++i;
  }
  score_ =
      *std::max_element(likelihoods_.begin(), likelihoods_.end()) / template_.positive_pixels();
}

}  // namespace puck
