#include "tools/evaluate/lossy_reader.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <doctest/doctest.h>

#include "common/messaging/event_packing.h"
#include "tests/evaluation/listed_events.h"

namespace puck {
namespace {

std::unique_ptr<LossyReader> lossy(std::vector<std::int64_t> times_us,
                                   const LossyReaderParams& params) {
  return std::make_unique<LossyReader>(std::make_unique<ListedEvents>(std::move(times_us)), params);
}

std::vector<std::int64_t> even_times(int count, std::int64_t gap_us) {
  std::vector<std::int64_t> times;
  for (int i = 0; i < count; ++i) times.push_back(i * gap_us);
  return times;
}

std::vector<std::size_t> packet_sizes(EventReader& events) {
  std::vector<std::size_t> sizes;
  EventPacket packet;
  while (events.read(packet, 100'000)) sizes.push_back(packet.events.size());
  return sizes;
}

TEST_CASE("without loss the events are unchanged, in the packets of a camera") {
  auto times = even_times(5000, 1);
  for (std::int64_t& time : times) time /= 2;  // 2 Mev/s, so that packets are full in time
  const auto events = lossy(times, {});
  const int full = EventPacker({{64, 48}, 1472}).max_events();
  const auto sizes = packet_sizes(*events);
  CHECK(sizes.front() == static_cast<std::size_t>(full));
  CHECK(*std::max_element(sizes.begin(), sizes.end()) == static_cast<std::size_t>(full));
  events->rewind();
  CHECK(times_of(*events) == times);
  events->rewind();
  CHECK(times_of(*events, 7) == times);
  CHECK(events->packets_lost() == 0);
}

TEST_CASE(
    "a packet ends a quarter of a millisecond after its start, a packet of few events later") {
  const auto dense = packet_sizes(*lossy(even_times(1000, 5), {}));
  CHECK(dense.front() == 51);
  const auto quiet = packet_sizes(*lossy(even_times(1000, 1000), {}));
  CHECK(quiet.front() == 6);
}

TEST_CASE("the requested share of packets is lost, whole packets, the same each time") {
  const auto times = even_times(400'000, 5);
  const auto events = lossy(times, {.drop_percent = 5, .seed = 3});
  const auto left = times_of(*events);
  const double share =
      static_cast<double>(events->packets_lost()) / static_cast<double>(events->packets());
  CHECK(share == doctest::Approx(0.05).epsilon(0.2));
  CHECK(left.size() == times.size() - static_cast<std::size_t>(events->events_lost()));
  CHECK(events->events_lost() == 51 * events->packets_lost());
  events->rewind();
  CHECK(times_of(*events) == left);
  CHECK(times_of(*lossy(times, {.drop_percent = 5, .seed = 4})) != left);
  CHECK(times_of(*lossy(times, {.drop_percent = 100})).empty());
}

}  // namespace
}  // namespace puck
