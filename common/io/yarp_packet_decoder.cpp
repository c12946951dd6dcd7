#include "common/io/yarp_packet_decoder.h"

#include <algorithm>
#include <cmath>

#include "common/io/yarp_address.h"

namespace puck {
namespace {

// Packets without stamps: tolerated overlap with the previous packet, and gap after it.
constexpr double kMostOverlapUs = 50'000;
constexpr double kUsualGapUs = 1e6;

}  // namespace

YarpPacketDecoder::YarpPacketDecoder(SensorSize sensor, const YarpRecordForm& form,
                                     std::int64_t reorder_us)
    : form_(form), clock_(form.us_per_tick), sink_(sensor, reorder_us) {}

void YarpPacketDecoder::take(const YarpPacket& packet, bool is_whole) {
  EventCounters& counters = sink_.counters();
  counters.other_data += packet.other_records;
  counters.malformed_words += packet.malformed_values;
  if (packet.is_cut && is_whole) ++counters.malformed_words;
  if (packet.is_cut && !is_whole) counters.truncated_bytes += packet.cut_bytes;
  if (!packet.is_bytes || form_.has_stamps) {
    take_stamped(packet, is_whole);
  } else if (!packet.words.empty()) {
    take_plain(packet);
  }
}

void YarpPacketDecoder::finish() {
  clock_.finish(placed_);
  append_placed();
  if (!held_) return;
  place_plain(*held_, newest_plain_us_);
  held_.reset();
}

void YarpPacketDecoder::take_stamped(const YarpPacket& packet, bool is_whole) {
  // Lists encode ON as 0.
  const std::uint32_t turn = packet.is_bytes ? 0 : 1;
  for (std::size_t i = 0; i + 1 < packet.words.size(); i += 2) {
    const std::uint32_t address = packet.words[i + 1];
    if (!is_of_this_eye(address)) continue;
    clock_.add({packet.words[i] & kYarpStampMask, packet.host_time_s, address ^ turn}, placed_);
  }
  append_placed();
  if (packet.words.size() % 2 == 0) return;
  if (packet.is_cut && !is_whole) {
    sink_.counters().truncated_bytes += 4;
  } else {
    ++sink_.counters().malformed_words;
  }
}

// Spreads a packet's events evenly over its duration, which ends at its host time. A packet whose
// host time contradicts the previous one waits for the next packet; its host time is believed if
// the next one agrees.
void YarpPacketDecoder::take_plain(const YarpPacket& packet) {
  if (!plain_zero_s_) {
    plain_zero_s_ = packet.host_time_s - static_cast<double>(packet.duration_us) * 1e-6;
  }
  const auto end_us = [&](const YarpPacket& of) { return (of.host_time_s - *plain_zero_s_) * 1e6; };
  const auto start_us = [&](const YarpPacket& of) {
    return end_us(of) - static_cast<double>(of.duration_us);
  };
  const auto agrees = [&](const YarpPacket& of, double before_us) {
    const double gap_us = start_us(of) - before_us;
    return gap_us > -kMostOverlapUs && gap_us < kUsualGapUs;
  };
  if (held_) {
    if (agrees(packet, end_us(*held_))) {
      // A jump ahead was a pause. After a jump back of the host's clock, time continues.
      if (start_us(*held_) < newest_plain_us_) {
        *plain_zero_s_ += (start_us(*held_) - newest_plain_us_) * 1e-6;
      }
      place_plain(*held_, start_us(*held_));
    } else {
      ++sink_.counters().time_glitches;
      place_plain(*held_, newest_plain_us_);
    }
    held_.reset();
  }
  if (agrees(packet, newest_plain_us_)) {
    place_plain(packet, start_us(packet));
  } else {
    held_ = packet;
  }
}

void YarpPacketDecoder::place_plain(const YarpPacket& packet, double start_us) {
  const double end_us =
      std::max(start_us + static_cast<double>(packet.duration_us), newest_plain_us_);
  // An overlap with the previous packet must not drop events: the host's clock is not the sensor's.
  const double from_us = std::max(start_us, newest_plain_us_);
  const double step_us = (end_us - from_us) / static_cast<double>(packet.words.size());
  for (std::size_t i = 0; i < packet.words.size(); ++i) {
    if (!is_of_this_eye(packet.words[i])) continue;
    append({std::llround(from_us + static_cast<double>(i) * step_us)}, packet.words[i]);
  }
  newest_plain_us_ = end_us;
}

// False for the other eye and for other sensors, which are counted.
bool YarpPacketDecoder::is_of_this_eye(std::uint32_t address) {
  if (is_yarp_event(address) && yarp_eye_of(address) == form_.eye) return true;
  ++sink_.counters().other_data;
  return false;
}

void YarpPacketDecoder::append_placed() {
  for (const TimedRecord& record : placed_) append(record.time, record.address);
  placed_.clear();
  sink_.counters().time_glitches += clock_.take_doubtful_records();
}

void YarpPacketDecoder::append(Timestamp time, std::uint32_t address) {
  sink_.append(time, yarp_x_of(address), yarp_y_of(address), (address & 1) == 1);
}

}  // namespace puck
