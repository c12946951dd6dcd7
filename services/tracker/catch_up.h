#pragma once

#include <cstdint>
#include <optional>

namespace puck {

/// Keeps a receiver that gets more than it can take at the newest. Packets that have waited are
/// taken all the same as long as the wait may be a hiccup that is soon made up for; when it does
/// not get shorter, all packets are left out until one comes that has hardly waited. So a queue
/// never holds more than about kPatienceUs of packets, and is empty as soon after a flood. One
/// thread.
class CatchUp {
 public:
  /// A packet that has waited for longer is behind.
  static constexpr std::int64_t kBehindUs = 5'000;
  /// How long in a row packets may be behind. Longer survives longer hiccups of a busy machine
  /// without a gap in the events; shorter is at the newest sooner after a flood.
  static constexpr std::int64_t kPatienceUs = 50'000;

  /// For every packet, in order: whether it is to be left out. Both times CLOCK_MONOTONIC.
  bool leaves_out(std::int64_t received_us, std::int64_t now_us);

 private:
  std::optional<std::int64_t> behind_since_us_;
};

}  // namespace puck
