#pragma once

#include <stdexcept>
#include <string>

namespace puck {

/// Checks of the baselines' parameters: each throws std::invalid_argument that names the key when
/// the value is out of range or not a number.
inline void require_at_least(const std::string& key, double value, double lowest) {
  if (value >= lowest) return;
  throw std::invalid_argument(key + " must be at least " + std::to_string(lowest) + ", got " +
                              std::to_string(value));
}

inline void require_at_least(const std::string& key, int value, int lowest) {
  if (value >= lowest) return;
  throw std::invalid_argument(key + " must be at least " + std::to_string(lowest) + ", got " +
                              std::to_string(value));
}

inline void require_above_zero(const std::string& key, double value) {
  if (value > 0) return;
  throw std::invalid_argument(key + " must be above 0, got " + std::to_string(value));
}

/// 0 < value ≤ 1.
inline void require_share(const std::string& key, double value) {
  if (value > 0 && value <= 1) return;
  throw std::invalid_argument(key + " must be above 0 and at most 1, got " + std::to_string(value));
}

}  // namespace puck
