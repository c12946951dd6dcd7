#include "common/io/reader_warnings.h"

#include <array>
#include <cstdio>

namespace puck {

std::vector<std::string> reader_warnings(const std::string& name, const EventCounters& counters,
                                         bool is_complete, std::optional<std::int64_t> bytes) {
  std::vector<std::string> lines;
  const auto warn = [&](std::int64_t count, const std::string& what) {
    if (count > 0) lines.push_back(name + ": " + std::to_string(count) + " " + what);
  };
  if (counters.truncated_bytes > 0) {
    lines.push_back(name + ": cut off in the middle of an event or word" +
                    (bytes ? " at byte " + std::to_string(*bytes) : "") + ": the last " +
                    std::to_string(counters.truncated_bytes) + " bytes were left out");
  }
  warn(counters.before_start, "events came before their time or row was known; dropped");
  warn(counters.outside_sensor, "events lie outside the sensor; dropped");
  warn(counters.backwards, "events come too late to be put in order; dropped");
  warn(counters.other_data, "records are of other sensors or of the other eye; skipped");
  warn(counters.malformed_words, "words, lines or packets are malformed; skipped");
  warn(counters.time_glitches, "time stamps contradict their neighbours; ignored");
  if (is_complete && counters.events == 0) lines.push_back(name + ": holds no events");
  return lines;
}

std::optional<std::string> large_loss(const EventCounters& counters) {
  const std::int64_t lost = counters.before_start + counters.outside_sensor + counters.backwards;
  const std::int64_t all = counters.events + lost;
  constexpr std::int64_t kMostShare = 100;
  if (lost == 0 || lost * kMostShare <= all) return std::nullopt;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(),
                "%.1f %% of its events were left out; what is read of it is incomplete",
                100.0 * static_cast<double>(lost) / static_cast<double>(all));
  return text.data();
}

}  // namespace puck
