#include "common/simulation/event_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/simulation/photoreceptor.h"

namespace puck {
namespace {

constexpr std::uint64_t kMismatchStream = 10;
constexpr std::uint64_t kNoiseStream = 11;
// A response this close to ln(intensity) counts as settled: a hundredth of a usual threshold.
constexpr float kSettled = 0.002f;
constexpr double kLowestThreshold = 0.01;
// The dark current bounds a photoreceptor's cutoff frequency from below, as a share of the nominal
// one.
constexpr double kLowestCutoffShare = 0.05;
// The flicker is interpolated linearly between this many points of a period.
constexpr double kFlickerSteps = 40;

// A photoreceptor's bandwidth is proportional to its current; the noise of the current grows with
// its square root.
EventSensorParams in_light(EventSensorParams params, const LightParams& light) {
  const double brighter = light.illuminance_lux / LightParams::kReference_lux;
  params.cutoff_hz *= brighter;
  params.noise_hz /= std::sqrt(brighter);
  params.jitter_us /= std::sqrt(brighter);
  return params;
}

}  // namespace

EventSensor::EventSensor(const EventSensorParams& params, ImageView<const float> log_intensity,
                         std::int64_t seed, const LightParams& light)
    : params_(in_light(params, light)),
      size_{log_intensity.width(), log_intensity.height()},
      time_constant_us_(1e6 / (2 * std::numbers::pi * params_.cutoff_hz)),
      flicker_(light.flicker_modulation, light.flicker_hz, params_.cutoff_hz),
      readout_(params.readout_mev_s, size_),
      random_(seed, kNoiseStream),
      pixels_(static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height)),
      light_(pixels_.size()) {
  Random mismatch(seed, kMismatchStream);
  const auto threshold = [&] {
    return static_cast<float>(std::max(
        kLowestThreshold, params.threshold + params.threshold_mismatch * mismatch.normal()));
  };
  for (int y = 0; y < size_.height; ++y) {
    for (int x = 0; x < size_.width; ++x) {
      Pixel& pixel = pixels_[index_of(x, y)];
      pixel.response = light_[index_of(x, y)] = log_intensity(x, y);
      pixel.threshold_on = threshold();
      pixel.threshold_off = threshold();
      // A real pixel was last reset at an arbitrary level. If all pixels had been reset at once,
      // the first events of an edge would come in step.
      pixel.reference = pixel.response + static_cast<float>(mismatch.uniform(-0.5, 0.5)) *
                                             std::min(pixel.threshold_on, pixel.threshold_off) *
                                             (params.threshold_mismatch > 0 ? 1.0f : 0.0f);
      pixel.reference += flicker_.response_at(0);
      if (flicker_.is_off()) continue;
      const float rest = pixel.reference - pixel.response;
      reach_.add(rest + pixel.threshold_on, rest - pixel.threshold_off);
    }
  }
  const int count = static_cast<int>(pixels_.size());
  const int hot = static_cast<int>(std::lround(params.hot_pixel_fraction * count));
  for (int i = 0; i < hot; ++i) hot_.push_back(static_cast<std::uint32_t>(mismatch.index(count)));
}

void EventSensor::ramp(std::uint32_t index, float log_intensity, Timestamp from, Timestamp to) {
  Pixel& pixel = pixels_[index];
  const double from_us = static_cast<double>(from.us);
  if (!pixel.is_unsettled) {
    pixel.is_unsettled = true;
    pixel.time_us = from_us;
    unsettled_.push_back(index);
  }
  if (pixel.time_us < from_us) run(index, light_[index], from_us);
  run(index, log_intensity, static_cast<double>(to.us));
}

void EventSensor::settle(Timestamp to) {
  if (flicker_.is_off()) {
    settle_step(to);
    return;
  }
  const auto step_us = static_cast<std::int64_t>(flicker_.period_us() / kFlickerSteps);
  while (flickered_until_ < to) {
    const Timestamp next = std::min(to, flickered_until_ + step_us);
    wake_by_flicker(next);
    settle_step(next);
    flickered_until_ = next;
  }
}

void EventSensor::settle_step(Timestamp to) {
  const double to_us = static_cast<double>(to.us);
  const float flicker = flicker_.response_at(to_us);
  std::size_t kept = 0;
  for (const std::uint32_t index : unsettled_) {
    Pixel& pixel = pixels_[index];
    if (pixel.time_us < to_us) run(index, light_[index], to_us);
    // With flicker, a pixel that has been integrated beyond this step must not wake within the
    // step.
    const bool may_sleep = flicker_.is_off() || pixel.time_us <= to_us;
    if (may_sleep && is_settled(index, flicker)) {
      pixel.response = light_[index];
      pixel.is_unsettled = false;
      if (flicker_.is_off()) continue;
      const float rest = pixel.reference - pixel.response;
      reach_.set(index, rest + pixel.threshold_on, rest - pixel.threshold_off);
    } else {
      unsettled_[kept++] = index;
    }
  }
  unsettled_.resize(kept);
}

void EventSensor::wake_by_flicker(Timestamp to) {
  const auto from_us = static_cast<double>(flickered_until_.us);
  const float from_level = flicker_.response_at(from_us);
  const float to_level = flicker_.response_at(static_cast<double>(to.us));
  reach_.visit_reached(std::min(from_level, to_level), std::max(from_level, to_level),
                       [&](std::size_t index) {
                         Pixel& pixel = pixels_[index];
                         if (pixel.is_unsettled) return;
                         pixel.is_unsettled = true;
                         pixel.time_us = from_us;
                         unsettled_.push_back(static_cast<std::uint32_t>(index));
                       });
}

