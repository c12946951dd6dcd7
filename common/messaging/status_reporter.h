#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

/// Counters and latencies of a service.
struct StatusReport {
  std::vector<std::pair<std::string, std::int64_t>> counters;  ///< Since the start.
  std::vector<StatusLatency> latencies;

  /// For rare events: zeros are left out, so that the STATUS of a healthy service fits one frame.
  void add_unless_zero(const std::string& name, std::int64_t value) {
    if (value != 0) counters.emplace_back(name, value);
  }
};

/// A service by its STATUS. Borrows the counters of the message.
struct PeerStatus {
  std::int64_t session = 0;
  std::string service;
  std::string host;
  std::int32_t pid = 0;
  ServiceState state = ServiceState::kStarting;
  std::string state_text;
  std::int64_t utime = 0;  ///< At publish, by the peer's clock.
  std::span<const std::string> counter_names;
  std::span<const std::int64_t> counter_values;  ///< As many.

  /// Nothing if STATUS has no such counter.
  std::optional<std::int64_t> counter(std::string_view name) const;
};

/// Publishes the STATUS of a service every 100 ms and after every change of state, each in one
/// frame: counters without room are left out from the end and counted in `counters_left_out`; a
/// missing counter may then differ from 0. Answers the STATUS of others with pongs (PongBook), and
/// measures their clocks from theirs. A new run is answered within 20 ms; of several, at least two
/// at once and two more every 20 ms. Call it on the thread of the bus's handle(), so that a service
/// that hangs falls silent.
class StatusReporter {
 public:
  using Fill = std::function<void(StatusReport&)>;
  /// Counter of the counters left out.
  static constexpr const char* kLeftOut = "counters_left_out";

  /// `service`: puck-camera, puck-tracker, … Subscribes, so make it before the bus starts.
  StatusReporter(Bus& bus, std::string service);

  using Listener = std::function<void(const PeerStatus&, const Receipt&)>;
  /// Calls `listener` with each STATUS of others, in order. Call it before the bus starts.
  void listen(Listener listener) { listeners_.push_back(std::move(listener)); }

  void set_state(ServiceState state, std::string text = {});
  ServiceState state() const { return state_; }
  const std::string& state_text() const { return state_text_; }

  /// Problem of the services that this one needs; empty: none. Published before the service's own
  /// text; where its own state is running, `state` replaces it.
  void set_trouble_of_peers(ServiceState state, std::string text);

  /// Clock of a run: known 100 to 200 ms after both runs receive each other, and at once for our
  /// own. Nothing for a run that does not answer our STATUS.
  SenderClock clock_of(std::int64_t session) const;

  /// As published in STATUS.
  const std::string& service() const { return service_; }
  const std::string& host() const { return host_; }

  /// Publishes when due; calls `fill` only then.
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
  std::int64_t soonest_us_ = 0;  // CLOCK_MONOTONIC: earliest time of an answer to a new run
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
