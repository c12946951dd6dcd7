#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/simulation/simulated_truth.h"
#include "common/table/homography.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/play/estimate_errors.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// A tracker's errors in the flight of one shot.
struct FlightErrors {
  struct Tick {
    Pixel error;             ///< Estimate minus truth, at the estimate's time, px.
    PixelVelocity velocity;  ///< Of the true puck.
    double reported_sigma_px = 0;
  };
  /// Consecutive ticks well after any turn; a missing tick begins a new run.
  std::vector<std::vector<Tick>> runs;
  /// A hit or a bounce, until the next one.
  struct Turn {
    std::int64_t lost_us = 0;     ///< Without a track.
    std::int64_t noticed_us = 0;  ///< Last time with a large error, since the turn.
  };
  std::vector<Turn> turns;
  std::optional<std::int64_t> detected_us;  ///< Since the puck came into play.
};

/// Collects FlightErrors. One thread.
class FlightErrorWatch {
 public:
  FlightErrorWatch(const ShotFacts& facts, const Homography& table_from_image)
      : facts_(facts), table_from_image_(table_from_image) {}

  /// At every step of the world.
  void see(const SimulatedTruth& truth);
  /// At every tick, each `period_us` after the last.
  void see(const PuckEstimate& estimate, std::int64_t period_us);

  const FlightErrors& errors() const { return errors_; }

 private:
  bool is_in_flight() const { return now_.time >= facts_.hit && now_.time < facts_.crossing; }
  std::optional<FlightErrors::Tick> tick_of(const PuckEstimate& estimate) const;

  ShotFacts facts_;
  Homography table_from_image_;
  SimulatedTruth before_;
  SimulatedTruth now_;
  FlightErrors errors_;
  std::optional<Timestamp> turned_;
  bool in_run_ = false;
};

/// Parameters of the error model from many flights, with ticks `period_us` apart. Throws
/// std::runtime_error for too few ticks.
EstimateErrorParams fit_estimate_errors(const std::vector<FlightErrors>& flights,
                                        std::int64_t period_us);

}  // namespace puck
