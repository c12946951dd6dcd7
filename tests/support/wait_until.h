#pragma once

#include <chrono>
#include <thread>

namespace puck {

/// Checks `condition` once a millisecond; false if it does not hold within `limit`.
template <typename Condition>
bool wait_until(const Condition& condition,
                std::chrono::milliseconds limit = std::chrono::seconds(20)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace puck
