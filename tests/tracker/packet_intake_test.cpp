#include "services/tracker/packet_intake.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <doctest/doctest.h>

namespace puck {
namespace {

using Verdict = PacketIntake::Verdict;

constexpr std::int32_t kPacketEvents = 10;
constexpr std::int64_t kSilenceUs = SinglePublisher::kSilentAfterUs + 1;

EventPacketView packet_of(std::int64_t session, std::int64_t seq, std::int64_t first_event_us) {
  return {.session = session,
          .seq = seq,
          .width = 160,
          .height = 120,
          .first_event_us = first_event_us,
          .events_before = seq * kPacketEvents,
          .count = kPacketEvents};
}

// Receives packets and notes the taken ones.
struct Receiver {
  Verdict hear(const EventPacketView& packet, std::int64_t received_us, std::int64_t wait_us = 0) {
    const std::int64_t now_us = received_us + wait_us;
    const Verdict verdict = intake.admit(packet, {.monotonic_us = received_us}, now_us);
    if (verdict == Verdict::kBegin || verdict == Verdict::kTake) {
      intake.note_taken({packet.first_event_us}, received_us, now_us);
    }
    return verdict;
  }
  // The next packet of session 1.
  Verdict hear_next(std::int64_t received_us, std::int64_t now_us) {
    ++seq;
    return hear(packet_of(1, seq, seq), received_us, now_us - received_us);
  }
  // Whether the next packet of session 1 is left out.
  bool leaves_out(std::int64_t received_us, std::int64_t now_us) {
    return hear_next(received_us, now_us) == Verdict::kHeld;
  }

