#include "common/io/yarp_log_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/io/reader_warnings.h"
#include "common/io/sensor_choice.h"

namespace puck {
namespace {

// A longer line is no packet: the largest has some 100,000 events.
constexpr std::size_t kLongestYarpLine = std::size_t{16} << 20;
// The encoding is detected from this part of the file.
constexpr std::size_t kSampleBytes = std::size_t{4} << 20;
constexpr int kSamplePackets = 200;
constexpr int kSampleLines = 100'000;
// Packets without stamps: tolerated overlap with the previous packet, and gap after it.
constexpr double kMostOverlapUs = 50'000;
constexpr double kUsualGapUs = 1e6;

constexpr std::uint32_t kStampMask = 0x7fffffff;

int x_of(std::uint32_t address) { return static_cast<int>(address >> 1 & 0x7ff); }
int y_of(std::uint32_t address) { return static_cast<int>(address >> 12 & 0x3ff); }
std::uint32_t eye_of(std::uint32_t address) { return address >> 22 & 1; }
// Samples of inertial sensors, skin and sound set a bit above the address. Bit 25 marks an event on
// a corner.
bool is_event(std::uint32_t address) { return (address & 0xfd800000) == 0; }

// Detects the encoding of a log from its first packets.
class EncodingSample {
 public:
  explicit EncodingSample(SensorSize sensor) : sensor_(sensor) {}

  void add(const YarpPacket& packet) {
    if (packet.words.empty() || packet.is_cut) return;
    ++packets_;
    is_bytes_ = packet.is_bytes;
    if (packet.words.size() % 2 == 1) ++odd_packets_;
    for (std::size_t i = 0; i < packet.words.size(); ++i) {
      if (is_on_sensor(packet.words[i])) ++on_sensor_[i % 2];
      if (is_event(packet.words[i])) ++of_eye_[i % 2][eye_of(packet.words[i])];
      if (i >= 2 && i % 2 == 0) ++(packet.words[i] >= packet.words[i - 2] ? rises_ : falls_);
    }
    add_pace(packet);
  }
  int packets() const { return packets_; }

  /// Whether every other word is a stamp: stamps rise, and look like addresses on the sensor only
  /// by chance.
  bool has_stamps() const {
    if (!is_bytes_) return true;
    return 2 * odd_packets_ < packets_ && 10 * falls_ <= rises_ &&
           10 * on_sensor_[0] < 9 * on_sensor_[1];
  }

  /// 0.08 or 1: whichever is nearer to the median ratio of host time to stamps.
  double us_per_tick() const {
    constexpr double kBetween = 3.5;  // Ticks a µs, of 12.5 and 1.
    if (ticks_per_us_.empty()) return is_bytes_ ? 1 : 0.08;
    std::vector<double> sorted = ticks_per_us_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2] > kBetween ? 0.08 : 1;
  }

  /// The eye with more events.
  std::uint32_t eye() const {
    std::array<std::int64_t, 2> events = of_eye_[1];
    if (!has_stamps()) {
      for (std::size_t i = 0; i < events.size(); ++i) events[i] += of_eye_[0][i];
    }
    return events[1] > events[0] ? 1 : 0;
  }

 private:
  bool is_on_sensor(std::uint32_t word) const {
    return is_event(word) && sensor_.contains(x_of(word), y_of(word));
  }
  void add_pace(const YarpPacket& packet) {
    // In a longer pause the counter may wrap.
    constexpr double kLongestPauseUs = 60e6;
    const std::uint32_t newest = packet.words[(packet.words.size() - 1) / 2 * 2] & kStampMask;
    const double host_us = (packet.host_time_s - host_time_s_) * 1e6;
    const double ticks = (newest - newest_) & kStampMask;
    if (packets_ > 1 && host_us > 0 && host_us < kLongestPauseUs && ticks > 0) {
      ticks_per_us_.push_back(ticks / host_us);
    }
    host_time_s_ = packet.host_time_s;
    newest_ = newest;
  }

  SensorSize sensor_;
  int packets_ = 0;
  bool is_bytes_ = false;
  // Counts for words at even places, possibly stamps, and at odd places, the addresses behind them.
  std::array<std::int64_t, 2> on_sensor_{};
  std::array<std::array<std::int64_t, 2>, 2> of_eye_{};
  int odd_packets_ = 0;
  std::int64_t rises_ = 0;
  std::int64_t falls_ = 0;
  double host_time_s_ = 0;
  std::uint32_t newest_ = 0;
  std::vector<double> ticks_per_us_;  // From one packet to the next.
};

}  // namespace

YarpLogReader::YarpLogReader(std::unique_ptr<ByteSource> bytes, const EventFileOptions& options)
    : options_(options),
      sensor_(choose_sensor(bytes->name(), std::nullopt, std::nullopt, options)),
      bytes_(std::move(bytes), kSampleBytes),
      lines_(bytes_, kLongestYarpLine),
      clock_(1),
      sink_({1, 1}) {
  find_encoding();
  start();
}

bool YarpLogReader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  sink_.begin(packet, max_events);
  while (sink_.has_room() && !is_finished_) {
    if (const auto line = lines_.next()) {
      take_line(*line);
    } else {
      finish();
    }
  }
  return !packet.empty();
}

