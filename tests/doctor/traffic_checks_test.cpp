// Findings on the received traffic.
#include "tests/doctor/doctor_bench.h"

namespace puck {
namespace {

const Source kThisHost{"10.0.0.2", 4000};

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// A first part of a larger message, and one that crashes liblcm.
const std::vector<std::uint8_t> kFragment =
    bytes_of(std::string_view("LC03\0\0\0\1\0\0\1\0\0\0\0\0\0\0\0\2BIG\0abc", 27));
const std::vector<std::uint8_t> kCrash =
    bytes_of(std::string_view("LC03\0\0\0\1\0\0\1\0\xff\xff\xff\xf0\0\1\0\2"
                              "0123456789abcdef",
                              36));

}  // namespace

TEST_CASE("ttl 0 is a note, until another host is heard") {
  Facts facts = healthy_facts();
  facts.url.ttl = 0;
  hear_status(facts.traffic, kThisHost, a_status(1, "puck-arm"), 0);
  CHECK(count_of(check_ttl(facts), Verdict::kNote) == 1);
  hear_status(facts.traffic, kOtherHost, a_status(2, "puck-tracker"), 1);
  const Finding wrong = the_wrong_one(check_ttl(facts));
  CHECK(says(wrong, "10.0.0.9"));
  CHECK(wrong.mend == "--lcm-url \"udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304\"");
}

TEST_CASE("a local program that sends with ttl 0 is named where other hosts should hear it") {
  Facts facts = healthy_facts();
  hear_status(facts.traffic, kThisHost, a_status(1, "puck-arm"), 1);
  CHECK(count_of(check_ttl(facts), Verdict::kOk) == 1);
  hear_status(facts.traffic, kThisHost, a_status(1, "puck-arm"), 0);
  facts.local_senders[kThisHost] = {"puck-arm", 41};
  CHECK(says(the_wrong_one(check_ttl(facts)), "puck-arm (pid 41)"));
}

TEST_CASE("good messages of ours are not foreign") {
  Facts facts = healthy_facts();
  hear_status(facts.traffic, kOtherHost, a_status(1, "puck-arm"));
  const Findings findings = check_senders(facts);
  REQUIRE(findings.size() == 1);
  CHECK(findings.front().verdict == Verdict::kOk);
  CHECK(says(findings.front(), "1 datagrams from 1 senders, 1 of them good"));
}

TEST_CASE("a foreign sender on another host is blocked, a local one ended") {
  Facts facts = healthy_facts();
  hear(facts.traffic, kOtherHost, bytes_of("junk"));
  CHECK(the_wrong_one(check_senders(facts)).mend ==
        "iptables -I INPUT -s 10.0.0.9 -p udp --dport 7667 -j DROP");

  Facts here = healthy_facts();
  hear(here.traffic, kThisHost, bytes_of("junk"));
  CHECK(the_wrong_one(check_senders(here)).mend == "ss -uanp 'sport = :4000'");
  here.local_senders[kThisHost] = {"nc", 41};
  CHECK(the_wrong_one(check_senders(here)).mend == "kill 41");
}

TEST_CASE("a host with services of ours is never blocked") {
  Facts facts = healthy_facts();
  hear(facts.traffic, kOtherHost, bytes_of("junk"));
  hear_status(facts.traffic, {kOtherHost.address, 6000}, a_status(1, "puck-arm"));
  CHECK(the_wrong_one(check_senders(facts)).mend == "ssh 10.0.0.9 sudo ss -uanp 'sport = :5000'");
}

TEST_CASE("every kind of bad datagram is distinguished") {
  Facts facts = healthy_facts();
  hear(facts.traffic, kOtherHost, kCrash);
  CHECK(says(the_wrong_one(check_senders(facts)), "can crash programs that use liblcm"));

  facts = healthy_facts();
  hear(facts.traffic, kOtherHost, kFragment);
  CHECK(says(the_wrong_one(check_senders(facts)), "refused here"));
  facts.allow_fragments = true;
  CHECK(count_of(check_senders(facts), Verdict::kNote) == 1);

  facts = healthy_facts();
  hear(facts.traffic, kOtherHost, lcm_datagram("PUCK_ESTIMATE", {1, 2, 3}));
  CHECK(says(the_wrong_one(check_senders(facts)), "PUCK_ESTIMATE: puck_estimate_t is cut off"));

  facts = healthy_facts();
  hear(facts.traffic, kOtherHost, lcm_datagram("POSE\x1b[2J", {1, 2, 3}));
  const Findings findings = check_senders(facts);
  CHECK(count_of(findings, Verdict::kWrong) == 0);
  CHECK(says(findings.back(), "POSE\\x1b[2J"));
}

TEST_CASE("a sender of good and bad messages is a service of another version, and is not ended") {
  Facts facts = healthy_facts();
  facts.local_senders[kThisHost] = {"puck-arm", 41};
  hear_status(facts.traffic, kThisHost, a_status(1, "puck-arm"));
  hear(facts.traffic, kThisHost, lcm_datagram("PUCK_ARM_STATE", {1, 2, 3}));
  const Finding wrong = the_wrong_one(check_senders(facts));
  CHECK(says(wrong, "another version"));
  CHECK(wrong.mend == "git pull && cmake --preset release && cmake --build --preset release");
}

TEST_CASE("a message of another type on a channel of ours is reported as such") {
  Facts facts = healthy_facts();
  service_status_t status = a_status(1, "puck-arm");
  std::vector<std::uint8_t> payload;
  encode(status, payload);
  hear(facts.traffic, kOtherHost, lcm_datagram("PUCK_GAME", payload));
  CHECK(says(the_wrong_one(check_senders(facts)), "PUCK_GAME: game_state_t"));
}

TEST_CASE("the cost of foreign senders does not grow with their number") {
  Facts facts = healthy_facts();
  for (int port = 1; port <= 60'000; ++port) {
    hear(facts.traffic, {"10.0.0.9", port}, lcm_datagram("C" + std::to_string(port), {}));
    hear(facts.traffic, kOtherHost, lcm_datagram("C" + std::to_string(port), {}));
    service_status_t status = a_status(port, "puck-" + std::to_string(port));
    if (port % 50 == 0) hear_status(facts.traffic, kOtherHost, status);
    if (port % 50 == 1) hear_status(facts.traffic, kOtherHost, status, 1, "P1_PUCK_STATUS");
  }
  CHECK(facts.traffic.senders().size() == Traffic::kMaxSenders);
  CHECK(facts.traffic.uncounted() > 0);
  CHECK(facts.traffic.services().size() <= Traffic::kMaxServices);
  for (const auto& [source, sender] : facts.traffic.senders()) {
    CHECK(sender.channels.size() <= Traffic::kMaxChannels);
  }
  CHECK(count_of(check_senders(facts), Verdict::kWrong) == 1);
}

TEST_CASE("services are listed with host, pid, version and state") {
  Facts facts = healthy_facts();
  hear_status(facts.traffic, kOtherHost, a_status(1, "puck-arm"));
  service_status_t waiting = a_status(2, "puck-tracker");
  waiting.state = service_status_t::STATE_WAITING;
  waiting.state_text = "for events";
  hear_status(facts.traffic, kThisHost, waiting);
  const Findings findings = check_services(facts);
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].verdict == Verdict::kOk);
  CHECK(findings[0].text == "puck-arm on robot (10.0.0.9), pid 101, version 1.0.0, running");
  CHECK(findings[1].verdict == Verdict::kNote);
  CHECK(says(findings[1], "waiting: for events"));
}

