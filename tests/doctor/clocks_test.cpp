#include <limits>

#include "tests/doctor/doctor_bench.h"
#include "tools/doctor/host_clocks.h"

namespace puck {
namespace {

constexpr std::int64_t kOurSession = 77;
const std::string kAddress = "10.0.0.9";
// Both of our clocks have the same value in these tests.
constexpr HostNow kNow{2'050'040, 2'050'040};

/// A STATUS received at `heard` by our clock, in answer to the ping of `ping`; the other clock is
/// ahead by `ahead`, the ways take `out` and `back`, the answer `there`.
struct Exchange {
  std::int64_t ping_us = 1'000'000;
  std::int64_t ahead_us = 0;
  std::int64_t out_us = 100;
  std::int64_t there_us = 50'000;
  std::int64_t back_us = 100;
  std::int64_t session = kOurSession;
};

void hear(HostClocks& clocks, const Exchange& exchange) {
  HeardService service;
  service.source = {kAddress, 5000};
  service.status.host = "robot";
  service.status.session = 5;
  const std::int64_t received_us = exchange.ping_us + exchange.out_us + exchange.ahead_us;
  service.status.utime = received_us + exchange.there_us;
  service.status.pong_session = {exchange.session};
  service.status.pong_utime = {exchange.ping_us};
  service.status.pong_received_utime = {received_us};
  service.heard_utime = exchange.ping_us + exchange.out_us + exchange.there_us + exchange.back_us;
  clocks.hear(service, service.heard_utime);
}

}  // namespace

TEST_CASE("another clock's offset is measured to half the round trip") {
  for (const std::int64_t ahead_us : {0, 700'000, -700'000}) {
    HostClocks clocks(kOurSession);
    clocks.sent({1'000'000, 1'000'000});
    hear(clocks, {.ahead_us = ahead_us, .out_us = 300, .back_us = 100});
    const HostClock offset = clocks.offsets(kNow).at(kAddress);
    CHECK(offset.host == "robot");
    // Half the round trip, the drift of a second, and for indistinguishable clocks the measured
    // difference.
    CHECK(offset.within_us >= 200);
    CHECK(offset.within_us <= 200 + 110 + 100);
    CHECK(std::llabs(offset.offset_us - ahead_us) <= offset.within_us);
  }
}

TEST_CASE("the exchange with the shortest round trip counts") {
  HostClocks clocks(kOurSession);
  clocks.sent({1'000'000, 1'000'000});
  clocks.sent({2'000'000, 2'000'000});
  hear(clocks, {.ping_us = 1'000'000, .ahead_us = 5000, .out_us = 40'000});
  hear(clocks, {.ping_us = 2'000'000, .ahead_us = 5000, .out_us = 20, .back_us = 20});
  hear(clocks, {.ping_us = 1'000'000, .ahead_us = 5000, .back_us = 40'000});
  CHECK(clocks.offsets(kNow).at(kAddress).offset_us == 5000);
  CHECK(clocks.offsets(kNow).at(kAddress).within_us == 21);
}

TEST_CASE("pongs to others, to unknown pings, and impossible ones are ignored") {
  HostClocks clocks(kOurSession);
  clocks.sent({1'000'000, 1'000'000});
  hear(clocks, {.session = kOurSession + 1});
  hear(clocks, {.ping_us = 999'999});
  hear(clocks, {.there_us = -1});
  hear(clocks, {.out_us = 10, .back_us = -2'000});
  CHECK(clocks.offsets(kNow).empty());
}

TEST_CASE("a clock that is certainly off by more than 100 ms is reported, with a remedy") {
  Facts facts = healthy_facts();
  facts.clock_offsets[kAddress] = {"robot", 99'000, 500};
  CHECK(count_of(check_clocks(facts), Verdict::kOk) == 1);
  facts.clock_offsets[kAddress] = {"robot", -150'000, 500};
  const Finding apart = check_clocks(facts).front();
  CHECK(apart.verdict == Verdict::kNote);
  CHECK(says(apart, "150.000 ms behind, to within 0.500 ms"));
  CHECK(apart.mend == "ssh 10.0.0.9 sudo timedatectl set-ntp true");
  // So slow an answer proves nothing.
  facts.clock_offsets[kAddress] = {"robot", 150'000, 80'000};
  CHECK(check_clocks(facts).front().mend.empty());
}

TEST_CASE("without an answer, the age of messages bounds the clock's offset on one side") {
  Facts facts = healthy_facts();
  service_status_t status = a_status(1, "puck-arm");
  hear_status(facts.traffic, {kAddress, 5000}, status);
  CHECK(says(check_clocks(facts).front(), "is at most 1.000 ms behind"));
  CHECK(check_clocks(facts).front().verdict == Verdict::kNote);
  status.utime = 1'000'300'000;
  hear_status(facts.traffic, {kAddress, 5000}, status);
  CHECK(says(check_clocks(facts).front(), "at least 300.000 ms ahead"));
  CHECK(check_clocks(facts).front().mend == "ssh 10.0.0.9 sudo timedatectl set-ntp true");
}

TEST_CASE("the clock of this host needs no comparison") {
  Facts facts = healthy_facts();
  hear_status(facts.traffic, {"10.0.0.2", 5000}, a_status(1, "puck-arm"));
  facts.clock_offsets["10.0.0.2"] = {"here", 500'000, 1};
  CHECK(says(check_clocks(facts).front(), "there is one clock"));
}

}  // namespace puck
