#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/simulation/event_sensor_params.h"
#include "common/simulation/flicker.h"
#include "common/simulation/flicker_reach.h"
#include "common/simulation/light_params.h"
#include "common/simulation/random.h"
#include "common/simulation/sensor_readout.h"
#include "common/vision/image.h"

namespace puck {

/// An event camera's pixels. Each has a photoreceptor, which follows ln(intensity) through a
/// first-order low-pass, and a comparator, which fires whenever that has moved by the pixel's
/// threshold from the level of its last event. A crossing during the refractory period fires at
/// its end, so no contrast is lost. Only pixels on which something changes cost time. Events leave
/// through a readout that is not endlessly fast.
class EventSensor {
 public:
  /// Starts at time 0, settled on the image, whose size is the sensor's.
  EventSensor(const EventSensorParams& params, ImageView<const float> log_intensity,
              std::int64_t seed, const LightParams& light = {});

  /// The light on a pixel goes evenly from what it was at `from`, which must not lie before the
  /// present slice, to `log_intensity` at `to`. A pixel's changes come in the order of their
  /// times: one that ends before a pixel's last one did takes effect at that one's end.
  void change(int x, int y, float log_intensity, Timestamp from, Timestamp to) {
    const auto index = static_cast<std::uint32_t>(index_of(x, y));
    if (is_change(light_[index], log_intensity)) ramp(index, log_intensity, from, to);
  }
  /// Whether `change` would do anything.
  static bool is_change(float before, float after) { return std::abs(after - before) >= kNoChange; }
  /// Ends the present slice: lets all pixels settle on, adds noise, and appends the slice's events
  /// to the packet, in the order of their times, from the end of the slice before up to, but not
  /// including, `end`.
  void finish_slice(Timestamp end, EventPacket& packet);

  SensorSize size() const { return size_; }
  /// But for the flicker.
  float log_intensity(int x, int y) const { return light_[index_of(x, y)]; }
  /// Of a row of pixels.
  const float* log_intensities(int y) const { return &light_[index_of(0, y)]; }
  /// Events that the readout could not take.
  std::int64_t lost() const { return readout_.lost(); }

 private:
  /// Changes of ln(intensity) below this are not worth a pixel's time.
  static constexpr float kNoChange = 1e-4f;

  struct Pixel {
    float response = 0;   ///< The photoreceptor's output, but for the flicker.
    float reference = 0;  ///< The response to which the next event's threshold is compared.
    float threshold_on = 0;
    float threshold_off = 0;
    bool is_unsettled = false;
    double time_us = 0;          ///< Up to which it has been computed, while it is unsettled.
    double silent_until_us = 0;  ///< End of its refractory period.
  };

  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.width) +
           static_cast<std::size_t>(x);
  }
  void ramp(std::uint32_t index, float log_intensity, Timestamp from, Timestamp to);
  void run(std::uint32_t index, float light_at_end, double to_us);
  void fire(Pixel& pixel, std::uint32_t index, bool polarity, double t_us);
  void settle(Timestamp to);
  bool is_settled(std::uint32_t index, float flicker) const;
  void settle_step(Timestamp to);
  void wake_by_flicker(Timestamp to);
  double time_constant_in(float light_before, float light_after) const;
  double decay_over(double duration_us, double time_constant_us);
  void add_noise(Timestamp end);
  void write_slice(Timestamp end, EventPacket& packet);

  EventSensorParams params_;  ///< In the present light.
  SensorSize size_;
  double time_constant_us_;
  Flicker flicker_;
  SensorReadout readout_;
  Random random_;
  std::vector<Pixel> pixels_;
  std::vector<float>
      light_;  ///< ln(intensity) on each pixel now; apart, for the many that keep it.
  std::vector<std::uint32_t> unsettled_;
  std::vector<std::uint32_t> hot_;

  // Only in flickering light.
  FlickerReach reach_;
  Timestamp flickered_until_;

  Timestamp slice_start_;
  std::vector<PixelEvent> slice_;    ///< Events of the present slice, in no order.
  std::vector<PixelEvent> pending_;  ///< Of later slices: their jitter carried them over.
  std::vector<PixelEvent> due_;      ///< Scratch.

  double memoised_duration_us_ = -1;
  double memoised_decay_ = 0;
};

}  // namespace puck
