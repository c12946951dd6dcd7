#include "common/vision/scene/background.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace puck {
namespace {

constexpr std::int64_t kPeriod_us = 1'000;
// That of an ordinary lens, in widths of the sensor.
constexpr double kFocal_widths = 1.1;
// A place with so many events half counts as one that stands still.
constexpr double kHalf = 60;
// What stands still is so much clearer than noise.
constexpr double kAboveNoise = 10;
// However many events a cell has, they count for no more than so many.
constexpr double kFew = 5;
// How stiffly the turn keeps to its prediction, in squared slopes of the fit; and how much of what
// the fit has found changes the prediction.
constexpr double kStiffness = 4;
constexpr double kSpeedGain = 0.08;
// With fewer events on the map, by their weights, the head may have stopped: in each period so much
// of its speed is kept.
constexpr double kLeastSupport = 2;
constexpr double kSpeedKept = 0.9;
// Events on the map in `least_cells` cells of the image, each so many of late: the scene moves as
// one.
constexpr double kActivityMemory_us = 50'000;
constexpr double kActive = 5;
// … and of all events but noise, which a hand and two mallets have in fewer cells.
constexpr double kBusy = 60;
constexpr int kLeastBusyCells = 16;
// While the head turns, more than this share of all that is seen is on the map, hands and mallets
// included.
constexpr double kTurningShare = 0.6;
// A map on which so little lies for so long is of another scene, or smeared.
constexpr std::int64_t kLongestUnknown_us = 2'000'000;

using Steps = CameraTurn::Steps;

// Solves a·x = b for a symmetric positive a.
Steps solved(std::array<Steps, 3> a, Steps b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t row = i + 1; row < 3; ++row) {
      const double factor = a[row][i] / a[i][i];
      for (std::size_t k = i; k < 3; ++k) a[row][k] -= factor * a[i][k];
      b[row] -= factor * b[i];
    }
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

CameraTurn turn_of(SensorSize sensor) {
  return {{(sensor.width - 1) / 2.0, (sensor.height - 1) / 2.0}, kFocal_widths * sensor.width};
}

}  // namespace

Background::Background(SensorSize sensor, int least_cells)
    : sensor_(sensor),
      least_cells_(least_cells),
      cells_(sensor),
      map_(sensor),
      turn_(turn_of(sensor)) {
  taken_.reserve(kMostEvents);
  last_.events.reserve(kMostEvents);
  then_.reserve(kMostEvents);
}

void Background::clear_map() {
  map_.clear();
  turn_ = turn_of(sensor_);
  speed_ = {};
  trail_.clear();
  unknown_us_ = 0;
}

void Background::decide(std::int64_t time_us, double noise_per_pixel_us) {
  const std::int64_t passed_us = time_us - decided_us_;
  if (passed_us < kPeriod_us) return;
  work_off();
  decided_us_ = time_us;
  last_.time_us = time_us;
  last_.passed_us = passed_us;
  last_.noise = noise_per_pixel_us * static_cast<double>(std::min(passed_us, kPeriod_us)) /
                static_cast<double>(stride_);
  std::swap(last_.events, taken_);
  is_owed_ = true;
  taken_.clear();
  stride_ = 1 + seen_ / static_cast<std::int64_t>(kMostEvents);
  until_taken_ = 1;
  seen_ = 0;
}

void Background::work_off() {
  if (!is_owed_) return;
  is_owed_ = false;
  // Noise would turn it away from the map, never to come back.
  if (head_rests()) {
    speed_ = {};
    trail_.clear();
  } else {
    align();
    trail_.note(turn_, last_.time_us);
  }
  place_events();
  still_level_ = std::max(kStill, map_.level_of_noise() + kAboveNoise);
  note_activity();
  if (unknown_us_ > kLongestUnknown_us) {
    clear_map();
    place_events();
  }
  map_.advance(last_.time_us);
  for (const Pixel& then : then_) map_.add(then);
  map_.note_noise(last_.noise);
}

void Background::place_events() {
  then_.clear();
  for (const Pixel& event : last_.events) then_.push_back(turn_.then_of(event));
}

// A step of Gauss-Newton on how far the events are from lying on the map, (half / (level + half))².
// A hand that moves has more events than all that stands still, and trails on the map next to them,
// so that it would draw the map along: a cell's events count for few, and each for the less, the
// farther it is from lying on the map.
void Background::align() {
  turn_.turn(speed_);
  place_events();
  for (const Pixel& then : then_) map_.fetch(then);
  Cells events{};
  for (const Pixel& event : last_.events) events[cell_of(event)] += 1;
  std::array<Steps, 3> squares{{{kStiffness, 0, 0}, {0, kStiffness, 0}, {0, 0, kStiffness}}};
  Steps towards{};
  double support = 0;
  for (std::size_t i = 0; i < last_.events.size(); ++i) {
    const Pixel then = then_[i];
    const FadingMap::Sample sample = map_.sample(then);
    if (!(sample.level > 0)) continue;
    const double residual = kHalf / (sample.level + kHalf);
    const double slope = -residual / (sample.level + kHalf);
    const CameraTurn::Slopes slopes = turn_.slopes_at(then);
    Steps steps;
    for (std::size_t k = 0; k < 3; ++k) {
      steps[k] = slope * (sample.slope_x * slopes.x[k] + sample.slope_y * slopes.y[k]);
    }
    const double weight = (1 - residual) * kFew / (kFew + events[cell_of(last_.events[i])]);
    support += weight;
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) squares[row][k] += weight * steps[row] * steps[k];
      towards[row] -= weight * steps[row] * residual;
    }
  }
  const Steps found = solved(squares, towards);
  turn_.turn(found);
  for (std::size_t k = 0; k < 3; ++k) {
    speed_[k] += kSpeedGain * found[k];
    if (support < kLeastSupport) speed_[k] *= kSpeedKept;
  }
}

void Background::note_activity() {
  const std::int64_t passed_us = last_.passed_us;
  const double keep = std::exp(-static_cast<double>(passed_us) / kActivityMemory_us);
  for (double& cell : activity_) cell *= keep;
  for (double& cell : events_) cell *= keep;
  noise_ = keep * noise_ + last_.noise;
  for (std::size_t i = 0; i < last_.events.size(); ++i) {
    const std::size_t cell = cell_of(last_.events[i]);
    events_[cell] += 1;
    if (map_.level(then_[i]) > still_level_) activity_[cell] += 1;
  }
  const auto count_above = [](const Cells& cells, double least) {
    return std::count_if(cells.begin(), cells.end(), [&](double cell) { return cell > least; });
  };
  const auto sum_of = [](const Cells& cells) {
    return std::accumulate(cells.begin(), cells.end(), 0.0);
  };
  is_known_ = count_above(activity_, kActive) >= least_cells_;
  const double all_noise = noise_ * sensor_.width * sensor_.height;
  const double cell_noise = all_noise / static_cast<double>(events_.size());
  head_turns_ = is_known_ && sum_of(activity_) > kTurningShare * (sum_of(events_) - all_noise);
  const bool is_calm = !is_known_ && count_above(events_, kBusy + cell_noise) < kLeastBusyCells;
  // Of the first period it is not known when it began.
  calm_us_ = is_calm ? calm_us_ + std::min(passed_us, kPeriod_us) : 0;
  unknown_us_ = is_known_ ? 0 : unknown_us_ + std::min(passed_us, kPeriod_us);
}

std::optional<PixelVelocity> Background::still_velocity_at(Pixel place) const {
  return head_turns_ ? trail_.still_velocity_at(place) : std::nullopt;
}

}  // namespace puck
