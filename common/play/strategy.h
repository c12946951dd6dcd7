#pragma once

#include <optional>

#include "common/table/intercept_predictor.h"
#include "common/table/puck_track.h"

namespace puck {

struct StrategyParams {
  /// How far from the middle shots cross the line, as a standard deviation, m. An unsure crossing
  /// is weighed against it: the less sure, the nearer to the middle the mallet waits.
  double crossing_prior_m = 0.15;
  /// Where the mallet waits for a puck in the robot's half that nobody shot: this part of the
  /// puck's y.
  double shadow_gain = 0.5;
};

/// Where the mallet should be and when.
struct Wish {
  double y_m = 0;          ///< On the robot's line; may lie beyond its ends.
  double arrive_in_s = 0;  ///< 0: as soon as possible.
};

/// Blocks at the predicted crossing, as far as that is sure and before the goal; shadows a puck
/// that lies or dawdles in the robot's half; otherwise waits in the middle, and goes back there as
/// soon as the puck goes away.
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
