#include "tools/simulate/sensor_bench.h"

#include <algorithm>
#include <numbers>

namespace puck {
namespace {

constexpr std::int64_t kStep_us = 50;

Image<float> dark_image(SensorSize size) {
  Image<float> image(size.width, size.height);
  std::fill_n(image.row(0), size.width * size.height, 0.0f);
  return image;
}

}  // namespace

SensorBench::Set SensorBench::Set::without_noise() const {
  Set set = *this;
  set.sensor.noise_hz = 0;
  set.sensor.hot_pixel_fraction = 0;
  return set;
}

SensorBench::Set SensorBench::Set::without_queue() const {
  Set set = without_noise();
  set.sensor.readout_mev_s = 1e6;
  return set;
}

SensorBench::Set SensorBench::Set::without_pauses() const {
  Set set = without_queue();
  set.sensor.refractory_us = 0;
  set.sensor.jitter_us = 0;
  return set;
}

double SensorBench::Set::time_constant_us() const {
  const double cutoff_hz = sensor.cutoff_hz * light.illuminance_lux / LightParams::kReference_lux;
  return 1e6 / (2 * std::numbers::pi * cutoff_hz);
}

SensorBench::SensorBench(const Set& set)
    : sensor_(set.sensor, dark_image(set.size).view(), set.seed, set.light) {}

int SensorBench::pixel_count() const { return sensor_.size().width * sensor_.size().height; }

void SensorBench::follow(const std::function<double(double)>& light_at, std::int64_t duration_us,
                         std::int64_t step_us) {
  const Timestamp end = now_ + duration_us;
  while (now_ < end) {
    const Timestamp next = std::min(end, now_ + step_us);
    change_all(light_at(static_cast<double>(next.us)), next);
    finish(next);
  }
}

void SensorBench::jump(double log_light, std::int64_t duration_us) {
  const Timestamp end = now_ + duration_us;
  change_all(log_light, now_ + 1);
  finish(now_ + 1);
  wait(end - now_);
}

void SensorBench::wait(std::int64_t duration_us) {
  const Timestamp end = now_ + duration_us;
  while (now_ < end) finish(std::min(end, now_ + kStep_us));
}

void SensorBench::change_all(double log_light, Timestamp to) {
  for (int y = 0; y < sensor_.size().height; ++y) {
    for (int x = 0; x < sensor_.size().width; ++x) {
      sensor_.change(x, y, static_cast<float>(log_light), now_, to);
    }
  }
}

void SensorBench::finish(Timestamp end) {
  packet_.events.clear();
  sensor_.finish_slice(end, packet_);
  for (const Event& event : packet_.events) {
    const auto pixel = static_cast<std::uint32_t>(event.y * sensor_.size().width + event.x);
    events_.push_back({packet_.time_of(event).us, pixel, event.polarity == 1});
  }
  now_ = end;
}

std::vector<std::vector<PixelEvent>> SensorBench::events_by_pixel() const {
  std::vector<std::vector<PixelEvent>> pixels(static_cast<std::size_t>(pixel_count()));
  for (const PixelEvent& event : events_) pixels[event.pixel].push_back(event);
  return pixels;
}

}  // namespace puck
