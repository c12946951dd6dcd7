#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/simulation/simulated_truth.h"
#include "common/table/homography.h"
#include "common/vision/puck_estimate.h"
#include "tools/play/estimate_errors.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// A tracker's errors in the flight of one shot.
struct FlightErrors {
  struct Tick {
    Pixel error;             ///< Estimate minus truth, at the time that the estimate is for, px.
    PixelVelocity velocity;  ///< Of the true puck.
    double reported_sigma_px = 0;
  };
  /// Well after any turn. One tick after the other; where one is missing, a new run begins.
  std::vector<std::vector<Tick>> runs;
  /// A hit or a bounce, and the time up to the next.
  struct Turn {
    std::int64_t lost_us = 0;     ///< Without a track.
    std::int64_t noticed_us = 0;  ///< The last that the estimate was far from the puck, since then.
  };
  std::vector<Turn> turns;
  std::optional<std::int64_t> detected_us;  ///< Since the puck came into the game.
};

/// Gathers them. One thread.
class FlightErrorWatch {
 public:
  FlightErrorWatch(const ShotFacts& facts, const Homography& table_from_image)
      : facts_(facts), table_from_image_(table_from_image) {}

  /// At every step of the world.
  void see(const SimulatedTruth& truth);
  /// At every tick, all of them `period_us` apart.
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

/// The model's numbers for many flights, with ticks `period_us` apart. Throws std::runtime_error
/// when there are too few ticks.
EstimateErrorParams fit_estimate_errors(const std::vector<FlightErrors>& flights,
                                        std::int64_t period_us);

}  // namespace puck
