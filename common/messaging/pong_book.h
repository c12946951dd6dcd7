#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/messaging/receipt.h"
#include "puck/service_status_t.hpp"

namespace puck {

/// Whose STATUS has been heard and is to be answered, eight in each of ours: those who have waited
/// longest, but of those that are new at least two, and of those that are heard often all but two,
/// so that neither keep out the others. 64 runs are known, and of more those that are heard often.
/// One thread.
class PongBook {
 public:
  /// Whether it is the first that is heard of this run.
  bool hear(const service_status_t& status, const Receipt& receipt);

  /// Adds pongs to a STATUS that is published now. Whether a run still waits for its first.
  bool answer(service_status_t& message);

 private:
  struct Pong {
    std::int64_t session = 0;
    std::int64_t utime = 0;
    std::int64_t received_utime = 0;
    std::int64_t received_monotonic_us = 0;
    int times_heard = 0;
    // CLOCK_MONOTONIC: since it was answered, or first heard.
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
