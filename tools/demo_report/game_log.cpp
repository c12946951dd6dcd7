#include "tools/demo_report/game_log.h"

#include "common/messaging/conversions.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_codec.h"

namespace puck {
namespace {

// False if the record is malformed.
template <typename Message, typename Take>
bool take_as(const LogRecord& record, const Take& take) {
  Message message;
  if (decode(record.bytes, message)) return false;
  take(message);
  return true;
}

template <typename Value>
std::optional<Value> find(const std::map<std::string, std::map<std::string, Value>>& values,
                          const std::string& service, const std::string& name) {
  const auto of_service = values.find(service);
  if (of_service == values.end()) return std::nullopt;
  const auto value = of_service->second.find(name);
  if (value == of_service->second.end()) return std::nullopt;
  return value->second;
}

bool take_record(Channel channel, const LogRecord& record, GameLog& log) {
  switch (channel) {
    case Channel::kEstimate:
      return take_as<puck_estimate_t>(record, [&](const auto& m) { log.estimates.push_back(m); });
    case Channel::kTruth:
      return take_as<ground_truth_t>(record, [&](const ground_truth_t& m) {
        if (!log.truth.empty() && m.sensor_us <= log.truth.back().time.us) return;
        log.truth.push_back(from_message(m));
        log.last_truth = m;
      });
    case Channel::kGame:
      return take_as<game_state_t>(record, [&](const auto& m) { log.last_game = m; });
    case Channel::kStatus:
      return take_as<service_status_t>(record, [&](const service_status_t& m) {
        auto& counters = log.counters[m.service];
        for (std::size_t i = 0; i < m.counter_name.size(); ++i) {
          counters[m.counter_name[i]] = m.counter_value[i];
        }
        auto& latencies = log.latencies[m.service];
        for (std::size_t i = 0; i < m.latency_name.size(); ++i) {
          if (m.latency_samples[i] == 0) continue;
          latencies[m.latency_name[i]] = {m.latency_p50_us[i], m.latency_p99_us[i],
                                          m.latency_max_us[i]};
        }
      });
    case Channel::kEvents:
    case Channel::kTrajectory:
    case Channel::kArmCommand:
    case Channel::kArmState:
    case Channel::kHead:
    case Channel::kCameraControl:
      break;
  }
  return true;
}

}  // namespace

std::optional<std::int64_t> GameLog::counter(const std::string& service,
                                             const std::string& name) const {
  return find(counters, service, name);
}

std::optional<LoggedLatency> GameLog::latency(const std::string& service,
                                              const std::string& name) const {
  return find(latencies, service, name);
}

GameLog read_game_log(const std::filesystem::path& path, const std::string& prefix) {
  GameLog log;
  LogReader reader(path);
  LogRecord record;
  while (reader.next(record)) {
    const auto channel = find_channel(record.channel, prefix);
    if (channel && !take_record(*channel, record, log)) ++log.rejected;
  }
  return log;
}

}  // namespace puck
