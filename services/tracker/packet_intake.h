#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/messages/single_publisher.h"
#include "common/messaging/event_packet_view.h"
#include "common/messaging/loss_accounting.h"
#include "common/messaging/receipt.h"

namespace puck {

/// Decides which of the received event packets are tracked, and counts the others.
///
/// Follows one publisher of events: the first one heard, until it has been silent for 500 ms. A run
/// begins with another publisher, another run of the same one, a log that is replayed, or a
/// restarted sensor clock. Within a run, packets come in order and from one sensor.
///
/// Keeps an overloaded tracker at the newest events: late packets are still taken while the delay
/// may be a short hiccup; if it does not shrink, all packets are skipped until one has hardly
/// waited. A queue therefore holds at most about kPatienceUs of packets, and is empty as soon after
/// a flood.
///
/// Has no clock: all times but `newest` are CLOCK_MONOTONIC, µs. One thread.
class PacketIntake {
 public:
  /// A packet that has waited longer is late.
  static constexpr std::int64_t kBehindUs = 5'000;
  /// Longest run of late packets. Larger survives longer hiccups of a busy machine without a gap in
  /// the events; smaller returns to the newest data sooner after a flood.
  static constexpr std::int64_t kPatienceUs = 50'000;
  /// Packets overlap by less; a larger step back is a restarted clock. Accepted at most once in
  /// this time, so that jumping clocks do not keep the tracker busy.
  static constexpr std::int64_t kClockRestartedUs = 1'000'000;

  enum class Verdict {
    kBegin,           ///< Take it as the first packet of a run; the counters begin anew.
    kTake,            ///< Take it.
    kHeld,            ///< Skipped when the next packet comes; until then release() returns it.
    kLate,            ///< Dropped: not newer than the previous packet.
    kUnfit,           ///< Dropped: of another sensor size, or older than the newest event.
    kOtherPublisher,  ///< Dropped: another publisher is followed.
  };

  struct Counters {
    std::int64_t events_received = 0;    ///< Skipped ones included.
    std::int64_t events_skipped = 0;     ///< To keep to the newest.
    std::int64_t packets_skipped = 0;    ///< To keep to the newest.
    std::int64_t packets_dropped = 0;    ///< kLate and kUnfit.
    std::int64_t packets_of_others = 0;  ///< Of publishers that are not followed, in all runs.
  };

  struct HeldPacket {
    EventPacketView packet;
    Receipt receipt;
  };

  /// With `skips_late` false, no packet is skipped.
  explicit PacketIntake(bool skips_late) : skips_late_(skips_late) {}

  /// Judges every received packet, in order.
  Verdict admit(const EventPacketView& packet, const Receipt& receipt, std::int64_t now_us);

  /// The packet held since the last admit(), to be taken now; valid until the next admit().
  /// nullptr: none, or already released.
  const HeldPacket* release();

  /// Notes that the events up to `newest` of a taken packet are tracked from now on. Returns the
  /// sensor time, µs, that waits behind them: the wait since `received_us` in whole packets.
  std::int64_t note_taken(Timestamp newest, std::int64_t received_us, std::int64_t now_us);

  const Counters& counters() const { return counters_; }
  /// Packets of this run by their numbers, dropped ones included.
  const LossCounters& losses() const { return losses_.counters(); }
  /// Receipt of the newest packet that was not dropped; 0: none.
  std::int64_t heard_us() const { return heard_us_; }
  /// Time of the last skip; 0: none.
  std::int64_t skipped_us() const { return skipped_us_; }

 private:
  void begin(const EventPacketView& packet, std::int64_t received_us);
  void hold(const EventPacketView& packet, const Receipt& receipt);
  bool is_too_late(std::int64_t received_us, std::int64_t now_us);

  bool skips_late_;
  SinglePublisher publisher_;
  LossAccount losses_;
  Counters counters_;
  SensorSize sensor_;
  Timestamp newest_event_;
  std::int64_t began_us_ = 0;
  std::int64_t heard_us_ = 0;
  std::int64_t skipped_us_ = 0;
  std::optional<std::int64_t> behind_since_us_;

  HeldPacket held_;
  std::vector<std::uint8_t> held_data_;
  bool holds_packet_ = false;
};

}  // namespace puck
