#include "tools/evaluate/log_recording.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <utility>

#include "common/messaging/conversions.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"

namespace puck {
namespace {

class EventLogReader final : public EventReader {
 public:
  explicit EventLogReader(std::filesystem::path path) : path_(std::move(path)) { rewind(); }

  SensorSize sensor_size() const override { return sensor_; }

  bool read(EventPacket& packet, std::size_t max_events) override {
    if (used_ == packet_.events.size() && !next_packet()) {
      packet.events.clear();
      return false;
    }
    const std::size_t count = std::min(max_events, packet_.events.size() - used_);
    const auto begin = packet_.events.begin() + static_cast<std::ptrdiff_t>(used_);
    packet.start = packet_.start;
    packet.events.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    used_ += count;
    counters_.events += static_cast<std::int64_t>(count);
    return true;
  }

  void rewind() override {
    log_ = std::make_unique<LogReader>(path_);
    packet_ = {};
    used_ = 0;
    session_ = 0;
    newest_ = {};
    counters_ = {};
    malformed_packets_ = 0;
    foreign_packets_ = 0;
    if (!next_packet()) {
      throw EventFileError(path_.string() + ": a log without events on PUCK_EVENTS");
    }
  }

  const EventCounters& counters() const override { return counters_; }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> warnings;
    if (malformed_packets_ > 0) {
      warnings.push_back(path_.string() + ": " + std::to_string(malformed_packets_) +
                         " malformed packets of events left out");
    }
    if (foreign_packets_ > 0) {
      warnings.push_back(
          path_.string() + ": " + std::to_string(foreign_packets_) +
          " packets of events left out, of another camera or of one that was started "
          "again: only the first session is read");
    }
    if (counters_.backwards > 0) {
      warnings.push_back(path_.string() + ": " + std::to_string(counters_.backwards) +
                         " events left out that come too late");
    }
    if (log_->damage()) warnings.push_back(path_.string() + ": " + *log_->damage());
    return warnings;
  }

 private:
  bool next_packet() {
    const std::string channel = channel_name(Channel::kEvents, "");
    event_packet_t message;
    while (log_->next(record_)) {
      if (record_.channel != channel) continue;
      if (decode(record_.bytes, message)) {
        ++malformed_packets_;
        continue;
      }
      if (session_ == 0) {
        session_ = message.session;
        sensor_ = {message.width, message.height};
      }
      if (message.session != session_ || SensorSize{message.width, message.height} != sensor_) {
        ++foreign_packets_;
        continue;
      }
      if (message.count == 0) continue;
      if (Timestamp{message.first_event_us} < newest_) {
        counters_.backwards += message.count;
        continue;
      }
      unpack(message, packet_);
      newest_ = packet_.newest();
      used_ = 0;
      return true;
    }
    return false;
  }

  std::filesystem::path path_;
  std::unique_ptr<LogReader> log_;
  LogRecord record_;
  EventPacket packet_;
  std::size_t used_ = 0;  // events of packet_ handed out already
  std::int64_t session_ = 0;
  SensorSize sensor_;
  Timestamp newest_;
  EventCounters counters_;
  std::int64_t malformed_packets_ = 0;
  std::int64_t foreign_packets_ = 0;
};

}  // namespace

bool is_lcm_log(const std::filesystem::path& path) {
  constexpr std::array<unsigned char, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  std::array<char, 4> first{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(first.data(), first.size())) return false;
  return std::equal(kSync.begin(), kSync.end(), first.begin(),
                    [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); });
}

std::unique_ptr<EventReader> open_event_log(const std::filesystem::path& path) {
  return std::make_unique<EventLogReader>(path);
}

std::vector<TruthRow> read_truth_log(const std::filesystem::path& path) {
  std::vector<TruthRow> rows;
  LogReader log(path);
  LogRecord record;
  const std::string channel = channel_name(Channel::kTruth, "");
  while (log.next(record)) {
    ground_truth_t m;
    if (record.channel != channel || decode(record.bytes, m)) continue;
    if (!rows.empty() && m.sensor_us <= rows.back().time.us) continue;
    rows.push_back(from_message(m));
  }
  return rows;
}

}  // namespace puck
