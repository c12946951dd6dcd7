#pragma once

#include <optional>

#include "common/table/intercept_predictor.h"
#include "common/table/puck_track.h"

namespace puck {

struct StrategyParams {
  /// Standard deviation of the shots' crossings around the middle of the line, m. The more
  /// uncertain a crossing is in comparison, the nearer to the middle the mallet waits.
  double crossing_prior_m = 0.15;
  /// Waiting position for a puck in the robot's half that is no shot: this factor times the puck's
  /// y.
  double shadow_gain = 0.5;
};

/// Target of the mallet: place and time.
struct Wish {
  double y_m = 0;          ///< On the robot's line; may lie beyond its ends.
  double arrive_in_s = 0;  ///< 0: as soon as possible.
};

/// Blocks at the predicted crossing, weighted by its certainty and clamped to the goal; follows the
/// y of a slow puck in the robot's half; otherwise waits in the middle, and returns there when the
/// puck moves away.
class Strategy {
 public:
  /// Throws std::invalid_argument that names the key when a value is out of its range.
  Strategy(const StrategyParams& params, const TableGeometry& table);

  Wish decide(const PuckTrack& track, const std::optional<Intercept>& crossing) const;

 private:
  StrategyParams params_;
  TableGeometry table_;
};

}  // namespace puck
