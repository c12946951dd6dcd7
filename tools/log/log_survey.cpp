#include "tools/log/log_survey.h"

#include <algorithm>

#include "common/messaging/message_check.h"

namespace puck {
namespace {

// A log may hold any number of names.
constexpr std::size_t kMostChannels = 1000;

std::optional<double> per_second(double amount, const ChannelSurvey& channel) {
  const std::int64_t span_us = channel.last_utime - channel.first_utime;
  if (span_us <= 0) return std::nullopt;
  return 1e6 * amount / static_cast<double>(span_us);
}

void add(const LoggedMessage& message, ChannelSurvey& survey) {
  // Damaged logs hold arbitrary times; their difference must not overflow.
  constexpr std::int64_t kMost = std::int64_t{1} << 61;
  const LogRecord& record = message.record;
  const std::int64_t utime = std::clamp<std::int64_t>(record.utime, -kMost, kMost);
  if (survey.messages == 0) {
    survey.channel = message.channel;
    survey.first_utime = utime;
  } else if (utime - survey.last_utime > survey.longest_gap_us) {
    survey.longest_gap_us = utime - survey.last_utime;
    survey.longest_gap_from = survey.last_utime;
  }
  survey.last_utime = utime;
  ++survey.messages;
  survey.bytes += static_cast<std::int64_t>(record.bytes.size());
  if (message.rejection) {
    ++survey.malformed;
  } else if (message.channel == Channel::kEvents) {
    const MessageHeader header = read_header(record.bytes);
    const EventNumbering numbering = read_event_numbering(record.bytes);
    survey.account.add(header.session, header.seq, numbering.events_before, numbering.events);
    survey.events += numbering.events;
  } else if (message.channel) {
    const MessageHeader header = read_header(record.bytes);
    survey.account.add(header.session, header.seq);
  }
}

}  // namespace

std::optional<double> ChannelSurvey::rate_hz() const {
  return per_second(static_cast<double>(messages - 1), *this);
}

std::optional<double> ChannelSurvey::mb_s() const {
  return per_second(1e-6 * static_cast<double>(bytes), *this);
}

std::optional<double> ChannelSurvey::mev_s() const {
  return per_second(1e-6 * static_cast<double>(events), *this);
}

LogSurvey survey_log(const std::filesystem::path& path) {
  LogSurvey survey;
  survey.tally = read_log(
      path,
      [&](const LoggedMessage& message) {
        const std::string& name = message.record.channel;
        const bool has_place =
            survey.channels.contains(name) || survey.channels.size() < kMostChannels;
        add(message, survey.channels[has_place ? name : LogSurvey::kOther]);
      },
      [&](const LogDamage& damage) {
        if (survey.first_damage) return;
        survey.first_damage = damage.why + " at byte " + std::to_string(damage.offset);
      });
  survey.file_bytes = static_cast<std::int64_t>(std::filesystem::file_size(path));
  bool is_first = true;
  for (const auto& [name, channel] : survey.channels) {
    survey.first_utime =
        is_first ? channel.first_utime : std::min(survey.first_utime, channel.first_utime);
    survey.last_utime =
        is_first ? channel.last_utime : std::max(survey.last_utime, channel.last_utime);
    is_first = false;
  }
  return survey;
}

}  // namespace puck
