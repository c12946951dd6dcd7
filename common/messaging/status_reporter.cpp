#include "common/messaging/status_reporter.h"

#include <algorithm>
#include <array>

#include <unistd.h>

#include "common/messaging/host_time.h"

namespace puck {
namespace {

constexpr std::int64_t kPeriod_us = 100'000;
// A pong older than this says nothing new about a clock; its publisher is gone.
constexpr std::int64_t kPongLife_us = 2'000'000;
constexpr std::size_t kMaxPongs = 64;
constexpr std::size_t kMaxTextBytes = 255;

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

/// One line that the rules for text on the wire let pass.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  if (text.size() > kMaxTextBytes) text.resize(kMaxTextBytes);
  return text;
}

}  // namespace

const char* to_string(ServiceState state) {
  switch (state) {
    case ServiceState::kStarting:
      return "starting";
    case ServiceState::kRunning:
      return "running";
    case ServiceState::kWaiting:
      return "waiting";
    case ServiceState::kDegraded:
      return "degraded";
    case ServiceState::kStopping:
      return "stopping";
  }
  return "unknown";
}

StatusReporter::StatusReporter(Bus& bus, std::string service)
    : bus_(bus),
      service_(std::move(service)),
      host_(one_line(host_name())),
      started_us_(host_monotonic_us()) {
  bus_.subscribe<service_status_t>(
      [this](const service_status_t& status, const Receipt& receipt) { hear(status, receipt); });
}

void StatusReporter::set_state(ServiceState state, std::string text) {
  text = one_line(std::move(text));
  if (state == state_ && text == state_text_) return;
  // The text alone may hold a number that changes all the time: it waits for its turn.
  changed_ = changed_ || state != state_;
  state_ = state;
  state_text_ = std::move(text);
}

void StatusReporter::poll(const Fill& fill) {
  if (changed_ || host_monotonic_us() >= due_us_) publish(fill);
}

void StatusReporter::stop(const Fill& fill) {
  set_state(ServiceState::kStopping);
  publish(fill);
}

void StatusReporter::hear(const service_status_t& status, const Receipt& receipt) {
  if (!receipt.in_order() || status.session == bus_.session()) return;
  const Pong pong{status.session, status.utime, receipt.utime, receipt.monotonic_us};
  const auto known = std::find_if(pongs_.begin(), pongs_.end(), [&](const Pong& other) {
    return other.session == status.session;
  });
  if (known != pongs_.end()) {
    *known = pong;
  } else if (pongs_.size() < kMaxPongs) {
    pongs_.push_back(pong);
  }
}

void StatusReporter::publish(const Fill& fill) {
  const std::int64_t now_us = host_monotonic_us();
  changed_ = false;
  due_us_ = now_us + kPeriod_us;

  StatusReport report;
  fill(report);
  service_status_t message{};
  message.service = service_;
  message.host = host_;
  message.pid = static_cast<std::int32_t>(getpid());
  message.version = PUCK_VERSION;
  message.state = static_cast<std::int8_t>(state_);
  message.state_text = state_text_;
  message.uptime_us = now_us - started_us_;
  for (auto& [name, value] : report.counters) {
    message.counter_name.push_back(std::move(name));
    message.counter_value.push_back(value);
  }
  for (StatusLatency& latency : report.latencies) {
    message.latency_name.push_back(std::move(latency.name));
    message.latency_p50_us.push_back(latency.p50_us);
    message.latency_p99_us.push_back(latency.p99_us);
    message.latency_max_us.push_back(latency.max_us);
    message.latency_samples.push_back(latency.samples);
  }
  fill_pongs(message);
  bus_.publish(message);
}

void StatusReporter::fill_pongs(service_status_t& message) {
  const std::int64_t oldest_us = host_monotonic_us() - kPongLife_us;
  std::erase_if(pongs_, [&](const Pong& pong) { return pong.received_monotonic_us < oldest_us; });
  for (const Pong& pong : pongs_) {
    message.pong_session.push_back(pong.session);
    message.pong_utime.push_back(pong.utime);
    message.pong_received_utime.push_back(pong.received_utime);
  }
}

}  // namespace puck
