#pragma once

#include <stdexcept>
#include <string>

namespace puck {

/// The valid values of a numeric option, both ends included.
struct OptionRange {
  const char* option = "";
  double lowest = 0;
  double highest = 0;

  /// Throws std::invalid_argument that names the option of a value out of range.
  void require(double value) const {
    if (value >= lowest && value <= highest) return;
    throw std::invalid_argument(std::string(option) + " must be between " + words(lowest) +
                                " and " + words(highest) + ", got " + std::to_string(value));
  }

 private:
  // Formatted as for the command line: 0.6, 10000.
  static std::string words(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  }
};

inline constexpr OptionRange kMaxSpeedRange{"--max-speed", 0.6, 15};  // m/s
inline constexpr OptionRange kRateRange{"--rate-hz", 1, 5000};
inline constexpr OptionRange kLatencyRange{"--latency-ms", 0, 1000};
inline constexpr OptionRange kLossRange{"--loss-percent", 0, 100};
inline constexpr OptionRange kBurstRange{"--burst-ms", 0, 10'000};
inline constexpr OptionRange kFramesRange{"--frames-hz", 1, 2000};

}  // namespace puck
