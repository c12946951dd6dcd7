#include "tools/play/error_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puck {
namespace {

// Within this distance the tracker has noticed a turn; a later larger error has another cause.
constexpr double kNearPx = 3;
// Time after a turn whose errors differ from those in free flight.
constexpr std::int64_t kSettledUs = 20'000;
// A hit takes a few ms.
constexpr std::int64_t kOneTurnUs = 10'000;
// Lag at which the errors' autocorrelation is measured.
constexpr std::int64_t kMemoryUs = 5'000;
constexpr std::size_t kFewestTicks = 100;

struct MeanOf {
  double count = 0;
  double sum = 0;

  void add(std::int64_t value) {
    ++count;
    sum += static_cast<double>(value);
  }
  double mean() const { return count > 0 ? sum / count : 0; }
};

// Means of the errors and the velocities.
struct Moments {
  double count = 0;
  Pixel error;
  Pixel velocity;

  explicit Moments(const std::vector<FlightErrors>& flights) {
    for (const FlightErrors& flight : flights) {
      for (const auto& run : flight.runs) {
        for (const FlightErrors::Tick& tick : run) {
          ++count;
          error.x += tick.error.x;
          error.y += tick.error.y;
          velocity.x += tick.velocity.x;
          velocity.y += tick.velocity.y;
        }
      }
    }
    if (count == 0) return;
    error = {error.x / count, error.y / count};
    velocity = {velocity.x / count, velocity.y / count};
  }
};

// Least squares of error = bias - lag · velocity, with one lag for both axes.
void fit_lag(const std::vector<FlightErrors>& flights, EstimateErrorParams& fit) {
  const Moments mean(flights);
  double covariance = 0;
  double variance = 0;
  for (const FlightErrors& flight : flights) {
    for (const auto& run : flight.runs) {
      for (const FlightErrors::Tick& tick : run) {
        const double vx = tick.velocity.x - mean.velocity.x;
        const double vy = tick.velocity.y - mean.velocity.y;
        covariance += vx * (tick.error.x - mean.error.x) + vy * (tick.error.y - mean.error.y);
        variance += vx * vx + vy * vy;
      }
    }
  }
  const double lag_s = variance > 0 ? -covariance / variance : 0;
  fit.lag_us = 1e6 * lag_s;
  fit.bias_x_px = mean.error.x + lag_s * mean.velocity.x;
  fit.bias_y_px = mean.error.y + lag_s * mean.velocity.y;
}

Pixel rest_of(const FlightErrors::Tick& tick, const EstimateErrorParams& fit) {
  const double lag_s = 1e-6 * fit.lag_us;
  return {tick.error.x - fit.bias_x_px + lag_s * tick.velocity.x,
          tick.error.y - fit.bias_y_px + lag_s * tick.velocity.y};
}

void fit_drift(const std::vector<FlightErrors>& flights, std::int64_t period_us,
               EstimateErrorParams& fit) {
  const auto apart = static_cast<std::size_t>(kMemoryUs / period_us);
  Pixel square;
  double count = 0;
  double reported = 0;
  double together = 0;
  double alone = 0;
  for (const FlightErrors& flight : flights) {
    for (const auto& run : flight.runs) {
      for (std::size_t i = 0; i < run.size(); ++i) {
        const Pixel now = rest_of(run[i], fit);
        square = {square.x + now.x * now.x, square.y + now.y * now.y};
        reported += run[i].reported_sigma_px * run[i].reported_sigma_px;
        ++count;
        if (i + apart >= run.size()) continue;
        const Pixel later = rest_of(run[i + apart], fit);
        together += now.x * later.x + now.y * later.y;
        alone += (now.x * now.x + now.y * now.y + later.x * later.x + later.y * later.y) / 2;
      }
    }
  }
  fit.sigma_x_px = std::sqrt(square.x / count);
  fit.sigma_y_px = std::sqrt(square.y / count);
  fit.reported_sigma_px = std::sqrt(reported / count);
  const double memory = alone > 0 ? together / alone : 0;
  constexpr double kLeastMemory = 1e-3;
  fit.correlation_us =
      -static_cast<double>(kMemoryUs) / std::log(std::min(0.999, std::max(kLeastMemory, memory)));
}

void fit_turns(const std::vector<FlightErrors>& flights, EstimateErrorParams& fit) {
  MeanOf detection;
  MeanOf notice;
  MeanOf loss;
  double turns = 0;
  for (const FlightErrors& flight : flights) {
    if (flight.detected_us) detection.add(*flight.detected_us);
    for (const FlightErrors::Turn& turn : flight.turns) {
      ++turns;
      if (turn.lost_us > 0) {
        loss.add(turn.lost_us);
      } else {
        notice.add(turn.noticed_us);
      }
    }
  }
  fit.detection_us = detection.mean();
  fit.notice_us = notice.mean();
  fit.loss_share = turns > 0 ? loss.count / turns : 0;
  fit.loss_us = loss.mean();
}

}  // namespace

