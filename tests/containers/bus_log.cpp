#include "tests/containers/bus_log.h"

#include <algorithm>

#include "common/messaging/channels.h"
#include "common/messaging/datagram.h"
#include "common/messaging/log_file.h"
#include "common/messaging/message_check.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/status_reporter.h"
#include "tests/support/status_counter.h"

namespace puck {
namespace {

template <typename Message>
void keep(const LogRecord& record, std::vector<Heard<Message>>& all) {
  Heard<Message>& heard = all.emplace_back();
  heard.at_us = record.utime;
  decode_checked(record.bytes, heard.message);
}

void take(Channel channel, const LogRecord& record, BusLog& log) {
  const std::int64_t session = read_header(record.bytes).session;
  log.heard_us[session].push_back(record.utime);
  // LCM's header and the channel's name with its NUL precede the message.
  const std::size_t datagram_bytes =
      kLcmHeaderBytes + record.channel.size() + 1 + record.bytes.size();
  if (channel != Channel::kStatus && datagram_bytes > log.largest_datagram_bytes) {
    log.largest_datagram_bytes = datagram_bytes;
    log.largest_datagram_channel = record.channel;
  }
  switch (channel) {
    case Channel::kEstimate:
      return keep(record, log.estimates);
    case Channel::kStatus:
      return keep(record, log.statuses);
    case Channel::kArmState:
      return keep(record, log.arm_states);
    case Channel::kArmCommand:
      return keep(record, log.commands);
    case Channel::kEvents:
      log.events_sessions.insert(session);
      log.events_datagrams.push_back({record.utime, datagram_bytes});
      return;
    case Channel::kTrajectory:
    case Channel::kGame:
    case Channel::kHead:
    case Channel::kTruth:
    case Channel::kCameraControl:
      return;
  }
}

}  // namespace

BusLog read_bus_log(const std::filesystem::path& path, const std::string& prefix) {
  BusLog log;
  LogReader reader(path);
  LogRecord record;
  while (reader.next(record)) {
    const auto channel = find_channel(record.channel, prefix);
    if (channel && !check_message(*channel, record.bytes)) take(*channel, record, log);
  }
  return log;
}

std::optional<std::int64_t> ServiceRun::counter(const std::string& name) const {
  return test::counter(last, name);
}

std::optional<std::int64_t> ServiceRun::rare_counter(const std::string& name) const {
  const auto count = counter(name);
  if (count || counter(StatusReporter::kLeftOut)) return count;
  return 0;
}

std::vector<ServiceRun> runs_of(const BusLog& log, const std::string& service) {
  std::vector<ServiceRun> runs;
  for (const auto& [at_us, status] : log.statuses) {
    if (status.service != service) continue;
    const auto known = std::find_if(
        runs.begin(), runs.end(),
        [session = status.session](const ServiceRun& run) { return run.session == session; });
    if (known != runs.end()) {
      known->last = status;
    } else {
      runs.push_back({status.session, status.utime - status.uptime_us, status});
    }
  }
  return runs;
}

std::optional<Silence> longest_silence(const BusLog& log, std::int64_t session) {
  const auto heard = log.heard_us.find(session);
  if (heard == log.heard_us.end()) return std::nullopt;
  const std::vector<std::int64_t>& times = heard->second;
  std::optional<Silence> longest;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const Silence silence{times[i - 1], times[i]};
    if (!longest || silence.end_us - silence.begin_us > longest->end_us - longest->begin_us) {
      longest = silence;
    }
  }
  return longest;
}

}  // namespace puck
