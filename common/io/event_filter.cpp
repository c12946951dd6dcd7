#include "common/io/event_filter.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace puck {
namespace {

constexpr std::uint32_t kNoPlace = 0xffffffff;

std::string size_text(SensorSize sensor) {
  return std::to_string(sensor.width) + " x " + std::to_string(sensor.height) + " px";
}

Region checked_crop(const EventFilterParams& params, SensorSize sensor) {
  const Region whole = Region::all_of(sensor);
  if (!params.crop) return whole;
  const Region& crop = *params.crop;
  if (crop.empty() || crop.intersect(whole) != crop) {
    throw std::invalid_argument(params.crop_name + " must lie within the sensor of " +
                                size_text(sensor) + ", got [" + std::to_string(crop.x) + ", " +
                                std::to_string(crop.y) + ", " + std::to_string(crop.width) + ", " +
                                std::to_string(crop.height) + "]");
  }
  return crop;
}

void check_duration(std::int64_t time_us, const char* name) {
  if (time_us >= 0 && time_us <= EventFilterParams::kLongestUs) return;
  throw std::invalid_argument(std::string(name) + " must be from 0 to " +
                              std::to_string(EventFilterParams::kLongestUs) + " us, got " +
                              std::to_string(time_us));
}

// Region::contains without a branch, which a processor could not predict at the region's edges.
bool is_inside(const Region& region, const Event& event) {
  const auto right = static_cast<unsigned>(event.x - region.x);
  const auto down = static_cast<unsigned>(event.y - region.y);
  return (static_cast<unsigned>(right < static_cast<unsigned>(region.width)) &
          static_cast<unsigned>(down < static_cast<unsigned>(region.height))) != 0;
}

void move_event(Event& event, int x, int y) {
  event.x = static_cast<std::uint16_t>(x);
  event.y = static_cast<std::uint16_t>(y) & 0x7fff;
}

}  // namespace

bool EventFilterParams::is_off() const {
  return mask.pixels().empty() && !crop && polarity == Polarity::kBoth && refractory_us == 0 &&
         background_activity_us == 0 && turn.is_none() && !lens;
}

std::int64_t FilteredEvents::sum() const {
  std::int64_t sum = 0;
  for (const auto& [count, reason] : reasons()) sum += count;
  return sum;
}

std::vector<std::pair<std::int64_t, const char*>> FilteredEvents::reasons() const {
  return {{outside_sensor, "outside the sensor"},
          {masked, "of masked pixels"},
          {outside_crop, "outside the crop"},
          {other_polarity, "of the other polarity"},
          {refractory, "within the refractory period"},
          {background, "of background activity"},
          {outside_picture, "outside the undistorted picture"}};
}

EventFilter::EventFilter(EventFilterParams params, SensorSize sensor)
    : params_(std::move(params)), in_(sensor), kept_(checked_crop(params_, sensor)) {
  cropped_ = params_.crop_is_sensor ? SensorSize{kept_.width, kept_.height} : sensor;
  out_ = params_.turn.size_of(cropped_);
  params_.mask.check_sensor(sensor, params_.mask_name);
  check_duration(params_.refractory_us, "the refractory period");
  check_duration(params_.background_activity_us, "the time of background activity");
  if (params_.refractory_us > 0) kept_times_.emplace(cropped_, params_.refractory_us);
  if (params_.background_activity_us > 0) {
    event_times_.emplace(cropped_, params_.background_activity_us);
  }
  if (params_.lens) make_places();
}

void EventFilter::make_places() {
  const Lens& lens = *params_.lens;
  if (lens.sensor != out_) {
    throw std::invalid_argument(params_.lens_name + " is of a picture of " +
                                size_text(lens.sensor) + ", the events are of one of " +
                                size_text(out_));
  }
  places_.assign(
      static_cast<std::size_t>(cropped_.width) * static_cast<std::size_t>(cropped_.height),
      kNoPlace);
  std::size_t i = 0;
  for (int y = 0; y < cropped_.height; ++y) {
    for (int x = 0; x < cropped_.width; ++x, ++i) {
      const Pixel turned =
          params_.turn.apply({static_cast<double>(x), static_cast<double>(y)}, cropped_);
      const std::optional<Pixel> seen = lens.undistorted(turned);
      // Far outside, the nearest integer may not exist.
      if (!seen || std::abs(seen->x) > SensorSize::kMax || std::abs(seen->y) > SensorSize::kMax) {
        continue;
      }
      const auto to_x = static_cast<int>(std::lround(seen->x));
      const auto to_y = static_cast<int>(std::lround(seen->y));
      if (!out_.contains(to_x, to_y)) continue;
      places_[i] = static_cast<std::uint32_t>(to_x) | static_cast<std::uint32_t>(to_y) << 16;
    }
  }
}

void EventFilter::reset() {
  left_out_ = {};
  forget_times();
}

void EventFilter::forget_times() {
  if (kept_times_) kept_times_->clear();
  if (event_times_) event_times_->clear();
}

