#include "common/monitor/bus_monitor.h"

#include <doctest/doctest.h>

#include "common/messaging/message_seal.h"
#include "tests/monitor/monitor_bench.h"
#include "tests/support/temporary_folder.h"

namespace puck {

TEST_CASE("the monitor computes rates over the last second, and sums over all time") {
  MonitorBench bench;
  // Three seconds of 100 packets a second, then one of 10.
  std::int64_t seq = 0;
  const event_packet_t packet = packet_of(50);
  for (int tenth = 0; tenth < 40; ++tenth) {
    const int packets = tenth < 30 ? 10 : 1;
    for (int i = 0; i < packets; ++i) bench.hear(packet, 7, seq++, tenth * 100'000);
    bench.model.snapshot((tenth + 1) * 100'000);
  }
  const BusSnapshot snapshot = bench.model.snapshot(4'000'000);
  REQUIRE(snapshot.channels.size() == 1);
  const ChannelRow& events = snapshot.channels[0];
  CHECK(events.name == "PUCK_EVENTS");
  CHECK(events.messages_per_s == doctest::Approx(10));
  CHECK(events.events_per_s == doctest::Approx(500));
  CHECK(events.bytes_per_s == doctest::Approx(10 * 293));
  CHECK(events.arrivals.received == 310);
  CHECK(events.received_bytes == 310 * 293);
  CHECK(events.newest_age_us == 100'000);
  CHECK(snapshot.messages == 310);
  CHECK(snapshot.listened_us == 4'000'000);
}

TEST_CASE("the rates of a report cover the whole time of listening") {
  MonitorBench bench({}, MonitorParams::whole_time());
  for (int i = 0; i < 10; ++i) bench.hear(head_state_t{}, 7, i, 1'900'000);
  const BusSnapshot snapshot = bench.model.snapshot(2'000'000);
  CHECK(snapshot.channels[0].messages_per_s == doctest::Approx(5));
}

TEST_CASE("a new channel's rate is not extrapolated to a full second") {
  MonitorBench bench;
  for (int i = 0; i < 5; ++i) bench.hear(head_state_t{}, 7, i, 10'000'000 + i);
  CHECK(bench.model.snapshot(10'000'010).channels[0].messages_per_s == doctest::Approx(5));
}

TEST_CASE("the monitor counts lost, late, duplicate and malformed messages, and restarts") {
  MonitorBench bench;
  for (const int seq : {0, 1, 5, 3, 5}) bench.hear(head_state_t{}, 7, seq, 1000);
  bench.hear(head_state_t{}, 8, 100, 2000);
  bench.hear_bytes("PUCK_HEAD", {1, 2, 3}, 3000);
  const BusSnapshot snapshot = bench.model.snapshot(1'000'000);
  const ChannelRow& head = snapshot.channels.at(0);
  CHECK(head.arrivals.received == 6);
  CHECK(head.arrivals.lost == 2);
  CHECK(head.arrivals.late == 1);
  CHECK(head.arrivals.duplicates == 1);
  CHECK(head.arrivals.sessions == 2);
  CHECK(head.malformed == 1);
  CHECK(head.last_rejection == "head_state_t is cut off before its fingerprint, from this process");
  CHECK(head.in_trouble);
  CHECK(snapshot.messages == 7);
}

TEST_CASE("oversized, undecryptable and unsealed messages are distinguished") {
  MonitorBench bench;
  bench.hear_bytes("PUCK_HEAD", std::vector<std::uint8_t>(89), 1000);
  const TemporaryFolder folder;
  const auto file = folder.write("key", std::string(32, 'k'));
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  const SharedKey key(file);
  MessageSealer sealer(key);
  head_state_t head{};
  head.session = 7;
  std::vector<std::uint8_t> bytes;
  encode(head, bytes);
  sealer.seal("PUCK_HEAD", bytes);
  bench.hear_bytes("PUCK_HEAD", bytes, 2000);
  ChannelRow row = bench.model.snapshot(3000).channels.at(0);
  CHECK(row.oversize == 1);
  CHECK(row.malformed == 1);
  CHECK(row.last_rejection ==
        "is sealed, but this program has no key (lcm.key_file of --config), from this process");
  CHECK(row.arrivals.received == 0);

  bench.model.set_unauthenticated(Channel::kHead, 0, "", 3000);
  bench.model.set_unauthenticated(Channel::kGame, 5, "is not sealed", 3000);
  const BusSnapshot snapshot = bench.model.snapshot(4000);
  REQUIRE(snapshot.channels.size() == 2);
  CHECK(snapshot.channels[0].name == "PUCK_GAME");
  CHECK(snapshot.channels[0].unauthenticated == 5);
  CHECK(snapshot.channels[0].last_rejection == "is not sealed");
  // Their times are unknown.
  CHECK_FALSE(snapshot.channels[0].newest_age_us.has_value());
  CHECK(snapshot.channels[1].newest_age_us == 2000);
  CHECK(snapshot.channels[1].unauthenticated == 0);
}

TEST_CASE("a problem ends after a second without one") {
  MonitorBench bench;
  bench.hear(head_state_t{}, 7, 0, 1000);
  bench.hear(head_state_t{}, 7, 9, 2000);
  CHECK(bench.model.snapshot(500'000).channels[0].in_trouble);
  bench.hear(head_state_t{}, 7, 10, 600'000);
  CHECK_FALSE(bench.model.snapshot(2'500'000).channels[0].in_trouble);
}

TEST_CASE("events in lost packets are counted by the numbering of the events") {
  MonitorBench bench;
  event_packet_t packet = packet_of(10);
  for (const int seq : {0, 1, 4}) {
    packet.events_before = 10 * seq;
    bench.hear(packet, 7, seq, 1000);
  }
  CHECK(bench.model.snapshot(2000).channels[0].arrivals.items_lost == 20);
}

TEST_CASE("publishers are named after the status of their session") {
  MonitorBench bench;
  bench.hear(head_state_t{}, 7, 0, 1000);
  CHECK(bench.model.snapshot(2000).channels[0].publishers[0].service.empty());
  bench.hear(status_of("puck-camera", "eye", 99), 7, 0, 2000);
  const BusSnapshot snapshot = bench.model.snapshot(3000);
  REQUIRE(snapshot.channels[0].publishers.size() == 1);
  const PublisherRow& camera = snapshot.channels[0].publishers[0];
  CHECK(camera.service == "puck-camera");
  CHECK(camera.host == "eye");
  CHECK(camera.pid == 99);
  CHECK(camera.session == 7);
  CHECK(camera.age_us == 2000);
}

TEST_CASE("two publishers of one channel are distinguished from a restarted one") {
  SUBCASE("at the same time") {
    MonitorBench bench;
    for (int i = 0; i < 3; ++i) {
      bench.hear(head_state_t{}, 7, i, 1000 * i);
      bench.hear(head_state_t{}, 8, i, 1000 * i + 500);
    }
    const ChannelRow row = bench.model.snapshot(3000).channels[0];
    CHECK(row.several_publishers);
    REQUIRE(row.publishers.size() == 2);
    CHECK(row.publishers[0].session == 7);
    CHECK(row.publishers[1].session == 8);
    // The first falls silent, and is dropped.
    bench.hear(head_state_t{}, 8, 3, 3'000'000);
    CHECK_FALSE(bench.model.snapshot(3'000'000).channels[0].several_publishers);
  }
  SUBCASE("one after the other") {
    MonitorBench bench;
    for (int i = 0; i < 3; ++i) bench.hear(head_state_t{}, 7, i, 1000 * i);
    for (int i = 0; i < 3; ++i) bench.hear(head_state_t{}, 8, i, 3000 + 1000 * i);
    const ChannelRow row = bench.model.snapshot(6000).channels[0];
    CHECK_FALSE(row.several_publishers);
    CHECK(row.publishers.back().session == 8);
    CHECK(row.arrivals.lost == 0);
  }
  SUBCASE("except on STATUS, which all services publish") {
    MonitorBench bench;
    for (int i = 0; i < 3; ++i) {
      bench.hear(status_of("puck-camera"), 7, i, 1000 * i);
      bench.hear(status_of("puck-tracker"), 8, i, 1000 * i + 500);
    }
    CHECK_FALSE(bench.model.snapshot(3000).channels[0].several_publishers);
  }
}

TEST_CASE("channels are listed in the order of the data flow, foreign names last") {
  MonitorBench bench("LEFT");
  bench.hear_bytes("LEFT_PUCK_WHATEVER", {1, 2, 3}, 1000);
  bench.hear(status_of("puck-camera"), 7, 0, 1000, "LEFT");
  bench.hear(packet_of(1), 7, 0, 1000, "LEFT");
  const BusSnapshot snapshot = bench.model.snapshot(2000);
  REQUIRE(snapshot.channels.size() == 3);
  CHECK(snapshot.channels[0].name == "LEFT_PUCK_EVENTS");
  CHECK(snapshot.channels[1].name == "LEFT_PUCK_STATUS");
  CHECK(snapshot.channels[2].name == "LEFT_PUCK_WHATEVER");
  CHECK_FALSE(snapshot.channels[2].type.has_value());
  CHECK(snapshot.channels[2].arrivals.received == 1);
}

TEST_CASE("20,000 names take no more room than a few, and displace no channels of ours") {
  MonitorBench bench;
  for (int i = 0; i < 20'000; ++i) bench.hear_bytes("PUCK_" + std::to_string(i), {1}, 1000);
  bench.hear(head_state_t{}, 7, 0, 1000);
  const BusSnapshot snapshot = bench.model.snapshot(2000);
  CHECK(snapshot.channels.size() < 50);
  CHECK(snapshot.channels[0].name == "PUCK_HEAD");
  CHECK(snapshot.channels[1].name == "(more names)");
  std::int64_t messages = 0;
  for (const ChannelRow& row : snapshot.channels) messages += row.arrivals.received;
  CHECK(messages == 20'001);
  CHECK(snapshot.messages == 20'001);
}

TEST_CASE("the number of remembered publishers of a channel is bounded under 1000 sessions") {
  MonitorBench bench;
  for (int i = 1; i <= 1000; ++i) bench.hear(head_state_t{}, i, 0, i);
  const ChannelRow row = bench.model.snapshot(2000).channels[0];
  CHECK(row.publishers.size() == 16);
  CHECK(row.publishers.back().session == 1000);
  CHECK(row.arrivals.sessions == 1000);
}

TEST_CASE("the newest valid message is kept unchanged") {
  MonitorBench bench;
  head_state_t head{};
  head.yaw_deg = 3;
  bench.hear(head, 7, 0, 1000);
  bench.hear_bytes("PUCK_HEAD", {1, 2, 3}, 2000);
  head_state_t kept;
  REQUIRE_FALSE(decode(bench.model.snapshot(3000).channels[0].newest, kept).has_value());
  CHECK(kept.yaw_deg == 3);
}

}  // namespace puck
