// Messages on our channels: the first byte chooses the channel, the rest is the message.
#include <algorithm>
#include <cstring>

#include "common/messaging/conversions.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/message_codec.h"
#include "tests/fuzz/message_mutator.h"
#include "tests/fuzz/require.h"
#include "tests/support/random_message.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace puck {
namespace {

Channel channel_of(std::uint8_t byte) { return kAllChannels[byte % kAllChannels.size()]; }

bool equal(const EventPacket& a, const EventPacket& b) {
  return a.start == b.start && std::equal(a.events.begin(), a.events.end(), b.events.begin(),
                                          b.events.end(), [](const Event& x, const Event& y) {
                                            return x.x == y.x && x.y == y.y &&
                                                   x.polarity == y.polarity &&
                                                   x.offset_us == y.offset_us;
                                          });
}

void use(const event_packet_t& packet, std::span<const std::uint8_t> bytes) {
  EventPacketView view;
  decode_checked(bytes, view);
  EventPacket events;
  unpack(view, events);
  EventPacket same_events;
  unpack(packet, same_events);
  require(equal(events, same_events), "the view sees the events that the message has");
  require(static_cast<std::int64_t>(events.events.size()) == packet.count, "all events come out");
  const SensorSize sensor{packet.width, packet.height};
  std::uint32_t newest_us = 0;
  for (const Event& event : events.events) {
    require(sensor.contains(event.x, event.y), "events lie inside the sensor");
    require(event.offset_us >= newest_us && event.offset_us <= packet.duration_us,
            "events are in order, within the duration");
    newest_us = event.offset_us;
  }
}

template <typename Message>
void use(const Message& message, std::span<const std::uint8_t> bytes) {
  if constexpr (requires { from_message(message); }) {
    auto plain = from_message(message);
    Bytes again;
    encode(plain, again);
    require(!check_message(kChannelOf<Message>, again), "a converted message stays valid");
    // An estimate without a position loses what a position would need.
    const bool is_kept = std::equal(again.begin(), again.end(), bytes.begin(), bytes.end());
    require(is_kept || kChannelOf<Message> == Channel::kEstimate, "a conversion loses nothing");
  }
}

void account(Channel channel, std::span<const std::uint8_t> bytes) {
  const MessageHeader header = read_header(bytes);
  EventNumbering numbering;
  if (channel == Channel::kEvents) numbering = read_event_numbering(bytes);
  LossAccount losses;
  const auto add = [&] {
    return losses.add(header.session, header.seq, numbering.events_before, numbering.events);
  };
  require(add() == Arrival::kNewSession, "the first message begins a session");
  require(add() == Arrival::kDuplicate, "the same again is a duplicate");
  require(losses.counters().lost == 0, "nothing was lost");
}

void receive(Channel channel, std::span<const std::uint8_t> bytes) {
  if (const auto rejection = check_message(channel, bytes)) {
    require_one_line(*rejection);
    return;
  }
  account(channel, bytes);
  with_message_type(channel, [&](auto message) {
    decode_checked(bytes, message);
    Bytes again;
    encode(message, again);
    require(std::equal(again.begin(), again.end(), bytes.begin(), bytes.end()),
            "a valid message is encoded as it came");
    use(message, bytes);
  });
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  puck::receive(puck::channel_of(data[0]), {data + 1, size - 1});
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  std::mt19937_64 random(seed);
  if (size == 0 || random() % 64 == 0) data[0] = static_cast<std::uint8_t>(random());
  size = std::max<std::size_t>(size, 1);
  const puck::Bytes message = puck::mutate_message(puck::channel_of(data[0]), {data + 1, size - 1},
                                                   random, &LLVMFuzzerMutate);
  const std::size_t kept = std::min(message.size(), max_size - 1);
  std::memcpy(data + 1, message.data(), kept);
  return kept + 1;
}