void YarpLogReader::rewind() {
  bytes_.rewind();
  start();
}

void YarpLogReader::start() {
  lines_.restart();
  is_finished_ = false;
  clock_ = YarpEventClock(us_per_tick_);
  held_.reset();
  plain_zero_s_.reset();
  newest_plain_us_ = 0;
  sink_ = EventSink(sensor_, options_.reorder_us);
}

std::vector<std::string> YarpLogReader::warnings() const {
  return reader_warnings(bytes_.name(), counters(), is_finished_ && !sink_.has_backlog(),
                         lines_.bytes());
}

void YarpLogReader::find_encoding() {
  // With an unknown sensor every address would do.
  constexpr SensorSize kLikelySensor{640, 480};
  const bool is_known = sensor_ != SensorSize{SensorSize::kMax, SensorSize::kMax};
  EncodingSample sample(is_known ? sensor_ : kLikelySensor);
  std::string_view rest = bytes_.head();
  for (int i = 0; i < kSampleLines && sample.packets() < kSamplePackets && !rest.empty(); ++i) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (parse_yarp_packet(rest.substr(0, end), packet_)) sample.add(packet_);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  has_stamps_ = sample.has_stamps();
  us_per_tick_ = sample.us_per_tick();
  eye_ = options_.yarp_eye == "auto" ? sample.eye() : options_.yarp_eye == "right" ? 1 : 0;
}

void YarpLogReader::take_line(std::string_view line) {
  EventCounters& counters = sink_.counters();
  counters.malformed_words += lines_.take_skipped();
  if (!parse_yarp_packet(line, packet_)) {
    if (!lines_.is_whole()) {
      counters.truncated_bytes += static_cast<std::int64_t>(line.size());
    } else if (line.find_first_not_of(" \t\r") != std::string_view::npos) {
      ++counters.malformed_words;
    }
    return;
  }
  counters.other_data += packet_.other_records;
  counters.malformed_words += packet_.malformed_values;
  if (packet_.is_cut && lines_.is_whole()) ++counters.malformed_words;
  if (packet_.is_cut && !lines_.is_whole()) counters.truncated_bytes += packet_.cut_bytes;
  if (!packet_.is_bytes || has_stamps_) {
    take_stamped();
  } else if (!packet_.words.empty()) {
    take_plain();
  }
}

void YarpLogReader::finish() {
  sink_.counters().malformed_words += lines_.take_skipped();
  clock_.finish(placed_);
  append_placed();
  if (held_) {
    place_plain(*held_, newest_plain_us_);
    held_.reset();
  }
  is_finished_ = true;
}

void YarpLogReader::take_stamped() {
  // Lists encode ON as 0.
  const std::uint32_t turn = packet_.is_bytes ? 0 : 1;
  for (std::size_t i = 0; i + 1 < packet_.words.size(); i += 2) {
    const std::uint32_t address = packet_.words[i + 1];
    if (!is_of_this_eye(address)) continue;
    clock_.add({packet_.words[i] & kStampMask, packet_.host_time_s, address ^ turn}, placed_);
  }
  append_placed();
  if (packet_.words.size() % 2 == 0) return;
  if (packet_.is_cut && !lines_.is_whole()) {
    sink_.counters().truncated_bytes += 4;
  } else {
    ++sink_.counters().malformed_words;
  }
}

// Spreads a packet's events evenly over its duration, which ends at its host time. A packet whose
// host time contradicts the previous one waits for the next packet; its host time is believed if
// the next one agrees.
void YarpLogReader::take_plain() {
  if (!plain_zero_s_) {
    plain_zero_s_ = packet_.host_time_s - static_cast<double>(packet_.duration_us) * 1e-6;
  }
  const auto end_us = [&](const YarpPacket& packet) {
    return (packet.host_time_s - *plain_zero_s_) * 1e6;
  };
  const auto start_us = [&](const YarpPacket& packet) {
    return end_us(packet) - static_cast<double>(packet.duration_us);
  };
  const auto agrees = [&](const YarpPacket& packet, double before_us) {
    const double gap_us = start_us(packet) - before_us;
    return gap_us > -kMostOverlapUs && gap_us < kUsualGapUs;
  };
  if (held_) {
    if (agrees(packet_, end_us(*held_))) {
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
  if (agrees(packet_, newest_plain_us_)) {
    place_plain(packet_, start_us(packet_));
  } else {
    held_ = packet_;
  }
}

void YarpLogReader::place_plain(const YarpPacket& packet, double start_us) {
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
bool YarpLogReader::is_of_this_eye(std::uint32_t address) {
  if (is_event(address) && eye_of(address) == eye_) return true;
  ++sink_.counters().other_data;
  return false;
}

void YarpLogReader::append_placed() {
  for (const TimedRecord& record : placed_) append(record.time, record.address);
  placed_.clear();
  sink_.counters().time_glitches += clock_.take_doubtful_records();
}

void YarpLogReader::append(Timestamp time, std::uint32_t address) {
  sink_.append(time, x_of(address), y_of(address), (address & 1) == 1);
}

}  // namespace puck