void EventSensor::finish_slice(Timestamp end, EventPacket& packet) {
  settle(end);
  add_noise(end);
  write_slice(end, packet);
  slice_start_ = end;
}

bool EventSensor::is_settled(std::uint32_t index, float flicker) const {
  const Pixel& pixel = pixels_[index];
  const float moved = light_[index] + flicker - pixel.reference;
  return std::abs(light_[index] - pixel.response) < kSettled && moved < pixel.threshold_on &&
         -moved < pixel.threshold_off;
}

double EventSensor::time_constant_in(float light_before, float light_after) const {
  if (params_.cutoff_luminance == 0) return time_constant_us_;
  const double luminance = std::exp((light_before + light_after) / 2);
  const double brighter = luminance / params_.cutoff_luminance;
  return time_constant_us_ / std::max(brighter, kLowestCutoffShare);
}

double EventSensor::decay_over(double duration_us, double time_constant_us) {
  if (time_constant_us != time_constant_us_) return std::exp(-duration_us / time_constant_us);
  // Nearly all pixels of a step have the same duration.
  if (duration_us != memoised_duration_us_) {
    memoised_duration_us_ = duration_us;
    memoised_decay_ = std::exp(-duration_us / time_constant_us);
  }
  return memoised_decay_;
}

void EventSensor::run(std::uint32_t index, float light_at_end, double to_us) {
  Pixel& pixel = pixels_[index];
  const float light_before = light_[index];
  light_[index] = light_at_end;
  const double from_us = pixel.time_us;
  if (!(to_us > from_us)) return;
  pixel.time_us = to_us;
  const double duration_us = to_us - from_us;
  const double time_constant_us = time_constant_in(light_before, light_at_end);
  const PhotoreceptorRamp ramp{duration_us,
                               time_constant_us,
                               pixel.response,
                               light_before,
                               light_at_end,
                               flicker_.response_at(from_us),
                               flicker_.response_at(to_us)};
  const float before = ramp.response + ramp.flicker_before;
  pixel.response = ramp.response_after(decay_over(duration_us, time_constant_us));
  const float after = pixel.response + ramp.flicker_after;

  const auto fire_at = [&](float level, bool is_late, bool polarity) {
    const double crossed_us = is_late ? from_us : from_us + ramp.crossing_us(level, before, after);
    const double t_us = std::max(crossed_us, pixel.refractory_until_us);
    if (t_us >= to_us) return false;
    pixel.reference = level;
    fire(pixel, index, polarity, t_us);
    return true;
  };
  while (after >= pixel.reference + pixel.threshold_on) {
    const float level = pixel.reference + pixel.threshold_on;
    if (!fire_at(level, before >= level, true)) return;
  }
  while (after <= pixel.reference - pixel.threshold_off) {
    const float level = pixel.reference - pixel.threshold_off;
    if (!fire_at(level, before <= level, false)) return;
  }
}

void EventSensor::fire(Pixel& pixel, std::uint32_t index, bool polarity, double t_us) {
  const double stamped_us = t_us + 2 * params_.jitter_us * random_.uniform();
  pixel.refractory_until_us = stamped_us + params_.refractory_us;
  slice_.push_back({static_cast<std::int64_t>(stamped_us), index, polarity});
}

void EventSensor::add_noise(Timestamp end) {
  const double start_us = static_cast<double>(slice_start_.us);
  const double duration_us = static_cast<double>(end - slice_start_);
  const int count = static_cast<int>(pixels_.size());
  const auto fire_somewhere = [&](std::uint32_t index) {
    const double t_us = start_us + random_.uniform() * duration_us;
    const bool polarity = random_.uniform() < 0.5;
    Pixel& pixel = pixels_[index];
    if (t_us < pixel.refractory_until_us) return;
    pixel.refractory_until_us = t_us + params_.refractory_us;
    slice_.push_back({static_cast<std::int64_t>(t_us), index, polarity});
  };
  const double background = params_.noise_hz * count * duration_us * 1e-6;
  for (int i = random_.poisson(background); i > 0; --i) {
    fire_somewhere(static_cast<std::uint32_t>(random_.index(count)));
  }
  if (hot_.empty()) return;
  const int hot_count = static_cast<int>(hot_.size());
  const double hot = params_.hot_pixel_hz * hot_count * duration_us * 1e-6;
  for (int i = random_.poisson(hot); i > 0; --i) {
    fire_somewhere(hot_[static_cast<std::size_t>(random_.index(hot_count))]);
  }
}

void EventSensor::write_slice(Timestamp end, EventPacket& packet) {
  due_.clear();
  std::size_t kept = 0;
  for (const PixelEvent& event : pending_) {
    if (event.t_us < end.us) {
      due_.push_back(event);
    } else {
      pending_[kept++] = event;
    }
  }
  pending_.resize(kept);
  for (const PixelEvent& event : slice_) {
    if (event.t_us < end.us) {
      due_.push_back(event);
    } else {
      pending_.push_back(event);
    }
  }
  slice_.clear();
  for (PixelEvent& event : due_) event.t_us = std::max(event.t_us, slice_start_.us);
  readout_.read(due_, slice_start_, end, packet);
}

}  // namespace puck
