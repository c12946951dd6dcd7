#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tools/play/shot.h"

namespace puck {

/// The 95 % confidence interval of a share.
struct Interval {
  double low = 0;
  double high = 1;
};
/// Wilson's score interval, valid for few shots and near 0 and 1, too. [0, 1] if `of` is 0.
Interval wilson_interval(std::int64_t successes, std::int64_t of);

/// Results of a game or of many shots.
struct SaveFigures {
  std::int64_t shots = 0;
  std::int64_t saves = 0;
  std::int64_t goals = 0;
  std::optional<std::int64_t> reachable;  ///< Shots saved by the best arm.
  std::optional<std::int64_t> waiting;    ///< Shots saved by a mallet at rest in the middle.
  /// Causes of the goals. Like every empty value, known for single shots only.
  std::optional<std::array<std::int64_t, kGoalCauses>> causes;
  std::optional<double> sum_speed_m_s;  ///< Of the shots.
  /// Counted by the bridge.
  std::int64_t believed_shots = 0;
  std::int64_t believed_saves = 0;
  std::int64_t believed_goals = 0;
  double played_s = 0;  ///< Sensor time.
  double took_s = 0;    ///< Wall time.

  void add(const ShotFacts& facts, const ShotOutcome& outcome);

  double save_percent() const { return percent(saves); }
  std::optional<double> bound_percent() const {
    return reachable ? std::optional(percent(*reachable)) : std::nullopt;
  }
  std::optional<double> waiting_percent() const {
    return waiting ? std::optional(percent(*waiting)) : std::nullopt;
  }
  std::optional<double> mean_speed_m_s() const {
    return sum_speed_m_s && shots > 0 ? std::optional(*sum_speed_m_s / static_cast<double>(shots))
                                      : std::nullopt;
  }
  double speed_x() const { return took_s > 0 ? played_s / took_s : 0; }

 private:
  double percent(std::int64_t of_shots) const {
    return shots > 0 ? 100 * static_cast<double>(of_shots) / static_cast<double>(shots) : 0;
  }
};

}  // namespace puck
