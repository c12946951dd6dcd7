#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/pixel_mask.h"
#include "common/events/sensor_size.h"
#include "common/io/lens.h"
#include "common/io/picture_turn.h"
#include "common/io/pixel_times.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// What is taken out of a stream of events, and how its picture is turned: in this order.
struct EventFilterParams {
  enum class Polarity : std::uint8_t { kBoth, kOn, kOff };

  PixelMask mask;               ///< Pixels whose events are left out.
  std::optional<Region> crop;   ///< Events outside it are left out.
  bool crop_is_sensor = false;  ///< The crop becomes the whole sensor. false: the size stays.
  Polarity polarity = Polarity::kBoth;
  /// After an event that is kept, its pixel is blind for so long, both polarities; 0: off.
  std::int64_t refractory_us = 0;
  /// An event is kept if one of the 8 pixels around it had an event at most so long before, kept
  /// or not; 0: off.
  std::int64_t background_activity_us = 0;
  PictureTurn turn;
  std::optional<Lens> lens;  ///< Of the turned picture, whose distortion is removed.

  static constexpr std::int64_t kLongestUs = PixelTimes::kLongestUs;

  /// The names in messages.
  std::string mask_name = "the pixel mask";
  std::string crop_name = "the crop";
  std::string lens_name = "the lens";

  bool is_off() const;
};

/// Events that a filter left out, by reason.
struct FilteredEvents {
  std::int64_t outside_sensor = 0;
  std::int64_t masked = 0;
  std::int64_t outside_crop = 0;
  std::int64_t other_polarity = 0;
  std::int64_t refractory = 0;
  std::int64_t background = 0;
  std::int64_t outside_picture = 0;  ///< After the undistortion.

  std::int64_t sum() const;
  /// Each count with its reason in words: "of masked pixels", …
  std::vector<std::pair<std::int64_t, const char*>> reasons() const;
};

/// Takes events out of packets and moves the others, in place. One thread.
class EventFilter {
 public:
  /// Makes all tables. Throws std::invalid_argument for a mask, a crop, or a lens that does not fit
  /// the sensor, and for a duration out of range.
  EventFilter(EventFilterParams params, SensorSize sensor);

  /// Of the events that are left.
  SensorSize sensor() const { return out_; }

  /// Changes the packet, which may become empty. Packets must come in the order of their times.
  void apply(EventPacket& packet);

  const FilteredEvents& left_out() const { return left_out_; }

  /// As at the beginning of a stream.
  void reset();
  /// The same, but the counts go on: the next packet may be of any time.
  void forget_times();

 private:
  template <typename Keep>
  static std::int64_t keep_if(EventPacket& packet, Keep keep);
  template <typename Keep>
  static std::int64_t keep_if_timed(EventPacket& packet, PixelTimes& times, Keep keep);
  void make_places();
  std::int64_t remove_outside(EventPacket& packet) const;
  std::int64_t remove_refractory(EventPacket& packet);
  std::int64_t remove_background(EventPacket& packet);
  void turn(EventPacket& packet) const;
  std::int64_t move_to_places(EventPacket& packet) const;

  EventFilterParams params_;
  SensorSize in_;       // As the events come.
  SensorSize cropped_;  // Before the turn.
  SensorSize out_;
  Region kept_;  // The crop, else the whole sensor.
  std::optional<PixelTimes> kept_times_;
  std::optional<PixelTimes> event_times_;
  /// For each pixel before the turn its place after turn and undistortion: x and y << 16.
  std::vector<std::uint32_t> places_;
  FilteredEvents left_out_;
};

}  // namespace puck