  PacketIntake intake{true};
  std::int64_t seq = -1;
};

// A receiver with a run.
Receiver begun() {
  Receiver receiver;
  REQUIRE(receiver.hear_next(0, 0) == Verdict::kBegin);
  return receiver;
}

}  // namespace

TEST_CASE("the first publisher is followed until it is silent, then another one") {
  Receiver receiver;
  CHECK(receiver.hear(packet_of(1, 0, 1000), 1'000) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(2, 0, 1000), 2'000) == Verdict::kOtherPublisher);
  CHECK(receiver.hear(packet_of(1, 1, 2000), 3'000) == Verdict::kTake);
  CHECK(receiver.intake.heard_us() == 3'000);
  CHECK(receiver.intake.counters().events_received == 2 * kPacketEvents);
  CHECK(receiver.hear(packet_of(2, 1, 500), 3'000 + kSilenceUs) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(1, 2, 3000), 3'001 + kSilenceUs) == Verdict::kOtherPublisher);
  // The counters begin anew, except that of others.
  CHECK(receiver.intake.counters().events_received == kPacketEvents);
  CHECK(receiver.intake.losses().received == 1);
  CHECK(receiver.intake.counters().packets_of_others == 2);
}

TEST_CASE("late packets are dropped and lost ones counted, but a log may be replayed") {
  Receiver receiver;
  REQUIRE(receiver.hear(packet_of(1, 5, 5'000), 1'000) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(1, 4, 4'000), 2'000) == Verdict::kLate);
  CHECK(receiver.hear(packet_of(1, 7, 7'000), 3'000) == Verdict::kTake);
  CHECK(receiver.intake.counters().packets_dropped == 1);
  CHECK(receiver.intake.losses().received == 3);
  CHECK(receiver.intake.losses().lost == 1);
  CHECK(receiver.intake.losses().items_lost == kPacketEvents);
  CHECK(receiver.hear(packet_of(1, 5, 5'000), 3'000 + kSilenceUs) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(1, 6, 6'000), 4'000 + kSilenceUs) == Verdict::kTake);
  CHECK(receiver.intake.counters().packets_dropped == 0);
}

TEST_CASE("a packet of another sensor or older than the newest event is dropped") {
  Receiver receiver;
  REQUIRE(receiver.hear(packet_of(1, 0, 10'000), 1'000) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(1, 1, 9'999), 2'000) == Verdict::kUnfit);
  EventPacketView other = packet_of(1, 2, 20'000);
  other.width = 320;
  CHECK(receiver.hear(other, 3'000) == Verdict::kUnfit);
  CHECK(receiver.hear(packet_of(1, 3, 10'000), 4'000) == Verdict::kTake);
  CHECK(receiver.intake.counters().packets_dropped == 2);
  CHECK(receiver.intake.counters().events_received == 2 * kPacketEvents);
}

TEST_CASE("a restarted sensor clock begins a run, but not with every jump to and fro") {
  Receiver receiver;
  REQUIRE(receiver.hear(packet_of(1, 0, 10'000'000), 0) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(1, 1, 1'000), PacketIntake::kClockRestartedUs) == Verdict::kUnfit);
  const std::int64_t later_us = PacketIntake::kClockRestartedUs + 1;
  CHECK(receiver.hear(packet_of(1, 2, 9'000'000), later_us) == Verdict::kUnfit);
  CHECK(receiver.hear(packet_of(1, 3, 8'999'999), later_us) == Verdict::kBegin);
  CHECK(receiver.hear(packet_of(1, 4, 10'000'000), later_us) == Verdict::kTake);
  CHECK(receiver.hear(packet_of(1, 5, 1'000), later_us + 1) == Verdict::kUnfit);
}

TEST_CASE("the wait of a packet counts in whole packets of its length") {
  PacketIntake intake(true);
  REQUIRE(intake.admit(packet_of(1, 0, 1'000), {}, 0) == Verdict::kBegin);
  CHECK(intake.note_taken({1'300}, 5'000, 6'000) == 900);
  CHECK(intake.note_taken({1'400}, 5'000, 5'099) == 0);
  CHECK(intake.note_taken({1'400}, 5'000, 5'007) == 7);
}

TEST_CASE("the held packet is taken when it stays the newest, and skipped when another comes") {
  Receiver receiver = begun();
  CHECK(receiver.hear_next(1'000, 20'000) == Verdict::kTake);
  std::array<std::uint8_t, 3> data{1, 2, 3};
  const std::int64_t now_us = 20'001 + PacketIntake::kPatienceUs;
  CHECK(receiver.hear_next(2'000, now_us) == Verdict::kHeld);
  EventPacketView packet = packet_of(1, ++receiver.seq, 5'000);
  packet.data = data;
  CHECK(receiver.hear(packet, 3'000, now_us - 3'000) == Verdict::kHeld);
  data = {};
  CHECK(receiver.intake.counters().packets_skipped == 1);
  CHECK(receiver.intake.counters().events_skipped == kPacketEvents);
  CHECK(receiver.intake.counters().events_received == 4 * kPacketEvents);
  CHECK(receiver.intake.skipped_us() == now_us);

  const PacketIntake::HeldPacket* held = receiver.intake.release();
  REQUIRE(held != nullptr);
  CHECK(held->packet.first_event_us == 5'000);
  CHECK(held->receipt.monotonic_us == 3'000);
  CHECK(std::ranges::equal(held->packet.data, std::array<std::uint8_t, 3>{1, 2, 3}));
  CHECK(receiver.intake.release() == nullptr);
  CHECK(receiver.hear(packet_of(1, ++receiver.seq, 6'000), now_us) == Verdict::kTake);
  CHECK(receiver.intake.counters().packets_skipped == 1);
}

TEST_CASE("a held packet of an ended run is neither taken nor counted") {
  Receiver receiver = begun();
  receiver.hear_next(0, 20'000);
  REQUIRE(receiver.hear_next(0, 20'001 + PacketIntake::kPatienceUs) == Verdict::kHeld);
  CHECK(receiver.hear(packet_of(2, 0, 0), kSilenceUs) == Verdict::kBegin);
  CHECK(receiver.intake.release() == nullptr);
  CHECK(receiver.intake.counters().packets_skipped == 0);
}

TEST_CASE("without skipping every packet is taken, however late") {
  Receiver receiver{PacketIntake(false)};
  for (int i = 0; i < 1000; ++i) {
    CHECK(receiver.hear_next(i * 1000, i * 1000 + 10 * PacketIntake::kPatienceUs) ==
          (i == 0 ? Verdict::kBegin : Verdict::kTake));
  }
}

TEST_CASE("packets with a short wait are all taken") {
  Receiver receiver = begun();
  for (int i = 0; i < 1000; ++i) {
    CHECK(receiver.hear_next(i * 1000, i * 1000 + PacketIntake::kBehindUs) == Verdict::kTake);
  }
}

TEST_CASE("a short delay that is made up for costs no packet") {
  Receiver receiver = begun();
  // 40 ms of packets are queued; each is processed in half of its duration.
  for (int i = 0; i < 70; ++i) {
    CHECK(receiver.hear_next(i * 1000, 40'000 + i * 500) == Verdict::kTake);
  }
}

TEST_CASE("a queue that does not shrink is dropped whole, down to the newest packet") {
  Receiver receiver = begun();
  const std::int64_t began_us = 20'000;
  CHECK_FALSE(receiver.leaves_out(0, began_us));
  CHECK_FALSE(receiver.leaves_out(4'000, began_us + PacketIntake::kPatienceUs));
  CHECK(receiver.leaves_out(4'100, began_us + PacketIntake::kPatienceUs + 1));
  CHECK(receiver.leaves_out(60'000, began_us + PacketIntake::kPatienceUs + 2));
  const std::int64_t now_us = began_us + PacketIntake::kPatienceUs + 3;
  CHECK(receiver.leaves_out(now_us - PacketIntake::kBehindUs - 1, now_us));
  CHECK_FALSE(receiver.leaves_out(now_us - PacketIntake::kBehindUs, now_us));
  // Caught up: the time limit starts again.
  CHECK_FALSE(receiver.leaves_out(now_us, now_us + 30'000));
}

TEST_CASE("in a flood of five times the capacity no packet waits for long") {
  Receiver receiver = begun();
  constexpr std::int64_t kEveryUs = 100;
  constexpr std::int64_t kTakesUs = 500;
  constexpr std::int64_t kSkipTakesUs = 5;
  constexpr std::int64_t kPackets = 100'000;
  std::int64_t now_us = 0;
  std::int64_t taken = 0;
  std::int64_t longest_us = 0;
  for (std::int64_t i = 0; i < kPackets; ++i) {
    now_us = std::max(now_us, i * kEveryUs);
    longest_us = std::max(longest_us, now_us - i * kEveryUs);
    const bool leaves_out = receiver.leaves_out(i * kEveryUs, now_us);
    if (!leaves_out) ++taken;
    now_us += leaves_out ? kSkipTakesUs : kTakesUs;
  }
  CHECK(longest_us < PacketIntake::kPatienceUs + 10'000);
  // Meanwhile it works at its capacity.
  CHECK(taken * kTakesUs > kPackets * kEveryUs * 8 / 10);
}

}  // namespace puck
