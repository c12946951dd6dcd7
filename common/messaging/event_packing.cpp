#include "common/messaging/event_packing.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "common/events/event_bits.h"
#include "common/messaging/datagram.h"
#include "common/messaging/event_word.h"

namespace puck {
namespace {

// Size of the channel name with the longest prefix and its NUL.
constexpr int kChannelBytes = 17 + 12;

void check(const EventPackerParams& params) {
  if (!params.sensor.is_valid()) {
    throw std::invalid_argument("packer.sensor must be 1x1 to 2048x2048 px, got " +
                                std::to_string(params.sensor.width) + "x" +
                                std::to_string(params.sensor.height));
  }
  if (params.packet_bytes < EventPackerParams::kMinBytes ||
      params.packet_bytes > EventPackerParams::kMaxBytes) {
    throw std::invalid_argument("packer.packet_bytes must be 256 to 60000, got " +
                                std::to_string(params.packet_bytes));
  }
}

/// Writes events as words until the packet is full or its longest time is reached; returns the
/// number of events used. Skips events outside the sensor.
template <typename Word>
std::size_t fill(std::span<const Event> events, SensorSize sensor, std::size_t max_events,
                 event_packet_t& packet, Word) {
  packet.data.resize(4 * std::min(max_events, events.size()));
  const std::uint32_t first_us = events.front().offset_us;
  std::uint32_t newest_us = first_us;
  std::size_t used = 0;
  std::size_t written = 0;
  for (; used < events.size() && written < max_events; ++used) {
    const Event& event = events[used];
    // A time that steps back ends the packet, since times within a packet never do.
    if (event.offset_us < newest_us || event.offset_us - first_us > Word::kMaxDtUs) break;
    if (!sensor.contains(event.x, event.y)) continue;
    newest_us = event.offset_us;
    store_event_word(packet.data.data() + 4 * written,
                     Word::pack(event.x, event.y, event.polarity, event.offset_us - first_us));
    ++written;
  }
  packet.data.resize(4 * written);
  packet.size = static_cast<std::int32_t>(4 * written);
  packet.count = static_cast<std::int32_t>(written);
  packet.duration_us = newest_us - first_us;
  return used;
}

template <typename Word>
void unpack_words(const std::uint8_t* data, std::span<Event> events, Word) {
  Event* const out = events.data();
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::uint32_t word = load_event_word(data + 4 * i);
    const std::uint64_t bits =
        event_bits(Word::x(word), Word::y(word), Word::polarity(word), Word::dt_us(word));
    std::memcpy(static_cast<void*>(out + i), &bits, sizeof bits);
  }
}

}  // namespace

EventPacker::EventPacker(const EventPackerParams& params) : sensor_(params.sensor), packet_{} {
  check(params);
  const int without_events = kLcmHeaderBytes + kChannelBytes + packet_.getEncodedSize();
  max_events_ = (params.packet_bytes - without_events) / 4;
  packet_.width = sensor_.width;
  packet_.height = sensor_.height;
  packet_.encoding = encoding_for(sensor_);
  packet_.data.reserve(4 * static_cast<std::size_t>(max_events_));
}

void EventPacker::pack(Timestamp start, std::span<const Event> events,
                       const std::function<void(event_packet_t&)>& emit) {
  while (!events.empty()) {
    const std::size_t used = with_event_word(packet_.encoding, [&](auto word) {
      return fill(events, sensor_, static_cast<std::size_t>(max_events_), packet_, word);
    });
    packet_.first_event_us = (start + events.front().offset_us).us;
    packet_.events_before = events_packed_ - packed_before_session_;
    events_packed_ += packet_.count;
    events_outside_ += static_cast<std::int64_t>(used) - packet_.count;
    if (packet_.count > 0) emit(packet_);
    events = events.subspan(used);
  }
}

void unpack(const EventPacketView& packet, EventPacket& events) {
  events.start = Timestamp{packet.first_event_us};
  events.events.resize(static_cast<std::size_t>(packet.count));
  with_event_word(packet.encoding,
                  [&](auto word) { unpack_words(packet.data.data(), events.events, word); });
}

}  // namespace puck
