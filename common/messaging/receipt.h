#pragma once

#include <cstddef>
#include <cstdint>

#include "common/messaging/loss_accounting.h"
#include "common/messaging/transport.h"

namespace puck {

/// When and how a message came.
struct Receipt {
  std::int64_t utime = 0;         ///< When it was received, CLOCK_REALTIME, µs.
  std::int64_t monotonic_us = 0;  ///< The same by CLOCK_MONOTONIC: ages are judged by this one.
  std::size_t bytes = 0;          ///< Encoded size.
  Sender sender{};                ///< As the network says.
  /// Late and duplicate messages are delivered too; whoever minds drops them.
  Arrival arrival = Arrival::kNewest;
  /// Other messages, on whatever channel, have come and wait behind it.
  bool more_waiting = false;

  bool in_order() const { return arrival == Arrival::kNewSession || arrival == Arrival::kNewest; }
};

}  // namespace puck
