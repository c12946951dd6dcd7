#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace puck {

/// Random choices and extreme values, from a seed. One thread.
class WildValues {
 public:
  explicit WildValues(unsigned seed) : random_(seed) {}

  bool chance(double probability) { return std::bernoulli_distribution(probability)(random_); }
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::uint64_t bits() { return random_(); }

  /// Mostly an impossible value; else within +-`usual`.
  double wild_number(double usual) {
    constexpr double kWild[] = {std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity(),
                                1e308,
                                -1e18,
                                std::numeric_limits<double>::denorm_min(),
                                0};
    const int which = below(9);
    return which < 7 ? kWild[which] : between(-usual, usual);
  }
  std::int64_t wild_integer() {
    switch (below(4)) {
      case 0:
        return std::numeric_limits<std::int64_t>::max();
      case 1:
        return std::numeric_limits<std::int64_t>::min();
      case 2:
        return 0;
      default:
        return static_cast<std::int64_t>(bits());
    }
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace puck
