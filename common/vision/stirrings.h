#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/events/sensor_size.h"

namespace puck {

/// Tells whether anything moves in the image: somewhere there are more events than uniform noise
/// would put there by chance, however much of it there is.
class Stirrings {
 public:
  explicit Stirrings(SensorSize sensor)
      : columns_((sensor.width + kCell_px - 1) / kCell_px),
        cells_(static_cast<std::size_t>(columns_) *
               static_cast<std::size_t>((sensor.height + kCell_px - 1) / kCell_px)) {}

  /// Takes an event. Those that a pixel repeats at once should be left out: it may be a hot one.
  void take(int x, int y) {
    std::uint32_t& cell = cells_[static_cast<std::size_t>(y / kCell_px * columns_ + x / kCell_px)];
    ++cell;
    ++total_;
    if (cell > most_) most_ = cell;
  }

  /// To be called at each decision.
  void judge(std::int64_t time_us) {
    const double chance = static_cast<double>(total_) / static_cast<double>(cells_.size());
    const bool stirs = most_ > chance + kSigmas * std::sqrt(chance) + kLeast;
    if (stirs) stirred_us_ = time_us;
    if (stirs || time_us - counted_from_us_ >= kMemory_us) {
      cells_.assign(cells_.size(), 0);
      total_ = 0;
      most_ = 0;
      counted_from_us_ = time_us;
    }
  }

  /// Nothing has stirred for a while, or ever.
  bool is_still(std::int64_t time_us) const { return time_us - stirred_us_ > kMemory_us; }

 private:
  static constexpr int kCell_px = 32;  // about a puck
  static constexpr double kSigmas = 5;
  static constexpr double kLeast = 8;
  static constexpr std::int64_t kMemory_us = 100'000;

  int columns_;
  std::vector<std::uint32_t> cells_;
  std::uint64_t total_ = 0;
  std::uint32_t most_ = 0;
  std::int64_t counted_from_us_ = 0;
  std::int64_t stirred_us_ = std::numeric_limits<std::int64_t>::min() / 2;
};

}  // namespace puck
