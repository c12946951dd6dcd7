#pragma once

#include <cstdint>
#include <random>

namespace puck {

/// Uniformly distributed numbers that are the same on every machine: the standard fixes the
/// generator, but not its distributions.
class UniformRandom {
 public:
  explicit UniformRandom(std::uint64_t seed) : generator_(seed) {}

  /// In [0, 1).
  double next() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  /// In [−reach, reach).
  double next_within(double reach) { return reach * (2 * next() - 1); }

 private:
  std::mt19937_64 generator_;
};

}  // namespace puck
