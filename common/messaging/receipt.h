#pragma once

#include <cstddef>
#include <cstdint>

#include "common/messaging/loss_accounting.h"
#include "common/messaging/transport.h"

namespace puck {

/// Time and circumstances of a message's receipt.
struct Receipt {
  std::int64_t utime = 0;         ///< When it was received, CLOCK_REALTIME, µs.
  std::int64_t monotonic_us = 0;  ///< The same by CLOCK_MONOTONIC, for ages.
  std::size_t bytes = 0;          ///< Encoded size.
  Sender sender{};                ///< From the network; not authenticated.
  /// Late and duplicate messages are delivered too; check it to drop them.
  Arrival arrival = Arrival::kNewest;
  /// Whether other messages, on any channel, wait behind it.
  bool more_waiting = false;

  bool in_order() const { return arrival == Arrival::kNewSession || arrival == Arrival::kNewest; }
};

}  // namespace puck
