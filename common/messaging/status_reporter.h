#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "common/messaging/bus.h"
#include "common/messaging/clock_offsets.h"
#include "common/messaging/pong_book.h"

namespace puck {

/// As service_status_t numbers them.
enum class ServiceState : std::int8_t {
  kStarting = service_status_t::STATE_STARTING,
  kRunning = service_status_t::STATE_RUNNING,
  kWaiting = service_status_t::STATE_WAITING,
  kDegraded = service_status_t::STATE_DEGRADED,
  kStopping = service_status_t::STATE_STOPPING,
};

const char* to_string(ServiceState state);

struct StatusLatency {
  std::string name;  ///< packet_to_estimate, …
  std::int64_t p50_us = 0;
  std::int64_t p99_us = 0;
  std::int64_t max_us = 0;
  std::int64_t samples = 0;
};

/// What a service has to say of itself.
struct StatusReport {
  std::vector<std::pair<std::string, std::int64_t>> counters;  ///< Since the start.
  std::vector<StatusLatency> latencies;

  /// Of what is rare: STATUS of a healthy service shall fit one frame.
  void add_unless_zero(const std::string& name, std::int64_t value) {
    if (value != 0) counters.emplace_back(name, value);
  }
};

/// Publishes the STATUS of a service every 100 ms and at once when its state changes, each in one
/// frame: counters that find no room in it are left out, the last ones first, and
/// `counters_left_out` says how many; then one that is missing need not be 0. Answers the statuses
/// of others with pongs (PongBook). A run that was not heard before is answered within 20 ms, so
/// that it soon knows our clock; of several that come at once at least two, and two more every 20
/// ms, however many are known. From the pongs of others it knows theirs. The thread that calls the
/// bus's handle() calls it: a service that hangs then falls silent, as it should.
class StatusReporter {
 public:
  using Fill = std::function<void(StatusReport&)>;
  /// The counter that says how many were left out.
  static constexpr const char* kLeftOut = "counters_left_out";

  /// `service`: puck-camera, puck-tracker, … Subscribes; so make it before the bus starts.
  StatusReporter(Bus& bus, std::string service);

  using Listener = std::function<void(const service_status_t&, const Receipt&)>;
  /// The STATUS of others as it comes, in order, goes to `listener`, too: it is decoded once. Only
  /// before the bus starts.
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  void set_state(ServiceState state, std::string text = {});
  ServiceState state() const { return state_; }
  const std::string& state_text() const { return state_text_; }

  /// What is wrong with the services that this one works with; empty: nothing. Published before
  /// whatever it says of itself, and where it says that it runs its state becomes `state`.
  void set_trouble_of_peers(ServiceState state, std::string text);

  /// The clock by which a run stamps its messages: known 100 to 200 ms after both have begun to
  /// hear each other, and at once for our own. Nothing for whoever does not answer our STATUS.
  SenderClock clock_of(std::int64_t session) const;

  /// As STATUS says it.
  const std::string& service() const { return service_; }
  const std::string& host() const { return host_; }

  /// Publishes when it is due; only then is `fill` called.
  void poll(const Fill& fill);
  /// The last STATUS of the run: publishes state stopping.
  void stop(const Fill& fill);

 private:
  void hear(const service_status_t& status, const Receipt& receipt);
  void read_pongs(const service_status_t& status, const Receipt& receipt);
  ServiceState published_state() const;
  std::string published_text() const;
  void publish(const Fill& fill);
  void fill_counters(service_status_t& message, StatusReport report) const;

  Bus& bus_;
  std::string service_;
  std::string host_;
  std::int64_t started_us_ = 0;  // CLOCK_MONOTONIC
  std::int64_t due_us_ = 0;      // CLOCK_MONOTONIC
  std::int64_t soonest_us_ = 0;  // CLOCK_MONOTONIC: not before it for the sake of a new run
  ServiceState state_ = ServiceState::kStarting;
  std::string state_text_;
  ServiceState peers_state_ = ServiceState::kRunning;
  std::string peers_text_;
  bool changed_ = true;
  std::vector<Listener> listeners_;
  PongBook pongs_;
  ClockOffsets clocks_;
};

}  // namespace puck
