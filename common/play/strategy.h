#pragma once

#include <optional>

#include "common/table/intercept_predictor.h"
#include "common/table/puck_track.h"

namespace puck {

struct StrategyParams {
  /// A crossing less sure than this is not gone for, m.
  double max_crossing_sigma_m = 0.3;
  /// Where the mallet waits for a puck in the robot's half that nobody shot: this part of the
  /// puck's y.
  double shadow_gain = 0.5;
};

/// Where the mallet should be and when.
struct Wish {
  double y_m = 0;          ///< On the robot's line; may lie beyond its ends.
  double arrive_in_s = 0;  ///< 0: as soon as possible.
};

/// Blocks at the predicted crossing; shadows a puck that lies or dawdles in the robot's half;
/// otherwise waits in the middle.
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
