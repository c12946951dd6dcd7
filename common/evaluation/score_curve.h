#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace puck {

/// How well the score separates right positions from wrong ones. Every tick that counts has a score
/// and is right (within 4 px) or wrong. Accepting only scores of at least a threshold gives
/// precision, the share of the accepted ticks that is right, and recall, the share of the right
/// ticks that is accepted.
class ScoreCurve {
 public:
  /// Thresholds 0, 1/kSteps … 1.
  static constexpr int kSteps = 200;
  static constexpr double kRightPx = 4;

  /// Scores below 0 count as 0, above 1 as 1.
  void add(double score, double error_px);

  struct Point {
    double threshold = 0;
    std::int64_t believed = 0;  ///< Ticks with at least the threshold's score.
    std::int64_t right = 0;     ///< Right ones among them.
    double precision = 1;       ///< 1 where no tick is accepted.
    double recall = 0;
    double f1() const;
  };
  /// `step` from 0 to kSteps. Without a right tick, recall is 0.
  Point at(int step) const;

  /// The threshold with the best F1; among equals, the highest.
  Point best() const;
  /// Area under precision over recall: the sum of recall gains times their precision.
  double average_precision() const;

  std::int64_t ticks() const { return at(0).believed; }

 private:
  std::array<std::int64_t, kSteps + 1> ticks_{};
  std::array<std::int64_t, kSteps + 1> right_{};
};

}  // namespace puck
