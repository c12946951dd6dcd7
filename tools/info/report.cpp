#include "tools/info/report.h"

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>

#include "common/io/one_line.h"

namespace puck {
namespace {

constexpr std::size_t kRateRows = 20;
constexpr std::size_t kBarLength = 40;
constexpr std::size_t kMostListed = 5;

[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...) {
  std::array<char, 256> text{};
  va_list values;
  va_start(values, format);
  std::vsnprintf(text.data(), text.size(), format, values);
  va_end(values);
  return text.data();
}

// In the unit that gives one to three digits before the point.
std::string rate_text(double events_per_s) {
  if (events_per_s >= 1e6) return formatted("%.2f Mev/s", events_per_s * 1e-6);
  if (events_per_s >= 1e3) return formatted("%.2f kev/s", events_per_s * 1e-3);
  return formatted("%.2f ev/s", events_per_s);
}

std::string line(const char* title, const std::string& text) {
  return formatted("  %-11s", title) + text + "\n";
}

double seconds_of(std::int64_t us) { return static_cast<double>(us) * 1e-6; }

std::string header_lines(const Survey& survey) {
  std::string text;
  for (const auto& [key, value] : survey.facts.header) {
    text += line(text.empty() ? "header" : "", one_line(key + ": " + value));
  }
  return text;
}

std::string pixel_lines(const Survey& survey) {
  const auto busiest = std::max_element(survey.pixel_counts.begin(), survey.pixel_counts.end());
  const auto fired = std::count_if(survey.pixel_counts.begin(), survey.pixel_counts.end(),
                                   [](std::uint32_t count) { return count > 0; });
  const auto index = static_cast<int>(busiest - survey.pixel_counts.begin());
  std::string text = line(
      "pixels", formatted("%.1f %% fired; the busiest, (%d, %d), %u times (%.2f %% of the events)",
                          100.0 * static_cast<double>(fired) /
                              static_cast<double>(survey.pixel_counts.size()),
                          index % survey.sensor.width, index / survey.sensor.width, *busiest,
                          100.0 * *busiest / static_cast<double>(survey.counters.events)));
  if (!survey.hot_pixels) return text + line("hot pixels", "not known in less than 1 s");
  const HotPixelReport& hot = *survey.hot_pixels;
  std::string list;
  for (std::size_t i = 0; i < std::min(kMostListed, hot.pixels.size()); ++i) {
    const HotPixel& pixel = hot.pixels[i];
    list += formatted("%s(%d, %d) %.0f Hz", i == 0 ? ": " : ", ", pixel.place.x, pixel.place.y,
                      pixel.rate_hz);
  }
  if (hot.pixels.size() > kMostListed) list += ", …";
  return text + line("hot pixels", formatted("%zu, with %.2f %% of the events", hot.pixels.size(),
                                             100.0 * static_cast<double>(hot.hot_events) /
                                                 static_cast<double>(survey.counters.events)) +
                                       list);
}

std::string gap_lines(const Survey& survey) {
  if (survey.gaps.empty()) return line("gaps", "none of 10 ms or more");
  std::string list;
  for (const EventGap& gap : survey.gaps) {
    list += formatted("%s%.3f s at %.3f s", list.empty() ? "" : ", ", seconds_of(gap.length_us),
                      seconds_of(gap.from.us));
  }
  return line("gaps", formatted("%lld of 10 ms or more; the longest: ",
                                static_cast<long long>(survey.gap_count)) +
                          list);
}

std::string rate_table(const Survey& survey) {
  std::int64_t row_us = 0;
  const std::vector<std::int64_t> rows = survey.rates.coarse(kRateRows, row_us);
  const std::int64_t most = *std::max_element(rows.begin(), rows.end());
  std::string text =
      formatted("  rate, in steps of %g s from the first event on\n", seconds_of(row_us));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // The last row may be shorter.
    const std::int64_t from_us = static_cast<std::int64_t>(i) * row_us;
    const std::int64_t length_us =
        std::clamp<std::int64_t>(survey.last - survey.first - from_us, 1, row_us);
    const auto bar = static_cast<std::size_t>(static_cast<double>(rows[i]) * kBarLength /
                                              static_cast<double>(most));
    text += formatted("  %10.3f s %14s  ", seconds_of(from_us),
                      rate_text(static_cast<double>(rows[i]) / seconds_of(length_us)).c_str()) +
            std::string(bar, '#') + "\n";
  }
  return text;
}

std::string time_lines(const Survey& survey) {
  const auto events = static_cast<double>(survey.counters.events);
  std::string text =
      line("events", formatted("%lld in %.6f s", static_cast<long long>(survey.counters.events),
                               survey.seconds()) +
                         (survey.seconds() > 0 ? ", " + rate_text(events / survey.seconds()) : ""));
  text += line("times", formatted("%.6f s to %.6f s, in steps of %lld µs; %lld wraps",
                                  seconds_of(survey.first.us), seconds_of(survey.last.us),
                                  static_cast<long long>(survey.time_step_us),
                                  static_cast<long long>(survey.counters.time_wraps)));
  text +=
      line("polarity", formatted("%.1f %% brighter, %.1f %% darker",
                                 100.0 * static_cast<double>(survey.brighter) / events,
                                 100.0 - 100.0 * static_cast<double>(survey.brighter) / events));
  return text;
}

}  // namespace

std::string survey_text(const Survey& survey) {
  std::string text = one_line(survey.name) + "\n";
  std::string format = survey.facts.encoding.empty() ? "not told" : survey.facts.encoding;
  if (survey.bytes) format += formatted(", %lld bytes", static_cast<long long>(*survey.bytes));
  text += line("encoding", one_line(format)) + header_lines(survey);
  text += line("sensor", formatted("%d x %d px", survey.sensor.width, survey.sensor.height));
  if (survey.counters.events > 0) {
    text += time_lines(survey) + pixel_lines(survey) + gap_lines(survey) + rate_table(survey);
  }
  for (const std::string& warning : survey.warnings) text += line("skipped", warning);
  for (const std::string& problem : survey.problems) text += line("WRONG", problem);
  if (survey.problems.empty()) text += line("verdict", "nothing is wrong with it");
  return text;
}

}  // namespace puck