void EventFilter::apply(EventPacket& packet) {
  using Polarity = EventFilterParams::Polarity;
  if (params_.is_off() || packet.empty()) return;
  left_out_.outside_sensor += remove_outside(packet);
  left_out_.masked += params_.mask.remove_from(packet);
  if (params_.crop) {
    const int origin_x = params_.crop_is_sensor ? kept_.x : 0;
    const int origin_y = params_.crop_is_sensor ? kept_.y : 0;
    left_out_.outside_crop += keep_if(packet, [&, crop = kept_](Event& event) {
      const bool is_kept = is_inside(crop, event);
      move_event(event, event.x - origin_x, event.y - origin_y);
      return is_kept;
    });
  }
  if (params_.polarity != Polarity::kBoth) {
    const unsigned kept = params_.polarity == Polarity::kOn ? 1 : 0;
    left_out_.other_polarity +=
        keep_if(packet, [kept](const Event& event) { return event.polarity == kept; });
  }
  if (kept_times_) left_out_.refractory += remove_refractory(packet);
  if (event_times_) left_out_.background += remove_background(packet);
  if (params_.lens) {
    left_out_.outside_picture += move_to_places(packet);
  } else if (!params_.turn.is_none()) {
    turn(packet);
  }
}

// Returns the number of removed events. Without a branch for each event, since which ones are kept
// cannot be predicted.
template <typename Keep>
std::int64_t EventFilter::keep_if(EventPacket& packet, Keep keep) {
  std::vector<Event>& events = packet.events;
  std::size_t kept = 0;
  for (Event event : events) {
    const bool is_kept = keep(event);
    events[kept] = event;
    kept += is_kept ? 1 : 0;
  }
  const auto removed = static_cast<std::int64_t>(events.size() - kept);
  events.resize(kept);
  return removed;
}

// The same; `keep` also takes the event's time and its pixel in `times`.
template <typename Keep>
std::int64_t EventFilter::keep_if_timed(EventPacket& packet, PixelTimes& times, Keep keep) {
  std::vector<Event>& events = packet.events;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < events.size();) {
    for (const std::size_t end = times.prepare(packet, i); i < end; ++i) {
      const Event event = events[i];
      const bool is_kept = keep(times.stamp_of(event), times.at(event));
      events[kept] = event;
      kept += is_kept ? 1 : 0;
    }
  }
  const auto removed = static_cast<std::int64_t>(events.size() - kept);
  events.resize(kept);
  return removed;
}

// What follows relies on it to find a pixel in its tables. A good packet is only looked through.
std::int64_t EventFilter::remove_outside(EventPacket& packet) const {
  // A sum reaches this bit if x or y is too great; so the loop needs no comparison.
  constexpr unsigned kTooGreat = 1U << 16;
  const unsigned to_right = kTooGreat - static_cast<unsigned>(in_.width);
  const unsigned to_bottom = kTooGreat - static_cast<unsigned>(in_.height);
  unsigned sums = 0;
  for (const Event& event : packet.events) sums |= (event.x + to_right) | (event.y + to_bottom);
  if ((sums & kTooGreat) == 0) return 0;
  return keep_if(packet, [whole = Region::all_of(in_)](const Event& event) {
    return is_inside(whole, event);
  });
}

std::int64_t EventFilter::remove_refractory(EventPacket& packet) {
  const auto period = static_cast<std::uint32_t>(params_.refractory_us);
  return keep_if_timed(packet, *kept_times_, [period](std::uint32_t now, std::uint32_t* last) {
    if (now - *last < period) return false;
    *last = now;
    return true;
  });
}

std::int64_t EventFilter::remove_background(EventPacket& packet) {
  const auto longest = static_cast<std::uint32_t>(params_.background_activity_us);
  const std::ptrdiff_t row = event_times_->row_length();
  return keep_if_timed(
      packet, *event_times_, [longest, row](std::uint32_t now, std::uint32_t* pixel) {
        const auto is_recent = [&](std::ptrdiff_t to) {
          return static_cast<unsigned>(now - pixel[to] <= longest);
        };
        const unsigned neighbours = is_recent(-row - 1) | is_recent(-row) | is_recent(-row + 1) |
                                    is_recent(-1) | is_recent(1) | is_recent(row - 1) |
                                    is_recent(row) | is_recent(row + 1);
        *pixel = now;
        return neighbours != 0;
      });
}

void EventFilter::turn(EventPacket& packet) const {
  // The turn as a sum: its value at the origin, and a step for each pixel right and down.
  const auto [origin_x, origin_y] = params_.turn.apply({0, 0}, cropped_);
  const auto [right_x, right_y] = params_.turn.apply({1, 0}, cropped_);
  const auto [down_x, down_y] = params_.turn.apply({0, 1}, cropped_);
  const auto x0 = static_cast<int>(origin_x);
  const auto y0 = static_cast<int>(origin_y);
  const auto x_by_x = static_cast<int>(right_x - origin_x);
  const auto y_by_x = static_cast<int>(right_y - origin_y);
  const auto x_by_y = static_cast<int>(down_x - origin_x);
  const auto y_by_y = static_cast<int>(down_y - origin_y);
  for (Event& event : packet.events) {
    const int x = event.x;
    const int y = event.y;
    move_event(event, x0 + x_by_x * x + x_by_y * y, y0 + y_by_x * x + y_by_y * y);
  }
}

std::int64_t EventFilter::move_to_places(EventPacket& packet) const {
  const auto width = static_cast<std::size_t>(cropped_.width);
  return keep_if(packet, [&](Event& event) {
    const std::uint32_t place = places_[event.y * width + event.x];
    move_event(event, static_cast<int>(place & 0xffff), static_cast<int>(place >> 16));
    return place != kNoPlace;
  });
}

}  // namespace puck
