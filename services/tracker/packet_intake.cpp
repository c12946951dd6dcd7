#include "services/tracker/packet_intake.h"

#include <algorithm>
#include <utility>

namespace puck {

PacketIntake::Verdict PacketIntake::admit(const EventPacketView& packet, const Receipt& receipt,
                                          std::int64_t now_us) {
  const std::int64_t received_us = receipt.monotonic_us;
  bool begins = false;
  switch (publisher_.hear(packet.session, packet.seq, received_us)) {
    case SinglePublisher::Verdict::kOtherPublisher:
      ++counters_.packets_of_others;
      return Verdict::kOtherPublisher;
    case SinglePublisher::Verdict::kLate:
      if (!publisher_.is_silent(received_us)) {
        losses_.add(packet.session, packet.seq, packet.events_before, packet.count);
        ++counters_.packets_dropped;
        return Verdict::kLate;
      }
      // Old numbers after a silence: a log is replayed.
      publisher_ = {};
      publisher_.hear(packet.session, packet.seq, received_us);
      begins = true;
      break;
    case SinglePublisher::Verdict::kNewPublisher:
      begins = true;
      break;
    case SinglePublisher::Verdict::kAccepted:
      begins = packet.first_event_us < newest_event_.us - kClockRestartedUs &&
               received_us - began_us_ > kClockRestartedUs;
      break;
  }
  if (begins) begin(packet, received_us);
  losses_.add(packet.session, packet.seq, packet.events_before, packet.count);
  if (SensorSize{packet.width, packet.height} != sensor_ ||
      packet.first_event_us < newest_event_.us) {
    ++counters_.packets_dropped;
    return Verdict::kUnfit;
  }
  heard_us_ = received_us;
  counters_.events_received += packet.count;
  if (std::exchange(holds_packet_, false)) {
    counters_.events_skipped += held_.packet.count;
    ++counters_.packets_skipped;
    skipped_us_ = now_us;
  }
  if (begins) return Verdict::kBegin;
  if (!skips_late_ || !is_too_late(received_us, now_us)) return Verdict::kTake;
  hold(packet, receipt);
  return Verdict::kHeld;
}

void PacketIntake::begin(const EventPacketView& packet, std::int64_t received_us) {
  losses_ = {};
  counters_ = {.packets_of_others = counters_.packets_of_others};
  sensor_ = {packet.width, packet.height};
  newest_event_ = {packet.first_event_us};
  began_us_ = received_us;
  behind_since_us_.reset();
  holds_packet_ = false;
}

bool PacketIntake::is_too_late(std::int64_t received_us, std::int64_t now_us) {
  if (now_us - received_us <= kBehindUs) {
    behind_since_us_.reset();
    return false;
  }
  if (!behind_since_us_) behind_since_us_ = now_us;
  return now_us - *behind_since_us_ > kPatienceUs;
}

// A packet is skipped only when another one comes, since the newest matters most. Until then it is
// kept without unpacking, so that a queue is skipped quickly.
void PacketIntake::hold(const EventPacketView& packet, const Receipt& receipt) {
  held_data_.assign(packet.data.begin(), packet.data.end());
  held_ = {packet, receipt};
  held_.packet.data = held_data_;
  holds_packet_ = true;
}

const PacketIntake::HeldPacket* PacketIntake::release() {
  return std::exchange(holds_packet_, false) ? &held_ : nullptr;
}

std::int64_t PacketIntake::note_taken(Timestamp newest, std::int64_t received_us,
                                      std::int64_t now_us) {
  const std::int64_t length_us = std::max<std::int64_t>(1, newest - newest_event_);
  newest_event_ = newest;
  return (now_us - received_us) / length_us * length_us;
}

}  // namespace puck
