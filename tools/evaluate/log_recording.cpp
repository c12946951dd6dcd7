#include "tools/evaluate/log_recording.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <system_error>

#include "common/messaging/conversions.h"
#include "common/messaging/event_log.h"
#include "common/messaging/log_file.h"

namespace puck {

bool is_lcm_log(const std::filesystem::path& path) {
  constexpr std::array<unsigned char, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
  // A log is a file; a pipe can be read only once.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, 4> first{};
  std::ifstream file(path, std::ios::binary);
  if (!file.read(first.data(), first.size())) return false;
  return std::equal(kSync.begin(), kSync.end(), first.begin(),
                    [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); });
}

std::int64_t session_of_event_log(const std::filesystem::path& path, const std::string& prefix) {
  return EventLog(path, prefix, EventLog::Sessions::kFirst).session();
}

std::vector<TruthRow> read_truth_log(const std::filesystem::path& path, const std::string& prefix) {
  std::vector<TruthRow> rows;
  LogReader log(path);
  LogRecord record;
  const std::string channel = channel_name(Channel::kTruth, prefix);
  while (log.next(record)) {
    GroundTruth truth;
    if (record.channel != channel || decode(record.bytes, truth)) continue;
    if (!rows.empty() && truth.time <= rows.back().time) continue;
    rows.push_back(truth);
  }
  return rows;
}

}  // namespace puck
