#include "common/messaging/event_log.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/messaging/channels.h"
#include "common/messaging/event_packing.h"
#include "common/messaging/message_check.h"
#include "common/messaging/wire_layout.h"

namespace puck {
namespace {

// After a longer pause between two sessions, the host's clock was set.
constexpr std::int64_t kLongestPauseUs = std::int64_t{3600} * 1'000'000;

// Saturates, since sums from a damaged or forged log could overflow.
std::int64_t total(std::int64_t before, std::int64_t now) {
  return std::min(before + now, kMostOnWire);
}

}  // namespace

EventLog::EventLog(std::filesystem::path path, std::string_view prefix, Sessions sessions)
    : path_(std::move(path)),
      channel_(channel_name(Channel::kEvents, prefix)),
      sessions_(sessions) {
  rewind();
}

void EventLog::rewind() {
  log_ = std::make_unique<LogReader>(path_);
  newest_number_ = std::numeric_limits<std::int64_t>::min();
  is_behind_joint_ = false;
  publisher_ = {};
  newest_seq_ = 0;
  session_number_ = 0;
  losses_ = {};
  sensor_ = {};
  shift_us_ = 0;
  newest_ = {};
  newest_utime_ = 0;
  packet_ = {};
  used_ = 0;
  counters_ = {};
  before_ = {};
  // The first packet gives the sensor's size.
  if (!next_packet()) {
    log_.reset();
    throw LogFileError(nothing_found());
  }
}

std::string EventLog::nothing_found() const {
  std::string text = path_.string() + ": a log without events on " + channel_;
  if (!similar_channel_.empty()) text += "; it has " + similar_channel_ + ", of another prefix";
  return text;
}

bool EventLog::read(EventPacket& packet, std::size_t max_events) {
  packet.events.clear();
  if (!log_) throw LogFileError(nothing_found());
  if (used_ == packet_.events.size() && !next_packet()) return false;
  const std::size_t count = std::min(max_events, packet_.events.size() - used_);
  const auto begin = packet_.events.begin() + static_cast<std::ptrdiff_t>(used_);
  packet.start = packet_.start;
  packet.events.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  if (used_ == 0) ++counters_.packets;
  counters_.events += static_cast<std::int64_t>(count);
  used_ += count;
  return true;
}

bool EventLog::next_packet() {
  while (log_->next(record_)) {
    note_joint(record_.number);
    if (record_.channel != channel_) {
      if (find_channel_of_any_prefix(record_.channel) == Channel::kEvents) {
        similar_channel_ = record_.channel;
      }
      continue;
    }
    if (check_message(Channel::kEvents, record_.bytes)) {
      ++counters_.packets_malformed;
      continue;
    }
    EventPacketView packet;
    decode_checked(record_.bytes, packet);
    // check_message() does not cover the log's own time stamps.
    if (take(packet, std::clamp<std::int64_t>(record_.utime, 0, kMostOnWire))) return true;
  }
  return false;
}

// Whether the packet's events are the next ones.
bool EventLog::take(const EventPacketView& packet, std::int64_t heard_utime) {
  if (!follows(packet, heard_utime)) return false;
  count(packet);
  counters_.events_dropped = total(before_.events_dropped, packet.events_dropped);
  if (packet.count == 0) return false;
  const std::int64_t first_us = packet.first_event_us + shift_us_;
  if (first_us > kMostOnWire) {
    ++counters_.packets_malformed;
    return false;
  }
  if (first_us < newest_.us) {
    ++counters_.packets_late;
    return false;
  }
  unpack(packet, packet_);
  packet_.start = packet_.start + shift_us_;
  newest_ = packet_.newest();
  newest_utime_ = heard_utime;
  used_ = 0;
  return true;
}

// A logger counts its messages, so a lower number is the beginning of another log.
void EventLog::note_joint(std::int64_t record_number) {
  if (record_number < newest_number_ && sessions_ == Sessions::kJoined) is_behind_joint_ = true;
  newest_number_ = record_number;
}

// The log may also be the next part of one session, as of a logger that began a new file.
bool EventLog::begins_at_joint(const EventPacketView& packet) {
  if (!std::exchange(is_behind_joint_, false)) return false;
  return packet.session != publisher_.session() || packet.seq <= newest_seq_;
}

bool EventLog::follows(const EventPacketView& packet, std::int64_t heard_utime) {
  const SensorSize sensor{packet.width, packet.height};
  const bool is_first = sensor_ == SensorSize{};
  const bool may_follow =
      is_first || packet.session == publisher_.session() || sessions_ == Sessions::kJoined;
  if (!may_follow || (!is_first && sensor != sensor_)) {
    ++counters_.packets_of_others;
    return false;
  }
  if (begins_at_joint(packet)) {
    publisher_ = {};
    newest_utime_ = heard_utime - kJointUs;
  }
  switch (publisher_.hear(packet.session, packet.seq, heard_utime)) {
    case SinglePublisher::Verdict::kAccepted:
      newest_seq_ = packet.seq;
      return true;
    case SinglePublisher::Verdict::kNewPublisher:
      newest_seq_ = packet.seq;
      begin_session(packet, heard_utime);
      return true;
    case SinglePublisher::Verdict::kLate:
      count(packet);
      ++counters_.packets_late;
      return false;
    case SinglePublisher::Verdict::kOtherPublisher:
      break;
  }
  ++counters_.packets_of_others;
  return false;
}

void EventLog::begin_session(const EventPacketView& packet, std::int64_t heard_utime) {
  losses_ = {};
  before_ = counters_;
  const bool is_first = sensor_ == SensorSize{};
  sensor_ = {packet.width, packet.height};
  if (is_first) return;
  ++session_number_;
  const std::int64_t pause_us =
      std::clamp<std::int64_t>(heard_utime - newest_utime_, 1, kLongestPauseUs);
  shift_us_ = (newest_ + pause_us).us - packet.first_event_us;
}

void EventLog::count(const EventPacketView& packet) {
  losses_.add(packet.session, packet.seq, packet.events_before, packet.count);
  const LossCounters& losses = losses_.counters();
  counters_.packets_missing = total(before_.packets_missing, losses.lost);
  counters_.events_missing = total(before_.events_missing, losses.items_lost);
}

std::vector<std::string> EventLog::problems() const {
  std::vector<std::string> problems;
  const auto tell = [&](std::int64_t packets, const std::string& what) {
    if (packets > 0) {
      problems.push_back(path_.string() + ": " + std::to_string(packets) + " packets of events " +
                         what);
    }
  };
  tell(counters_.packets_malformed, "left out: malformed");
  tell(counters_.packets_late, "left out: late or duplicate");
  tell(counters_.packets_of_others,
       sessions_ == Sessions::kFirst
           ? "left out: published by another camera or after a restart of this one; only the "
             "first session is read"
           : "left out: published by another camera");
  tell(counters_.packets_missing, "missing; together with late packets, " +
                                      std::to_string(counters_.events_missing) + " events");
  if (log_ && log_->damage()) {
    problems.push_back(path_.string() + ": " + *log_->damage() + "; " +
                       std::to_string(log_->bytes_skipped()) + " bytes skipped");
  }
  return problems;
}

}  // namespace puck
