#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "common/messaging/message_codec.h"
#include "tools/doctor/checks.h"

namespace puck {

inline const Source kOtherHost{"10.0.0.9", 5000};

/// Facts of a healthy machine, for a test to modify.
inline Facts healthy_facts() {
  Facts facts;
  facts.url = parse_lcm_url("udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304");
  facts.packet_bytes = 1472;
  facts.seconds = 2;
  facts.version = "1.0.0";
  facts.is_root = true;
  facts.interfaces = {{.name = "lo",
                       .is_up = true,
                       .has_link = true,
                       .is_loopback = true,
                       .mtu_bytes = 65536,
                       .addresses = {"127.0.0.1"}},
                      {.name = "eth0",
                       .is_up = true,
                       .has_link = true,
                       .can_multicast = true,
                       .mtu_bytes = 1500,
                       .addresses = {"10.0.0.2"}}};
  facts.route = KernelRoute{"eth0", "10.0.0.2"};
  facts.rmem_max_bytes = 4194304;
  facts.buffer_bytes = 4194304;
  facts.before = KernelCounters{};
  facts.after = KernelCounters{};
  facts.firewall.emplace();
  facts.self_test = {.sent = 20, .came_back = 20};
  facts.end_utime = 1'000'000'000;
  return facts;
}

/// A datagram of LCM.
inline std::vector<std::uint8_t> lcm_datagram(std::string_view channel,
                                              const std::vector<std::uint8_t>& payload) {
  std::vector<std::uint8_t> bytes{'L', 'C', '0', '2', 0, 0, 0, 1};
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

/// The STATUS of a healthy service.
inline service_status_t a_status(std::int64_t session, const std::string& service) {
  service_status_t status{};
  status.utime = 999'999'000;
  status.session = session;
  status.service = service;
  status.host = "robot";
  status.pid = static_cast<std::int32_t>(100 + session);
  status.version = "1.0.0";
  status.state = service_status_t::STATE_RUNNING;
  return status;
}

inline const HeardService* hear(Traffic& traffic, const Source& source,
                                const std::vector<std::uint8_t>& bytes, int ttl = 1,
                                std::int64_t utime = 1'000'000'000) {
  return traffic.add({source, ttl, utime, bytes});
}

inline const HeardService* hear_status(Traffic& traffic, const Source& source,
                                       service_status_t status, int ttl = 1,
                                       const std::string& channel = "PUCK_STATUS",
                                       std::int64_t utime = 1'000'000'000) {
  std::vector<std::uint8_t> payload;
  encode(status, payload);
  return hear(traffic, source, lcm_datagram(channel, payload), ttl, utime);
}

inline int count_of(const Findings& findings, Verdict verdict) {
  int count = 0;
  for (const Finding& finding : findings) count += finding.verdict == verdict;
  return count;
}

/// The only wrong finding.
inline Finding the_wrong_one(const Findings& findings) {
  REQUIRE(count_of(findings, Verdict::kWrong) == 1);
  for (const Finding& finding : findings) {
    if (finding.verdict == Verdict::kWrong) return finding;
  }
  return {};
}

inline bool says(const Finding& finding, std::string_view part) {
  return finding.text.find(part) != std::string::npos;
}

}  // namespace puck
