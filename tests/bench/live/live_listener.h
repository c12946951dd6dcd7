#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>

#include "common/messaging/bus.h"

namespace puck {

/// The benchmark was stopped by a signal.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// Estimates heard since a moment.
struct EstimateTally {
  static constexpr std::int64_t kOldUs = 10'000;

  std::int64_t first_seq = 0;
  std::int64_t first_utime = 0;
  puck_estimate_t newest{};
  std::int64_t oldest_us = 0;       ///< Largest age of an estimate's newest event at publication.
  std::int64_t last_old_utime = 0;  ///< Last publication of one older than kOldUs; 0: none.
  std::int64_t heard = 0;
  std::int64_t tracking = 0;  ///< Of these: with the puck tracked.

  /// Published estimates a second, received or not; 0 with fewer than two.
  double rate_hz() const;
};

/// Receives the services' messages on a bus while it listens. One thread.
class LiveListener {
 public:
  /// Throws std::runtime_error without a route to the bus.
  LiveListener(const std::string& url, const std::string& key_file, std::stop_token stop);

  /// Listens for so long. Throws Interrupted.
  void listen(std::chrono::milliseconds time);
  /// Listens until `condition` holds; false after `timeout`. Throws Interrupted.
  bool until(const std::function<bool()>& condition, std::chrono::milliseconds timeout);

  /// The newest STATUS of a service; nothing before its first.
  const service_status_t* status(const std::string& service) const;
  /// From the newest STATUS. Throws std::runtime_error if it lacks the counter.
  std::int64_t counter(const std::string& service, const std::string& name) const;

  const EstimateTally& estimates() const { return estimates_; }
  void forget_estimates() { estimates_ = {}; }

 private:
  void hear(const puck_estimate_t& estimate);

  std::stop_token stop_;
  Bus bus_;
  std::map<std::string, service_status_t> statuses_;
  EstimateTally estimates_;
};

}  // namespace puck
