#include "tools/evaluate/lossy_reader.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "common/messaging/event_packing.h"

namespace puck {
namespace {

// puck-camera's defaults of camera.flush_us, and of camera.quiet_flush_us for few events.
constexpr std::int64_t kFlushUs = 250;
constexpr std::int64_t kQuietFlushUs = 5000;
constexpr std::size_t kFew = 32;

}  // namespace

LossyReader::LossyReader(std::unique_ptr<EventReader> events, const LossyReaderParams& params)
    : events_(std::move(events)),
      params_(params),
      max_events_(static_cast<std::size_t>(
          EventPacker({events_->sensor_size(), params.packet_bytes}).max_events())),
      random_(params.seed) {}

bool LossyReader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  while (handed_out_ == packet_.events.size()) {
    if (!cut_packet()) return false;
    if (is_lost()) packet_.events.clear();
  }
  const std::size_t count = std::min(max_events, packet_.events.size() - handed_out_);
  const auto begin = packet_.events.begin() + static_cast<std::ptrdiff_t>(handed_out_);
  packet.start = packet_.start;
  packet.events.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  handed_out_ += count;
  return true;
}

// False at the end of the events.
bool LossyReader::cut_packet() {
  packet_.events.clear();
  handed_out_ = 0;
  while (true) {
    if (cut_ == recorded_.events.size()) {
      cut_ = 0;
      if (!events_->read(recorded_, EventReader::kUsualEvents)) return !packet_.empty();
    }
    const Event& event = recorded_.events[cut_];
    const Timestamp time = recorded_.time_of(event);
    if (packet_.empty()) {
      packet_.start = time;
    } else if (is_complete(time)) {
      return true;
    }
    packet_.events.push_back(event);
    packet_.events.back().offset_us = static_cast<std::uint32_t>(time - packet_.start);
    ++cut_;
  }
}

bool LossyReader::is_complete(Timestamp next) const {
  const std::size_t count = packet_.events.size();
  return count >= max_events_ || next - packet_.start > (count < kFew ? kQuietFlushUs : kFlushUs);
}

bool LossyReader::is_lost() {
  ++packets_;
  // The upper 53 bits as a fraction: unlike distributions, the same on every machine.
  const double drawn = static_cast<double>(random_() >> 11) * 0x1p-53;
  if (drawn * 100 >= params_.drop_percent) return false;
  ++packets_lost_;
  events_lost_ += static_cast<std::int64_t>(packet_.events.size());
  return true;
}

void LossyReader::rewind() {
  events_->rewind();
  random_.seed(params_.seed);
  recorded_.events.clear();
  packet_.events.clear();
  cut_ = 0;
  handed_out_ = 0;
  packets_ = 0;
  packets_lost_ = 0;
  events_lost_ = 0;
}

std::vector<std::string> LossyReader::warnings() const {
  std::vector<std::string> warnings = events_->warnings();
  warnings.push_back("--drop-packets dropped " + std::to_string(packets_lost_) + " of " +
                     std::to_string(packets_) + " packets with " + std::to_string(events_lost_) +
                     " events");
  return warnings;
}

}  // namespace puck
