#include "tools/convert/event_filter.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace puck {
namespace {

Region checked_crop(const std::optional<Region>& crop, SensorSize sensor) {
  const Region whole = Region::all_of(sensor);
  if (!crop) return whole;
  if (crop->empty() || crop->intersect(whole) != *crop) {
    throw std::invalid_argument("--crop does not lie inside the sensor of " +
                                std::to_string(sensor.width) + " x " +
                                std::to_string(sensor.height) + " px");
  }
  return *crop;
}

}  // namespace

EventFilter::EventFilter(const EventFilterParams& params, SensorSize sensor)
    : params_(params), crop_(checked_crop(params.crop, sensor)), out_{crop_.width, crop_.height} {
  params_.mask.check_sensor(sensor, "the mask of --hot-pixel-mask");
}

bool EventFilter::apply(EventPacket& packet) {
  if (packet.empty()) return true;
  if (!first_) first_ = packet.time_of(packet.events.front());
  newest_ = packet.newest();
  const Timestamp begin = *first_ + params_.from_us;
  const bool is_open = params_.length_us > EventFilterParams::kEnd - begin.us;
  const Timestamp end = is_open ? Timestamp{EventFilterParams::kEnd} : begin + params_.length_us;
  std::vector<Event>& events = packet.events;
  // Events are in order, so the part is a run of them.
  const auto earlier_than = [&](Timestamp limit) {
    return std::partition_point(events.begin(), events.end(),
                                [&](const Event& event) { return packet.time_of(event) < limit; });
  };
  const auto part_end = earlier_than(end);
  const bool is_over = part_end != events.end();
  left_out_.after += events.end() - part_end;
  events.erase(part_end, events.end());
  const auto part_begin = earlier_than(begin);
  left_out_.before += part_begin - events.begin();
  events.erase(events.begin(), part_begin);

  left_out_.masked += params_.mask.remove_from(packet);
  if (params_.crop) {
    left_out_.outside_crop += static_cast<std::int64_t>(std::erase_if(
        events, [this](const Event& event) { return !crop_.contains(event.x, event.y); }));
  }
  for (Event& event : events) {
    const int x = event.x - crop_.x;
    const int y = event.y - crop_.y;
    event.x = static_cast<std::uint16_t>(params_.rotate_180 ? crop_.width - 1 - x : x);
    event.y = static_cast<std::uint16_t>(params_.rotate_180 ? crop_.height - 1 - y : y) & 0x7fff;
  }
  if (params_.start_at_zero && !events.empty()) {
    if (!zero_) zero_ = packet.time_of(events.front());
    if (packet.start < *zero_) {
      const std::int64_t early_us = *zero_ - packet.start;
      for (Event& event : events) event.offset_us -= static_cast<std::uint32_t>(early_us);
      packet.start = *zero_;
    }
    packet.start = {packet.start - *zero_};
  }
  return !is_over;
}

}  // namespace puck
