#pragma once

#include <cstdint>

namespace puck::test {

/// The same numbers on every machine.
class RandomNumbers {
 public:
  /// A number from 0 to `bound` − 1.
  std::uint32_t below(std::uint32_t bound) {
    state_ = state_ * 1664525u + 1013904223u;
    return (state_ >> 8) % bound;
  }

 private:
  std::uint32_t state_ = 1;
};

}  // namespace puck::test
