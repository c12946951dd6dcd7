#include "tools/info/survey.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "common/io/reader_warnings.h"

namespace puck {
namespace {

constexpr std::int64_t kShortestGap_us = 10'000;
constexpr std::size_t kMostGaps = 5;

void add_gap(Survey& survey, Timestamp from, std::int64_t length_us) {
  ++survey.gap_count;
  const auto place = std::find_if(survey.gaps.begin(), survey.gaps.end(),
                                  [&](const EventGap& gap) { return gap.length_us < length_us; });
  survey.gaps.insert(place, {from, length_us});
  if (survey.gaps.size() > kMostGaps) survey.gaps.pop_back();
}

void add_packet(Survey& survey, const EventPacket& packet, bool is_first) {
  if (is_first) survey.first = survey.last = packet.time_of(packet.events.front());
  for (const Event& event : packet.events) {
    const Timestamp time = packet.time_of(event);
    const std::int64_t step_us = time - survey.last;
    if (step_us > 0 && survey.time_step_us != 1) {
      survey.time_step_us = std::gcd(survey.time_step_us, step_us);
    }
    if (step_us >= kShortestGap_us) add_gap(survey, survey.last, step_us);
    survey.last = time;
    survey.brighter += event.polarity;
    survey.rates.add(time);
    ++survey.pixel_counts[static_cast<std::size_t>(event.y) *
                              static_cast<std::size_t>(survey.sensor.width) +
                          event.x];
  }
}

// What was left out without a fault of the file, as another camera's data, is none.
void add_problems(Survey& survey) {
  const EventCounters& counters = survey.counters;
  const auto add = [&](std::int64_t count, const char* what) {
    if (count > 0) survey.problems.push_back(std::to_string(count) + " " + what);
  };
  add(counters.truncated_bytes, "bytes at the end are no whole event: the file is cut off");
  add(counters.malformed_words, "words, lines or packets are malformed");
  add(counters.backwards, "events are older than the ones before them");
  add(counters.outside_sensor, "events lie outside the sensor");
  add(counters.time_glitches, "time stamps contradict their neighbours");
  add(counters.missing, "events are missing");
  if (const auto loss = large_loss(counters)) survey.problems.push_back(*loss);
  if (counters.events == 0) survey.problems.emplace_back("there are no events");
}

}  // namespace

Survey survey_recording(EventReader& events, const std::string& name) {
  Survey survey;
  survey.name = name;
  survey.sensor = events.sensor_size();
  survey.facts = events.facts();
  survey.pixel_counts.resize(static_cast<std::size_t>(survey.sensor.width) *
                             static_cast<std::size_t>(survey.sensor.height));
  HotPixelFinder finder(survey.sensor);
  EventPacket packet;
  try {
    bool is_first = true;
    while (events.read(packet, EventReader::kUsualEvents)) {
      add_packet(survey, packet, is_first);
      finder.add(packet);
      is_first = false;
    }
  } catch (const EventFileError& error) {
    survey.problems.emplace_back(error.what());
  }
  survey.counters = events.counters();
  survey.warnings = events.warnings();
  try {
    survey.hot_pixels = finder.find();
  } catch (const std::invalid_argument&) {
    // Too short.
  }
  add_problems(survey);
  return survey;
}

}  // namespace puck
