#include "common/io/yarp_log_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/io/reader_warnings.h"

namespace puck {
namespace {

// A longer line is not a packet: the largest packet has some 100,000 events.
constexpr std::size_t kLongestLine = std::size_t{16} << 20;
constexpr std::size_t kUsualLine = std::size_t{64} << 10;
// Number of lines from which the encoding is determined.
constexpr int kSampleLines = 200;

constexpr std::uint32_t kStampMask = 0x7fffffff;

int x_of(std::uint32_t address) { return static_cast<int>(address >> 1 & 0x7ff); }
int y_of(std::uint32_t address) { return static_cast<int>(address >> 12 & 0x3ff); }
std::uint32_t eye_of(std::uint32_t address) { return address >> 22 & 1; }
// Samples of an inertial sensor, skin or sound have a bit of their own above the address. Bit 25
// marks an event on a corner.
bool is_event(std::uint32_t address) { return (address & 0xfd800000) == 0; }

// Determines a log's encoding from its first lines.
class EncodingSample {
 public:
  explicit EncodingSample(SensorSize sensor) : sensor_(sensor) {}

  void add(const YarpPacket& packet) {
    if (packet.words.empty()) return;
    if (packet.is_bytes && packet.words.size() % 2 == 1) odd_packets_ = true;
    for (std::size_t i = 0; i + 1 < packet.words.size(); i += 2) {
      const std::uint32_t stamp = packet.words[i];
      if (!is_event(stamp) || !sensor_.contains(x_of(stamp), y_of(stamp))) no_address_ = true;
      if (i > 0) ++(stamp >= packet.words[i - 2] ? rises_ : falls_);
    }
    const std::uint32_t newest = packet.words[(packet.words.size() - 1) / 2 * 2] & kStampMask;
    const double host_us = (packet.host_time_s - host_time_s_) * 1e6;
    const double ticks = (newest - newest_) & kStampMask;
    // In a longer pause the counter may wrap.
    constexpr double kLongestPauseUs = 60e6;
    if (has_packet_ && host_us > 0 && host_us < kLongestPauseUs && ticks > 0) {
      ticks_per_us_.push_back(ticks / host_us);
    }
    has_packet_ = true;
    is_bytes_ = packet.is_bytes;
    host_time_s_ = packet.host_time_s;
    newest_ = newest;
  }

  /// Whether every other word is a stamp: stamps increase, addresses do not for long.
  bool has_stamps() const {
    constexpr int kMostRising = 16;
    if (odd_packets_ || falls_ * 10 > rises_) return false;
    return no_address_ || rises_ > kMostRising;
  }

  /// 0.08 or 1: the one closer to the host times of most packets.
  double us_per_tick() const {
    constexpr double kBetween = 3.5;  // Ticks a µs, of 12.5 and 1.
    if (ticks_per_us_.empty()) return is_bytes_ ? 1 : 0.08;
    std::vector<double> sorted = ticks_per_us_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2] > kBetween ? 0.08 : 1;
  }

 private:
  SensorSize sensor_;
  bool odd_packets_ = false;
  bool no_address_ = false;
  int rises_ = 0;
  int falls_ = 0;
  bool has_packet_ = false;
  bool is_bytes_ = false;
  double host_time_s_ = 0;
  std::uint32_t newest_ = 0;
  std::vector<double> ticks_per_us_;  // From one packet to the next.
};

}  // namespace

YarpLogReader::YarpLogReader(const std::filesystem::path& path, const EventFileOptions& options)
    : name_(path.string()),
      options_(options),
      file_(path, std::ios::binary),
      buffer_(kUsualLine),
      clock_(1),
      sink_({1, 1}) {
  if (!options_.sensor.is_valid()) {
    throw EventFileError(name_ +
                         ": a YARP log does not say how large the sensor is; give width and "
                         "height (--width and --height, or the keys width and height), such as "
                         "304 x 240 for an ATIS");
  }
  find_encoding();
  rewind();
}

bool YarpLogReader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  sink_.begin(packet, max_events);
  while (sink_.has_room() && next_line()) take_line();
  return !packet.empty();
}

void YarpLogReader::rewind() {
  file_.clear();
  file_.seekg(0);
  is_at_end_ = false;
  clock_ = YarpEventClock(us_per_tick_);
  first_plain_s_.reset();
  newest_plain_ = {};
  eye_.reset();
  if (options_.yarp_eye == "left") eye_ = 0;
  if (options_.yarp_eye == "right") eye_ = 1;
  sink_ = EventSink(options_.sensor);
}

