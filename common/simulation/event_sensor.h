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
#include "common/vision/geometry/image.h"

namespace puck {

/// The pixels of an event camera. Each has a photoreceptor, which follows ln(intensity) through a
/// first-order low-pass, and a comparator, which fires whenever the output has moved by the pixel's
/// threshold from the level of its last event. A crossing during the refractory period fires at its
/// end, so no contrast is lost. Only pixels whose light changes cost time. Events leave through a
/// readout of limited rate.
class EventSensor {
 public:
  /// Starts at time 0, settled on `log_intensity`, whose size is the sensor's.
  EventSensor(const EventSensorParams& params, ImageView<const float> log_intensity,
              std::int64_t seed, const LightParams& light = {});

  /// Changes a pixel's ln(intensity) linearly from its value at `from`, which must not lie before
  /// the present slice, to `log_intensity` at `to`. A pixel's changes must come in the order of
  /// their times: one that ends before the pixel's previous change takes effect at the end of that
  /// one.
  void change(int x, int y, float log_intensity, Timestamp from, Timestamp to) {
    const auto index = static_cast<std::uint32_t>(index_of(x, y));
    if (is_change(light_[index], log_intensity)) ramp(index, log_intensity, from, to);
  }
  /// Whether `change` would have an effect.
  static bool is_change(float before, float after) { return std::abs(after - before) >= kNoChange; }
  /// Ends the present slice: lets all pixels settle until `end`, adds noise, and appends the
  /// slice's events to the packet in the order of their times, from the end of the previous slice
  /// up to, but not including, `end`.
  void finish_slice(Timestamp end, EventPacket& packet);

  SensorSize size() const { return size_; }
  /// Without the flicker.
  float log_intensity(int x, int y) const { return light_[index_of(x, y)]; }
  /// `log_intensity` of the pixels of row `y`.
  const float* log_intensities(int y) const { return &light_[index_of(0, y)]; }
  /// Events that the readout dropped.
  std::int64_t lost() const { return readout_.lost(); }

 private:
  /// Smaller changes of ln(intensity) are ignored.
  static constexpr float kNoChange = 1e-4f;

  struct Pixel {
    float response = 0;   ///< The photoreceptor's output without the flicker.
    float reference = 0;  ///< The response to which the next event's threshold is compared.
    float threshold_on = 0;
    float threshold_off = 0;
    bool is_unsettled = false;
    double time_us = 0;              ///< Time up to which the pixel is integrated, while unsettled.
    double refractory_until_us = 0;  ///< End of the refractory period.
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

  EventSensorParams params_;  ///< At the present illuminance.
  SensorSize size_;
  double time_constant_us_;
  Flicker flicker_;
  SensorReadout readout_;
  Random random_;
  std::vector<Pixel> pixels_;
  std::vector<float>
      light_;  ///< ln(intensity) on each pixel; a separate array, since most pixels only read it.
  std::vector<std::uint32_t> unsettled_;
  std::vector<std::uint32_t> hot_;

  // Used only in flickering light.
  FlickerReach reach_;
  Timestamp flickered_until_;

  Timestamp slice_start_;
  std::vector<PixelEvent> slice_;    ///< Events of the present slice, unordered.
  std::vector<PixelEvent> pending_;  ///< Events that jitter moved to later slices.
  std::vector<PixelEvent> due_;      ///< Scratch.

  double memoised_duration_us_ = -1;
  double memoised_decay_ = 0;
};

}  // namespace puck
