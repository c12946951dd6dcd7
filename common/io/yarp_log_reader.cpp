#include "common/io/yarp_log_reader.h"

#include <algorithm>
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

}  // namespace

YarpLogReader::YarpLogReader(std::unique_ptr<ByteSource> bytes, const EventFileOptions& options)
    : options_(options),
      sensor_(choose_sensor(bytes->name(), std::nullopt, std::nullopt, options)),
      bytes_(std::move(bytes), kSampleBytes),
      lines_(bytes_, kLongestYarpLine),
      form_(find_form()),
      decoder_(sensor_, form_, options.reorder_us) {}

bool YarpLogReader::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  decoder_.begin(packet, max_events);
  while (decoder_.has_room() && !is_finished_) {
    if (const auto line = lines_.next()) {
      take_line(*line);
    } else {
      decoder_.counters().malformed_words += lines_.take_skipped();
      decoder_.finish();
      is_finished_ = true;
    }
  }
  return !packet.empty();
}

void YarpLogReader::rewind() {
  bytes_.rewind();
  lines_.restart();
  is_finished_ = false;
  decoder_ = YarpPacketDecoder(sensor_, form_, options_.reorder_us);
}

std::vector<std::string> YarpLogReader::warnings() const {
  return reader_warnings(bytes_.name(), counters(), is_finished_ && !decoder_.has_backlog(),
                         lines_.bytes());
}

YarpRecordForm YarpLogReader::find_form() {
  YarpFormSample sample(sensor_);
  std::string_view rest = bytes_.head();
  for (int i = 0; i < kSampleLines && sample.packets() < kSamplePackets && !rest.empty(); ++i) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    if (parse_yarp_packet(rest.substr(0, end), packet_)) sample.add(packet_);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return sample.form(options_.yarp_eye);
}

void YarpLogReader::take_line(std::string_view line) {
  EventCounters& counters = decoder_.counters();
  counters.malformed_words += lines_.take_skipped();
  if (parse_yarp_packet(line, packet_)) {
    decoder_.take(packet_, lines_.is_whole());
  } else if (!lines_.is_whole()) {
    counters.truncated_bytes += static_cast<std::int64_t>(line.size());
  } else if (line.find_first_not_of(" \t\r") != std::string_view::npos) {
    ++counters.malformed_words;
  }
}

}  // namespace puck