TEST_CASE("two services of a kind are an error, unless one has stopped or has another prefix") {
  Facts facts = healthy_facts();
  service_status_t older = a_status(1, "puck-arm");
  older.uptime_us = 9'000'000;
  hear_status(facts.traffic, kThisHost, older);
  hear_status(facts.traffic, kOtherHost, a_status(3, "puck-arm"), 1, "LEFT_PUCK_STATUS");
  service_status_t second = a_status(2, "puck-arm");
  second.state = service_status_t::STATE_STOPPING;
  hear_status(facts.traffic, kOtherHost, second);
  CHECK(count_of(check_services(facts), Verdict::kWrong) == 0);

  second.state = service_status_t::STATE_RUNNING;
  hear_status(facts.traffic, kOtherHost, second);
  CHECK(the_wrong_one(check_services(facts)).mend == "ssh 10.0.0.9 kill 102");
  // It fell silent while the other one continued.
  facts.end_utime += 1'500'000;
  hear_status(facts.traffic, kThisHost, older, 1, "PUCK_STATUS", facts.end_utime);
  CHECK(count_of(check_services(facts), Verdict::kWrong) == 0);
}

TEST_CASE("services under another prefix are listed, with the option that receives them") {
  Facts facts = healthy_facts();
  CHECK(count_of(check_services(facts), Verdict::kNote) == 1);
  hear_status(facts.traffic, kOtherHost, a_status(1, "puck-arm"), 1, "LEFT_PUCK_STATUS");
  CHECK(the_wrong_one(check_services(facts)).mend == "--prefix \"LEFT\"");

  facts.prefix = "LEFT";
  facts.traffic = Traffic("LEFT");
  hear_status(facts.traffic, kOtherHost, a_status(1, "puck-arm"));
  CHECK(the_wrong_one(check_services(facts)).mend == "--prefix \"\"");
}

TEST_CASE("a channel belongs to a prefix only if its whole beginning is the prefix") {
  Traffic traffic("");
  for (const std::string name : {"X", "lower_", "LEFT", "A_VERY_LONG_PREFIX_", "_"}) {
    hear_status(traffic, kOtherHost, a_status(1, "puck-arm"), 1, name + "PUCK_STATUS");
  }
  CHECK(traffic.other_prefixes().empty());
  CHECK(traffic.senders().at(kOtherHost).foreign == 5);
}

TEST_CASE("a service of another version is an error") {
  Facts facts = healthy_facts();
  hear_status(facts.traffic, kOtherHost, a_status(1, "puck-arm"));
  CHECK(count_of(check_versions(facts), Verdict::kOk) == 1);
  service_status_t old = a_status(2, "puck-tracker");
  old.version = "0.9.0";
  hear_status(facts.traffic, kOtherHost, old);
  CHECK(says(the_wrong_one(check_versions(facts)), "puck-tracker on robot is version 0.9.0"));
}

TEST_CASE("another doctor is not listed as a service") {
  Facts facts = healthy_facts();
  service_status_t doctor = a_status(1, "puck-doctor");
  doctor.version = "0.9.0";
  hear_status(facts.traffic, kOtherHost, doctor);
  CHECK(count_of(check_services(facts), Verdict::kNote) == 1);
  CHECK(count_of(check_versions(facts), Verdict::kWrong) == 0);
}

}  // namespace puck
