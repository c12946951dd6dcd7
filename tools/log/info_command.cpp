#include "tools/log/info_command.h"

#include <array>
#include <cinttypes>
#include <cstdio>
#include <ctime>

#include <nlohmann/json.hpp>

#include "common/messaging/wire_layout.h"
#include "tools/log/log_survey.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json channel_json(const std::string& name, const ChannelSurvey& channel,
                  std::int64_t log_began_utime) {
  const LossCounters& arrivals = channel.account.counters();
  Json json;
  json["channel"] = for_terminal(name);
  json["type"] =
      channel.channel ? Json(std::string(wire_layout(*channel.channel).type)) : Json(nullptr);
  json["messages"] = channel.messages;
  json["rate_hz"] = or_null(channel.rate_hz());
  json["bytes"] = channel.bytes;
  json["mb_s"] = or_null(channel.mb_s());
  json["longest_gap_ms"] = static_cast<double>(channel.longest_gap_us) * 1e-3;
  json["longest_gap_at_s"] =
      channel.longest_gap_us == 0
          ? Json(nullptr)
          : Json(static_cast<double>(channel.longest_gap_from - log_began_utime) * 1e-6);
  json["sessions"] = arrivals.sessions;
  json["lost"] = arrivals.lost;
  json["late"] = arrivals.late;
  json["duplicates"] = arrivals.duplicates;
  json["malformed"] = channel.malformed;
  if (channel.channel == Channel::kEvents) {
    json["events"] = channel.events;
    json["event_rate_mev_s"] = or_null(channel.mev_s());
    json["events_lost"] = arrivals.items_lost;
  }
  return json;
}

void print_json(const std::filesystem::path& path, const LogSurvey& survey) {
  Json json;
  json["file"] = for_terminal(path.string());
  json["bytes"] = survey.file_bytes;
  json["messages"] = survey.tally.messages;
  json["first_utime"] = survey.first_utime;
  json["last_utime"] = survey.last_utime;
  json["duration_s"] = survey.duration_s();
  json["foreign"] = survey.tally.foreign;
  json["malformed"] = survey.tally.malformed;
  json["damaged_places"] = survey.tally.damaged_places;
  json["damaged_bytes"] = survey.tally.damaged_bytes;
  json["first_damage"] = survey.first_damage ? Json(*survey.first_damage) : Json(nullptr);
  json["channels"] = Json::array();
  for (const auto& [name, channel] : survey.channels) {
    json["channels"].push_back(channel_json(name, channel, survey.first_utime));
  }
  std::printf("%s\n", json.dump(2).c_str());
}

std::string local_time(std::int64_t utime) {
  const std::time_t seconds = utime / 1'000'000;
  std::tm local{};
  std::array<char, 64> text{};
  if (localtime_r(&seconds, &local) == nullptr) return "?";
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &local);
  return {text.data(), length};
}

/// A number of a fixed width; a dash if empty.
std::string number(const std::optional<double>& value, int width, int digits) {
  std::array<char, 400> text{};
  if (!value) {
    std::snprintf(text.data(), text.size(), "%*s", width, "-");
  } else {
    std::snprintf(text.data(), text.size(), "%*.*f", width, digits, *value);
  }
  return text.data();
}

void print_channel(const std::string& name, const ChannelSurvey& channel) {
  const LossCounters& arrivals = channel.account.counters();
  std::printf("%-24s %10" PRId64 " %s %12" PRId64 " %s %s", for_terminal(name).c_str(),
              channel.messages, number(channel.rate_hz(), 9, 1).c_str(), channel.bytes,
              number(channel.mb_s(), 8, 3).c_str(),
              number(static_cast<double>(channel.longest_gap_us) * 1e-3, 9, 1).c_str());
  if (!channel.channel) {
    std::printf("  not a PUCK channel\n");
    return;
  }
  std::printf(" %8" PRId64 " %8" PRId64 " %6" PRId64 " %9" PRId64 "\n", arrivals.sessions,
              arrivals.lost, arrivals.late + arrivals.duplicates, channel.malformed);
}

void print_table(const std::filesystem::path& path, const LogSurvey& survey) {
  std::printf("%s: %" PRId64 " bytes, %" PRId64 " messages\n", for_terminal(path.string()).c_str(),
              survey.file_bytes, survey.tally.messages);
  if (survey.tally.messages > 0) {
    std::printf("%.3f s, from %s to %s\n\n", survey.duration_s(),
                local_time(survey.first_utime).c_str(), local_time(survey.last_utime).c_str());
    std::printf("%-24s %10s %9s %12s %8s %9s %8s %8s %6s %9s\n", "channel", "messages", "Hz",
                "bytes", "MB/s", "gap ms", "sessions", "lost", "late", "malformed");
  }
  for (const auto& [name, channel] : survey.channels) print_channel(name, channel);
  for (const auto& [name, channel] : survey.channels) {
    if (channel.channel != Channel::kEvents) continue;
    std::printf("\n%s: %" PRId64 " events, %s Mev/s, %" PRId64 " events lost\n",
                for_terminal(name).c_str(), channel.events, number(channel.mev_s(), 0, 3).c_str(),
                channel.account.counters().items_lost);
  }
  std::printf("\n%s\n", in_words(survey.tally).c_str());
  if (survey.first_damage) std::printf("the first: %s\n", survey.first_damage->c_str());
}

}  // namespace

LogTally print_log_info(const std::filesystem::path& path, bool as_json) {
  const LogSurvey survey = survey_log(path);
  if (as_json) {
    print_json(path, survey);
  } else {
    print_table(path, survey);
  }
  return survey.tally;
}

}  // namespace puck
