#pragma once

#include <cstdint>
#include <limits>

namespace puck {

/// Time windows. The defaults are those of a live view.
struct MonitorParams {
  std::int64_t rate_window_us = 1'000'000;
  std::int64_t publisher_life_us = 2'000'000;  ///< Shown this long after its newest message.
  std::int64_t service_life_us = 60'000'000;   ///< Shown this long after its last STATUS.
  std::int64_t silent_after_us = 500'000;      ///< STATUS comes every 100 ms.

  /// For a report on the whole time of listening.
  static MonitorParams whole_time() {
    constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();
    return {.rate_window_us = kForever, .publisher_life_us = kForever, .service_life_us = kForever};
  }
};

}  // namespace puck
