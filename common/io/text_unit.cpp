#include "common/io/text_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/io/number_limits.h"
#include "common/io/parse_number.h"

namespace puck {
namespace {

struct NamedUnit {
  const char* name;
  TimeUnit unit;
  double seconds;
};

constexpr std::array<NamedUnit, 4> kUnits{{
    {"s", TimeUnit::kSeconds, 1},
    {"ms", TimeUnit::kMilliseconds, 1e-3},
    {"us", TimeUnit::kMicroseconds, 1e-6},
    {"ns", TimeUnit::kNanoseconds, 1e-9},
}};

const NamedUnit& named(TimeUnit unit) {
  return *std::find_if(kUnits.begin(), kUnits.end(),
                       [unit](const NamedUnit& each) { return each.unit == unit; });
}

// Mean rates of an event camera over a recording's beginning.
constexpr double kFewestEventsASecond = 1;
constexpr double kMostEventsASecond = 50e6;
// The rate of fewer events proves nothing.
constexpr std::int64_t kFewestEvents = 10;
// Whether the numbers' form is chance.
constexpr std::int64_t kEnoughEvents = 100;

std::string short_number(double value) {
  std::array<char, 32> text{};
  const int length =
      std::snprintf(text.data(), text.size(), value >= 1000 ? "%.0f" : "%.3g", value);
  return {text.data(), static_cast<std::size_t>(length)};
}

std::string duration(double seconds) {
  constexpr double kMinute = 60;
  constexpr double kHour = 3600;
  constexpr double kDay = 86400;
  if (seconds >= 2 * kDay) return std::to_string(std::llround(seconds / kDay)) + " days";
  if (seconds >= 2 * kHour) return std::to_string(std::llround(seconds / kHour)) + " hours";
  if (seconds >= 2 * kMinute) return std::to_string(std::llround(seconds / kMinute)) + " minutes";
  return short_number(seconds) + " s";
}

// Decimals that a number needs, whatever form it was written in.
int decimals_of(double value) {
  constexpr int kMost = 9;
  constexpr double kExact = 1e-6;
  int decimals = 0;
  while (decimals < kMost && std::abs(value - std::round(value)) > kExact) {
    value *= 10;
    ++decimals;
  }
  return decimals;
}

}  // namespace

void TextTimes::add(std::string_view time) {
  double value = 0;
  if (!parse_number(time, value)) return;
  if (count_++ == 0) oldest_ = newest_ = value;
  oldest_ = std::min(oldest_, value);
  newest_ = std::max(newest_, value);
  const std::size_t point = time.find('.');
  const std::size_t exponent = time.find_first_of("eE");
  has_point_ = has_point_ || point != std::string_view::npos || exponent != std::string_view::npos;
  has_fraction_ = has_fraction_ || value != std::floor(value);
  is_in_thousands_ = is_in_thousands_ && std::fmod(value, 1000) == 0;
  if (exponent != std::string_view::npos) {
    most_decimals_ = std::max(most_decimals_, decimals_of(value));
  } else if (point != std::string_view::npos) {
    const auto last = static_cast<int>(time.find_last_not_of('0'));
    most_decimals_ = std::max(most_decimals_, last - static_cast<int>(point));
  }
}

TimeUnit TextTimes::unit(const std::string& name, std::vector<std::string>& notes) const {
  const TimeUnit usual = has_point_ ? TimeUnit::kSeconds : TimeUnit::kMicroseconds;
  if (count_ < kFewestEvents || newest_ <= oldest_) {
    return has_point_ || !has_fraction_ ? usual : TimeUnit::kSeconds;
  }
  std::vector<TimeUnit> possible;
  for (const NamedUnit& each : kUnits) {
    if (is_possible(each.unit)) possible.push_back(each.unit);
  }
  const bool is_usual_possible = is_possible(usual);
  const bool is_enough = count_ >= kEnoughEvents;
  // Forms that another unit explains as well.
  const bool may_be_ms = is_enough && usual == TimeUnit::kSeconds && has_fraction_ &&
                         most_decimals_ <= 3 && is_possible(TimeUnit::kMilliseconds);
  const bool may_be_ns = is_enough && usual == TimeUnit::kMicroseconds && is_in_thousands_ &&
                         is_possible(TimeUnit::kNanoseconds);
  if (is_usual_possible && !may_be_ms && !may_be_ns) return usual;
  if (possible.size() == 1) {
    notes.push_back(
        "took the times as " + std::string(named(possible[0]).name) +
        ", the only unit that gives a camera's rate of events: " + describe(possible[0]));
    return possible[0];
  }
  std::string choices;
  for (const TimeUnit each : possible) {
    choices += (choices.empty() ? "" : ", or ") + std::string(named(each).name) + " (" +
               describe(each) + ")";
  }
  // Whole numbers with a decimal point are most often µs.
  const bool is_us = !has_fraction_ && is_possible(TimeUnit::kMicroseconds);
  const TimeUnit likely = is_us || possible.empty() ? TimeUnit::kMicroseconds : possible.front();
  const std::string may_be = choices.empty() ? "In no unit do they give a camera's rate"
                                             : "The times may be in " + choices;
  throw EventFileError(name + ": " + describe(usual) + " if the times are in " + named(usual).name +
                       ": is the unit " + named(likely).name + "? " + may_be +
                       "; give the unit (--unit or camera.text_unit: s, ms, us or ns)");
}

bool TextTimes::is_possible(TimeUnit unit) const {
  const double us = newest_ * named(unit).seconds * 1e6;
  if (us > kLatestUs) return false;
  const double rate = events_a_second(unit);
  if (rate < kFewestEventsASecond || rate > kMostEventsASecond) return false;
  if (count_ < kEnoughEvents) return true;
  // Sensors count whole µs, and more than seconds.
  if (has_fraction_) return unit == TimeUnit::kSeconds || unit == TimeUnit::kMilliseconds;
  return unit != TimeUnit::kSeconds;
}

double TextTimes::events_a_second(TimeUnit unit) const {
  return static_cast<double>(count_ - 1) / span_s(unit);
}

double TextTimes::span_s(TimeUnit unit) const { return (newest_ - oldest_) * named(unit).seconds; }

std::string TextTimes::describe(TimeUnit unit) const {
  return short_number(events_a_second(unit)) + " events a second over " + duration(span_s(unit));
}

std::optional<TimeUnit> unit_of_name(std::string_view name) {
  const std::size_t before = name.find_last_of("_[( ");
  if (before == std::string_view::npos) return std::nullopt;
  std::string_view unit = name.substr(before + 1);
  while (!unit.empty() && (unit.back() == ']' || unit.back() == ')')) unit.remove_suffix(1);
  if (unit == "µs" || unit == "usec") return TimeUnit::kMicroseconds;
  if (unit == "sec" || unit == "seconds") return TimeUnit::kSeconds;
  return unit_called(unit);
}

std::optional<TimeUnit> unit_called(std::string_view name) {
  for (const NamedUnit& each : kUnits) {
    if (name == each.name) return each.unit;
  }
  return std::nullopt;
}

}  // namespace puck
