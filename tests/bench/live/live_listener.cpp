#include "tests/bench/live/live_listener.h"

#include <algorithm>

#include "tests/support/status_counter.h"

namespace puck {

double EstimateTally::rate_hz() const {
  const std::int64_t span_us = newest.utime - first_utime;
  if (heard < 2 || span_us <= 0) return 0;
  return static_cast<double>(newest.seq - first_seq) / (static_cast<double>(span_us) * 1e-6);
}

LiveListener::LiveListener(const std::string& url, const std::string& key_file,
                           std::stop_token stop)
    : stop_(std::move(stop)), bus_({.url = url, .key_file = key_file}) {
  bus_.subscribe<service_status_t>([this](const service_status_t& status, const Receipt&) {
    statuses_[status.service] = status;
  });
  bus_.subscribe<puck_estimate_t>(
      [this](const puck_estimate_t& estimate, const Receipt&) { hear(estimate); });
  std::string problem;
  std::stop_source give_up;
  const bool started = bus_.start(give_up.get_token(), [&](const std::string& reason) {
    problem = reason;
    give_up.request_stop();
  });
  if (!started) throw std::runtime_error(problem);
}

void LiveListener::listen(std::chrono::milliseconds time) {
  until([] { return false; }, time);
}

bool LiveListener::until(const std::function<bool()>& condition,
                         std::chrono::milliseconds timeout) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (stop_.stop_requested()) throw Interrupted();
    if (std::chrono::steady_clock::now() >= end) return false;
    bus_.handle(std::chrono::milliseconds(10));
  }
  return true;
}

const service_status_t* LiveListener::status(const std::string& service) const {
  const auto found = statuses_.find(service);
  return found == statuses_.end() ? nullptr : &found->second;
}

std::int64_t LiveListener::counter(const std::string& service, const std::string& name) const {
  const service_status_t* its = status(service);
  if (its == nullptr) throw std::runtime_error(service + " has not spoken");
  const auto count = test::counter(*its, name);
  if (!count) throw std::runtime_error("the STATUS of " + service + " does not have " + name);
  return *count;
}

void LiveListener::hear(const puck_estimate_t& estimate) {
  if (estimates_.heard == 0) {
    estimates_.first_seq = estimate.seq;
    estimates_.first_utime = estimate.utime;
  }
  ++estimates_.heard;
  if (estimate.state == puck_estimate_t::STATE_TRACKING) ++estimates_.tracking;
  if (estimate.event_utime != 0 && estimate.sensor_us != estimates_.newest.sensor_us) {
    const std::int64_t age_us = estimate.utime - estimate.event_utime;
    estimates_.oldest_us = std::max(estimates_.oldest_us, age_us);
    if (age_us > EstimateTally::kOldUs) estimates_.last_old_utime = estimate.utime;
  }
  estimates_.newest = estimate;
}

}  // namespace puck
