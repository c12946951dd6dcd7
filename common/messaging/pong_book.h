#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/messaging/receipt.h"
#include "puck/service_status_t.hpp"

namespace puck {

/// Runs whose STATUS was heard and must be answered, eight in each STATUS of ours: those that have
/// waited longest, with at least two places for new runs and the others for runs heard often, so
/// that neither group blocks the other. Holds 64 runs; when full, those heard often. One thread.
class PongBook {
 public:
  /// Returns whether this run was heard for the first time.
  bool hear(const service_status_t& status, const Receipt& receipt);

  /// Adds pongs to a STATUS before publication. Returns whether a new run still waits for a pong.
  bool answer(service_status_t& message);

 private:
  struct Pong {
    std::int64_t session = 0;
    std::int64_t utime = 0;
    std::int64_t received_utime = 0;
    std::int64_t received_monotonic_us = 0;
    int times_heard = 0;
    // CLOCK_MONOTONIC, when it was last answered, or first heard.
    std::int64_t waits_since_us = 0;
    bool is_answered = false;
  };
  using Place = std::vector<Pong>::iterator;

  void keep(const Pong& pong);
  static void add(Place first, std::ptrdiff_t count, std::int64_t now_us,
                  service_status_t& message);

  std::vector<Pong> pongs_;
};

}  // namespace puck