void FlightErrorWatch::see(const SimulatedTruth& truth) {
  before_ = now_;
  now_ = truth;
  if (!is_turn(before_, now_) || !is_in_flight()) return;
  if (!turned_ || now_.time - *turned_ > kOneTurnUs) errors_.turns.emplace_back();
  turned_ = now_.time;
}

std::optional<FlightErrors::Tick> FlightErrorWatch::tick_of(const PuckEstimate& estimate) const {
  const auto from = table_from_image_.to_image(before_.position);
  const auto to = table_from_image_.to_image(now_.position);
  const auto slice_us = static_cast<double>(now_.time - before_.time);
  if (!from || !to || !(slice_us > 0) || !before_.in_play || !now_.in_play) return std::nullopt;
  FlightErrors::Tick tick;
  tick.velocity = {(to->x - from->x) / slice_us * 1e6, (to->y - from->y) / slice_us * 1e6};
  const double ago_s = 1e-6 * static_cast<double>(now_.time - estimate.newest_event);
  tick.error = {estimate.position->x - (to->x - ago_s * tick.velocity.x),
                estimate.position->y - (to->y - ago_s * tick.velocity.y)};
  tick.reported_sigma_px = std::sqrt((estimate.covariance[0] + estimate.covariance[5]) / 2);
  return tick;
}

void FlightErrorWatch::see(const PuckEstimate& estimate, std::int64_t period_us) {
  const bool is_tracked = estimate.state == TrackState::kTracking && estimate.position;
  if (is_tracked && !errors_.detected_us) errors_.detected_us = now_.time.us;
  if (!is_in_flight() || errors_.turns.empty()) return;
  FlightErrors::Turn& turn = errors_.turns.back();
  const std::int64_t since_us = now_.time - *turned_;
  const auto tick = is_tracked ? tick_of(estimate) : std::nullopt;
  if (!is_tracked) turn.lost_us += period_us;
  const bool is_near = tick && std::hypot(tick->error.x, tick->error.y) < kNearPx;
  if (is_tracked && !is_near && since_us < kSettledUs) turn.noticed_us = since_us + period_us;
  if (!is_near || since_us < kSettledUs) {
    in_run_ = false;
    return;
  }
  if (!in_run_) errors_.runs.emplace_back();
  in_run_ = true;
  errors_.runs.back().push_back(*tick);
}

EstimateErrorParams fit_estimate_errors(const std::vector<FlightErrors>& flights,
                                        std::int64_t period_us) {
  if (Moments(flights).count < kFewestTicks) {
    throw std::runtime_error(
        "too few estimates with a track to fit the errors; use more "
        "--shots");
  }
  EstimateErrorParams fit;
  fit_lag(flights, fit);
  fit_drift(flights, period_us, fit);
  fit_turns(flights, fit);
  return fit;
}

}  // namespace puck
