#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace puck {

/// Whether the score tells a right position from a wrong one. Every tick that counts has a score
/// and is right (within 4 px) or wrong. To believe only scores of at least a threshold gives
/// precision: the share of the believed that is right, and recall: the share of the right that is
/// believed.
class ScoreCurve {
 public:
  /// Thresholds 0, 1/kSteps … 1.
  static constexpr int kSteps = 200;
  static constexpr double kRightPx = 4;

  /// Scores below 0 count as 0, above 1 as 1.
  void add(double score, double error_px);
  /// The ticks of another recording.
  void add(const ScoreCurve& other);
  /// Ticks of which the scores lie from this step's threshold up to the next one's.
  void add_counts(int step, std::int64_t ticks, std::int64_t right);

  struct Point {
    double threshold = 0;
    std::int64_t believed = 0;  ///< Ticks with at least that score.
    std::int64_t right = 0;     ///< The right ones among them.
    double precision = 1;       ///< 1 where nothing is believed.
    double recall = 0;
    double f1() const;
  };
  /// `step` from 0 to kSteps. With no right tick at all, recall is 0.
  Point at(int step) const;

  /// The threshold with the best F1; of equals the highest, which lets the least through.
  Point best() const;
  /// Area under precision over recall: each gain in recall times the precision that it costs.
  double average_precision() const;

  std::int64_t ticks() const { return at(0).believed; }

 private:
  std::array<std::int64_t, kSteps + 1> ticks_{};
  std::array<std::int64_t, kSteps + 1> right_{};
};

}  // namespace puck
