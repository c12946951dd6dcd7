#include "tests/bench/busy_game.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace puck {

std::vector<TimedPixel> timed(const EventPacket& packet) {
  std::vector<TimedPixel> events;
  events.reserve(packet.events.size());
  for (const Event& event : packet.events) {
    events.push_back({(packet.start + event.offset_us).us, event});
  }
  return events;
}

void sort_by_time(std::vector<TimedPixel>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const TimedPixel& a, const TimedPixel& b) { return a.time_us < b.time_us; });
}

std::vector<TimedPixel> busy_game(const EventPacket& game, double rate_mev_s, std::size_t most) {
  constexpr double kRepeat_us = 500;
  const std::vector<TimedPixel> events = timed(game);
  const auto span_us = static_cast<double>(events.back().time_us - events.front().time_us);
  const double times = rate_mev_s / (static_cast<double>(events.size()) / span_us);
  std::mt19937 random(2);
  std::exponential_distribution<double> delay_us(1 / kRepeat_us);
  std::vector<TimedPixel> busy;
  double owed = 0;
  for (const TimedPixel& event : events) {
    if (busy.size() > most) break;
    owed += times;
    for (bool repeats = false; owed >= 1; owed -= 1, repeats = true) {
      busy.push_back(event);
      if (repeats) busy.back().time_us += std::llround(delay_us(random));
    }
  }
  sort_by_time(busy);
  return busy;
}

}  // namespace puck
