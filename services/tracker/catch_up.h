#pragma once

#include <cstdint>
#include <optional>

namespace puck {

/// Keeps an overloaded receiver at the newest data. Late packets are still taken while the delay
/// may be a short hiccup; if it does not shrink, all packets are skipped until one has hardly
/// waited. A queue therefore holds at most about kPatienceUs of packets, and is empty as soon after
/// a flood. One thread.
class CatchUp {
 public:
  /// A packet that has waited longer is late.
  static constexpr std::int64_t kBehindUs = 5'000;
  /// Longest run of late packets. Larger survives longer hiccups of a busy machine without a gap in
  /// the events; smaller returns to the newest data sooner after a flood.
  static constexpr std::int64_t kPatienceUs = 50'000;

  /// Call it for every packet in order: whether to skip it. Both times CLOCK_MONOTONIC.
  bool leaves_out(std::int64_t received_us, std::int64_t now_us);

 private:
  std::optional<std::int64_t> behind_since_us_;
};

}  // namespace puck
