#include "tools/convert/conversion_filter.h"

#include <algorithm>
#include <vector>

namespace puck {

ConversionFilter::ConversionFilter(const ConversionFilterParams& params, SensorSize sensor)
    : params_(params), events_(params.events, sensor) {}

bool ConversionFilter::apply(EventPacket& packet) {
  if (packet.empty()) return true;
  const bool goes_on = cut(packet);
  events_.apply(packet);
  if (params_.start_at_zero) shift_to_zero(packet);
  return goes_on;
}

bool ConversionFilter::cut(EventPacket& packet) {
  if (!first_) first_ = packet.time_of(packet.events.front());
  newest_ = packet.newest();
  const Timestamp begin = *first_ + params_.from_us;
  const bool is_open = params_.length_us > ConversionFilterParams::kEnd - begin.us;
  const Timestamp end =
      is_open ? Timestamp{ConversionFilterParams::kEnd} : begin + params_.length_us;
  std::vector<Event>& events = packet.events;
  // Events are in order, so the part is a run of them.
  const auto earlier_than = [&](Timestamp limit) {
    return std::partition_point(events.begin(), events.end(),
                                [&](const Event& event) { return packet.time_of(event) < limit; });
  };
  const auto part_end = earlier_than(end);
  const bool is_over = part_end != events.end();
  after_ += events.end() - part_end;
  events.erase(part_end, events.end());
  const auto part_begin = earlier_than(begin);
  before_ += part_begin - events.begin();
  events.erase(events.begin(), part_begin);
  return !is_over;
}

void ConversionFilter::shift_to_zero(EventPacket& packet) {
  if (packet.empty()) return;
  if (!zero_) zero_ = packet.time_of(packet.events.front());
  if (packet.start < *zero_) {
    const std::int64_t early_us = *zero_ - packet.start;
    for (Event& event : packet.events) event.offset_us -= static_cast<std::uint32_t>(early_us);
    packet.start = *zero_;
  }
  packet.start = {packet.start - *zero_};
}

}  // namespace puck
