#include "common/simulation/event_sensor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr std::uint64_t kMismatchStream = 10;
constexpr std::uint64_t kNoiseStream = 11;
// A response this near to the light has settled: a hundredth of a usual threshold.
constexpr float kSettled = 0.002f;
constexpr double kLowestThreshold = 0.01;

}  // namespace

EventSensor::EventSensor(const EventSensorParams& params, ImageView<const float> log_intensity,
                         std::int64_t seed)
    : params_(params),
      size_{log_intensity.width(), log_intensity.height()},
      time_constant_us_(1e6 / (2 * std::numbers::pi * params.cutoff_hz)),
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
      // A real pixel was last reset at any level; as if all had been at once would make the first
      // events of an edge come in step.
      pixel.reference = pixel.response + static_cast<float>(mismatch.uniform(-0.5, 0.5)) *
                                             std::min(pixel.threshold_on, pixel.threshold_off) *
                                             (params.threshold_mismatch > 0 ? 1.0f : 0.0f);
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
  const double to_us = static_cast<double>(to.us);
  std::size_t kept = 0;
  for (const std::uint32_t index : unsettled_) {
    Pixel& pixel = pixels_[index];
    if (pixel.time_us < to_us) run(index, light_[index], to_us);
    if (is_settled(index)) {
      pixel.response = light_[index];
      pixel.is_unsettled = false;
    } else {
      unsettled_[kept++] = index;
    }
  }
  unsettled_.resize(kept);
}

void EventSensor::finish_slice(Timestamp end, EventPacket& packet) {
  settle(end);
  add_noise(end);
  write_slice(end, packet);
  slice_start_ = end;
}

bool EventSensor::is_settled(std::uint32_t index) const {
  const Pixel& pixel = pixels_[index];
  const float moved = light_[index] - pixel.reference;
  return std::abs(light_[index] - pixel.response) < kSettled && moved < pixel.threshold_on &&
         -moved < pixel.threshold_off;
}

double EventSensor::decay_over(double duration_us) {
  // Nearly all pixels of a step have the same duration.
  if (duration_us != memoised_duration_us_) {
    memoised_duration_us_ = duration_us;
    memoised_decay_ = std::exp(-duration_us / time_constant_us_);
  }
  return memoised_decay_;
}

// The low-pass's exact answer to a ramp of the light; crossings are interpolated between its ends.
void EventSensor::run(std::uint32_t index, float light_at_end, double to_us) {
  Pixel& pixel = pixels_[index];
  const float light_before = light_[index];
  light_[index] = light_at_end;
  const double from_us = pixel.time_us;
  const double duration_us = to_us - from_us;
  if (!(duration_us > 0)) return;
  pixel.time_us = to_us;
  const float before = pixel.response;
  const double lag = (light_at_end - light_before) / duration_us * time_constant_us_;
  const double after = light_at_end - lag + (before - light_before + lag) * decay_over(duration_us);
  pixel.response = static_cast<float>(after);

  const auto crossing_us = [&](float level) {
    const float way = pixel.response - before;
    const double share = way == 0 ? 0 : std::clamp((level - before) / way, 0.0f, 1.0f);
    return std::max(from_us + share * duration_us, pixel.silent_until_us);
  };
  while (pixel.response >= pixel.reference + pixel.threshold_on) {
    const float level = pixel.reference + pixel.threshold_on;
    const double t_us =
        before >= level ? std::max(from_us, pixel.silent_until_us) : crossing_us(level);
    if (t_us >= to_us) return;
    pixel.reference = level;
    fire(pixel, index, true, t_us);
  }
  while (pixel.response <= pixel.reference - pixel.threshold_off) {
    const float level = pixel.reference - pixel.threshold_off;
    const double t_us =
        before <= level ? std::max(from_us, pixel.silent_until_us) : crossing_us(level);
    if (t_us >= to_us) return;
    pixel.reference = level;
    fire(pixel, index, false, t_us);
  }
}

void EventSensor::fire(Pixel& pixel, std::uint32_t index, bool polarity, double t_us) {
  const double stamped_us = t_us + 2 * params_.jitter_us * random_.uniform();
  pixel.silent_until_us = stamped_us + params_.refractory_us;
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
    if (t_us < pixel.silent_until_us) return;
    pixel.silent_until_us = t_us + params_.refractory_us;
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
  // Those that an earlier slice left over go first.
  std::vector<TimedEvent>& due = sorted_;
  due.clear();
  std::size_t kept = 0;
  for (const TimedEvent& event : pending_) {
    if (event.t_us < end.us) {
      due.push_back(event);
    } else {
      pending_[kept++] = event;
    }
  }
  pending_.resize(kept);
  for (const TimedEvent& event : slice_) {
    if (event.t_us < end.us) {
      due.push_back(event);
    } else {
      pending_.push_back(event);
    }
  }
  slice_.clear();

  // A counting sort: there are only as many different times as µs in the slice.
  const auto slots = static_cast<std::size_t>(end - slice_start_);
  const auto slot_of = [&](const TimedEvent& event) {
    return static_cast<std::size_t>(std::max<std::int64_t>(0, event.t_us - slice_start_.us));
  };
  first_at_.assign(slots + 1, 0);
  for (const TimedEvent& event : due) ++first_at_[slot_of(event) + 1];
  for (std::size_t i = 1; i <= slots; ++i) first_at_[i] += first_at_[i - 1];

  if (packet.events.empty()) packet.start = slice_start_;
  const std::size_t already = packet.events.size();
  packet.events.resize(already + due.size());
  const auto start_offset_us = static_cast<std::uint32_t>(slice_start_ - packet.start);
  const auto width = static_cast<std::uint32_t>(size_.width);
  for (const TimedEvent& event : due) {
    const std::size_t slot = slot_of(event);
    Event& written = packet.events[already + first_at_[slot]++];
    written.x = static_cast<std::uint16_t>(event.pixel % width);
    written.y = static_cast<std::uint16_t>(event.pixel / width) & 0x7fffu;
    written.polarity = event.polarity ? 1 : 0;
    written.offset_us = start_offset_us + static_cast<std::uint32_t>(slot);
  }
}

}  // namespace puck
