#include "tools/doctor/listen.h"

#include <chrono>
#include <utility>

#include "common/messages/host_time.h"
#include "tools/doctor/udp_listener.h"
#include "tools/doctor/wire_probe.h"

namespace puck {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kSendEvery{100};
constexpr int kSendsBeforeStatus = 3;
constexpr milliseconds kStep{20};
// Time for the last datagrams to come back.
constexpr milliseconds kGrace{500};

/// Sends and receives for one report.
class BusListening {
 public:
  explicit BusListening(Facts& facts)
      : facts_(facts),
        listener_(facts.url),
        probe_({facts.url, facts.prefix, facts.key_file}),
        clocks_(probe_.session()) {}

  void run() {
    const auto end = Clock::now() + std::chrono::duration<double>(facts_.seconds);
    auto next_send = Clock::now();
    while (Clock::now() < end) {
      if (Clock::now() >= next_send) {
        next_send += kSendEvery;
        speak();
      }
      hear();
    }
    facts_.end_utime = host_utime();
    // So that monitors do not report the doctor as a dead service.
    if (has_spoken_ && !facts_.traffic.is_sealed()) {
      probe_.send_status(service_status_t::STATE_STOPPING);
    }
    const auto grace_end = Clock::now() + kGrace;
    while (test().came_back < test().sent && Clock::now() < grace_end) hear();
    facts_.clock_offsets = clocks_.offsets(host_now());
  }

 private:
  SelfTest& test() { return facts_.self_test; }

  void speak() {
    probe_.send_self_test();
    ++test().sent;
    // Services with a key would warn about a STATUS without a seal. After some sends, all services
    // had time to show whether they have a key.
    if (test().sent <= kSendsBeforeStatus || facts_.traffic.is_sealed()) return;
    // Before the send: the round trip is never underestimated.
    const std::int64_t monotonic_us = host_monotonic_us();
    clocks_.sent({probe_.send_status(service_status_t::STATE_RUNNING), monotonic_us});
    has_spoken_ = true;
  }

  void hear() {
    const auto datagram = listener_.receive(kStep);
    if (!datagram) return;
    if (probe_.is_self_test(datagram->bytes)) ++test().came_back;
    const Source& source = datagram->source;
    if (source.port == probe_.port() && facts_.is_own_address(source.address)) return;
    const HeardService* service = facts_.traffic.add(*datagram);
    if (service == nullptr) return;
    const HostNow now = host_now();
    clocks_.hear(*service, now.monotonic_us - (now.utime - service->heard_utime));
  }

  Facts& facts_;
  UdpListener listener_;
  WireProbe probe_;
  HostClocks clocks_;
  bool has_spoken_ = false;
};

}  // namespace

void listen(Facts& facts) {
  facts.end_utime = host_utime();
  OpenSeal open_seal;
  if (!facts.key_file.empty()) open_seal = open_seals_with(facts.key_file);
  facts.traffic = Traffic(facts.prefix, std::move(open_seal));
  try {
    BusListening(facts).run();
  } catch (const ListenError& problem) {
    facts.self_test.problem = problem.what();
  }
}

}  // namespace puck
