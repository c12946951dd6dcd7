#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "common/simulation/event_sensor.h"

namespace puck {

/// A sensor under uniform light, as in a laboratory. It starts settled at ln(light) = 0.
class SensorBench {
 public:
  struct Set {
    EventSensorParams sensor;
    LightParams light;
    SensorSize size{64, 48};
    std::int64_t seed = 1;

    /// Without noise events.
    Set without_noise() const;
    /// Without the readout's queue, which simultaneous events of all pixels would overload.
    Set without_queue() const;
    /// With photoreceptor and threshold only.
    Set without_pauses() const;
    double time_constant_us() const;
  };

  explicit SensorBench(const Set& set);

  /// ln(light) follows `light_at` for `duration_us`, linear between points `step_us` apart; the
  /// argument is µs since the bench's start.
  void follow(const std::function<double(double)>& light_at, std::int64_t duration_us,
              std::int64_t step_us = 50);
  /// ln(light) jumps within 1 µs and stays for `duration_us`.
  void jump(double log_light, std::int64_t duration_us);
  /// The light stays constant.
  void wait(std::int64_t duration_us);
  void forget_events() { events_.clear(); }

  Timestamp now() const { return now_; }
  int pixel_count() const;
  /// In order of time.
  const std::vector<PixelEvent>& events() const { return events_; }
  /// The same, separate for each pixel.
  std::vector<std::vector<PixelEvent>> events_by_pixel() const;
  std::int64_t lost() const { return sensor_.lost(); }

 private:
  void change_all(double log_light, Timestamp to);
  void finish(Timestamp end);

  EventSensor sensor_;
  Timestamp now_;
  EventPacket packet_;
  std::vector<PixelEvent> events_;
};

}  // namespace puck
