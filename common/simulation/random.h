#pragma once

#include <array>
#include <cstdint>

namespace puck {

/// Random numbers that are the same on every machine and with every standard library (whose
/// distributions are not): xoshiro256++, seeded by splitmix64.
class Random {
 public:
  /// Different streams of one seed are independent, so that one part of the world may draw more
  /// numbers without a change for the others.
  Random(std::int64_t seed, std::uint64_t stream);

  std::uint64_t bits() {
    const std::uint64_t result = rotated(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = rotated(state_[3], 45);
    return result;
  }

  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double from, double to) { return from + (to - from) * uniform(); }
  /// From 0 to `count` − 1.
  int index(int count) { return static_cast<int>(uniform() * count); }
  /// Normally distributed with mean 0 and standard deviation 1.
  double normal();
  /// Poisson-distributed number of events with the given mean.
  int poisson(double mean);

 private:
  static std::uint64_t rotated(std::uint64_t value, int by) {
    return (value << by) | (value >> (64 - by));
  }

  std::array<std::uint64_t, 4> state_{};
};

}  // namespace puck