std::vector<std::string> YarpLogReader::warnings() const {
  return reader_warnings(name_, counters(), is_at_end_ && !sink_.has_backlog());
}

void YarpLogReader::find_encoding() {
  EncodingSample sample(options_.sensor);
  for (int i = 0; i < kSampleLines && next_line(); ++i) {
    if (is_line_whole_ && parse_yarp_packet(line_, true, packet_)) sample.add(packet_);
  }
  has_stamps_ = sample.has_stamps();
  us_per_tick_ = sample.us_per_tick();
}

// Moves to the next line that is short enough to be a packet.
bool YarpLogReader::next_line() {
  while (!is_at_end_) {
    std::size_t length = 0;
    bool is_too_long = false;
    do {
      // Full, not at a line end: there is more of the line.
      if (length > 0) buffer_.resize(2 * buffer_.size());
      file_.clear();
      file_.getline(buffer_.data() + length, static_cast<std::streamsize>(buffer_.size() - length));
      if (file_.bad()) throw EventFileError(name_ + ": cannot be read to its end");
      length += static_cast<std::size_t>(file_.gcount());
      is_too_long = length >= kLongestLine;
    } while (file_.fail() && !file_.eof() && !is_too_long);
    is_at_end_ = file_.eof();
    is_line_whole_ = !is_at_end_;
    if (is_too_long) {
      ++sink_.counters().malformed_words;
      if (file_.fail() && !is_at_end_) {
        file_.clear();
        file_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
      }
      continue;
    }
    if (is_at_end_ && length == 0) return false;
    // Where there is a line end, it counts.
    line_ = std::string_view(buffer_.data(), length - (is_line_whole_ ? 1 : 0));
    return true;
  }
  return false;
}

void YarpLogReader::take_line() {
  EventCounters& counters = sink_.counters();
  if (!parse_yarp_packet(line_, is_line_whole_, packet_)) {
    if (!is_line_whole_) {
      counters.truncated_bytes += static_cast<std::int64_t>(line_.size());
    } else if (line_.find_first_not_of(" \t\r") != std::string_view::npos) {
      ++counters.malformed_words;
    }
    return;
  }
  counters.other_data += packet_.other_records;
  counters.malformed_words += packet_.malformed_values;
  counters.truncated_bytes += packet_.cut_bytes;
  if (packet_.is_bytes && !has_stamps_) {
    take_plain();
  } else {
    take_stamped(!packet_.is_bytes);
  }
}

void YarpLogReader::take_stamped(bool is_off_one) {
  for (std::size_t i = 0; i + 1 < packet_.words.size(); i += 2) {
    const std::uint32_t address = packet_.words[i + 1];
    if (!is_of_this_eye(address)) continue;
    if (const auto time = clock_.at(packet_.words[i] & kStampMask, packet_.host_time_s)) {
      append(*time, address, is_off_one);
    } else {
      ++sink_.counters().time_glitches;
    }
  }
  if (packet_.words.size() % 2 == 0) return;
  if (is_line_whole_) {
    ++sink_.counters().malformed_words;
  } else {
    sink_.counters().truncated_bytes += 4;
  }
}

void YarpLogReader::take_plain() {
  const auto count = static_cast<double>(packet_.words.size());
  const double duration_us = static_cast<double>(packet_.duration_us);
  if (!first_plain_s_) first_plain_s_ = packet_.host_time_s - duration_us * 1e-6;
  const double end_us = (packet_.host_time_s - *first_plain_s_) * 1e6;
  // Overlapping packets lose no events: the host's clock is not the sensor's.
  const double newest_us = static_cast<double>(newest_plain_.us);
  const double from_us = std::max(end_us - duration_us, newest_us);
  const double until_us = std::max(end_us, newest_us);
  for (std::size_t i = 0; i < packet_.words.size(); ++i) {
    const double share = static_cast<double>(i) / count;
    newest_plain_ = {std::llround(from_us + share * (until_us - from_us))};
    if (is_of_this_eye(packet_.words[i])) append(newest_plain_, packet_.words[i], false);
  }
}

// Counts other events.
bool YarpLogReader::is_of_this_eye(std::uint32_t address) {
  if (is_event(address)) {
    if (!eye_) eye_ = eye_of(address);
    if (eye_of(address) == *eye_) return true;
  }
  ++sink_.counters().other_data;
  return false;
}

void YarpLogReader::append(Timestamp time, std::uint32_t address, bool is_off_one) {
  sink_.append(time, x_of(address), y_of(address), ((address & 1) == 1) != is_off_one);
}

}  // namespace puck
