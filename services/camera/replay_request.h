#pragma once

#include <cstdint>

namespace puck {

/// What a person asks of a recording that is played.
struct ReplayRequest {
  enum class Kind : std::uint8_t {
    kPause,
    kResume,
    kPauseOrResume,
    kStep,    ///< Plays `us` on, then pauses.
    kSeek,    ///< Goes to the position `us`.
    kSeekBy,  ///< Goes `us` on, or back.
    kSpeed,   ///< Plays at `speed`.
    kFaster,  ///< Multiplies the speed by `speed`.
  };

  /// Range of the speed, sensor time per host time.
  static constexpr double kSlowest = 0.001;
  static constexpr double kFastest = 1000;
  static constexpr std::int64_t kLongestStepUs = 10'000'000;

  Kind kind = Kind::kPause;
  std::int64_t us = 0;  ///< Sensor time; of a step, 0: as the camera's settings say.
  double speed = 1;
};

}  // namespace puck
