#include "common/messaging/status_reporter.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <unistd.h>

#include "common/messages/host_time.h"
#include "common/messaging/datagram.h"
#include "common/messaging/event_packing.h"

namespace puck {
namespace {

constexpr std::int64_t kPeriodUs = 100'000;
// Shortest period of STATUS, also in a flood of new runs.
constexpr std::int64_t kShortestPeriodUs = 20'000;
// Limit of STATUS on the wire; receivers reject a message with a longer text.
constexpr std::size_t kMaxTextBytes = 255;
constexpr std::size_t kFrameBytes = EventPackerParams::kOneFrame;

/// Bytes on the wire: the name's length, the name, its NUL, and the value.
std::size_t counter_bytes(std::string_view name) { return 4 + name.size() + 1 + 8; }

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

/// Text as a single line within the limits of the wire.
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

std::optional<std::int64_t> PeerStatus::counter(std::string_view name) const {
  const auto found = std::find(counter_names.begin(), counter_names.end(), name);
  if (found == counter_names.end()) return std::nullopt;
  return counter_values[static_cast<std::size_t>(found - counter_names.begin())];
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
  // The text may hold a number that changes all the time, so it waits for the period.
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

void StatusReporter::set_trouble_of_peers(ServiceState state, std::string text) {
  text = one_line(std::move(text));
  if (state == peers_state_ && text == peers_text_) return;
  peers_state_ = state;
  peers_text_ = std::move(text);
  changed_ = true;
}

ServiceState StatusReporter::published_state() const {
  const bool runs = state_ == ServiceState::kRunning || state_ == ServiceState::kWaiting;
  if (peers_text_.empty() || !runs) return state_;
  return state_ == ServiceState::kRunning ? peers_state_ : std::max(state_, peers_state_);
}

std::string StatusReporter::published_text() const {
  if (peers_text_.empty() || state_ == ServiceState::kStopping) return state_text_;
  return one_line(state_text_.empty() ? peers_text_ : peers_text_ + "; " + state_text_);
}

SenderClock StatusReporter::clock_of(std::int64_t session) const {
  if (session == bus_.session()) return ClockOffset{};
  return clocks_.offset_of(session, host_now());
}

void StatusReporter::hear(const service_status_t& status, const Receipt& receipt) {
  if (!receipt.in_order() || status.session == bus_.session()) return;
  read_pongs(status, receipt);
  // An early answer gives the new run our clock soon.
  if (pongs_.hear(status, receipt)) due_us_ = std::min(due_us_, soonest_us_);
  if (listeners_.empty()) return;
  const PeerStatus peer{.session = status.session,
                        .service = status.service,
                        .host = status.host,
                        .pid = status.pid,
                        .state = static_cast<ServiceState>(status.state),
                        .state_text = status.state_text,
                        .utime = status.utime,
                        .counter_names = status.counter_name,
                        .counter_values = status.counter_value};
  for (const Listener& listener : listeners_) listener(peer, receipt);
}

void StatusReporter::read_pongs(const service_status_t& status, const Receipt& receipt) {
  for (std::size_t i = 0; i < status.pong_session.size(); ++i) {
    if (status.pong_session[i] != bus_.session()) continue;
    clocks_.add(status.session, {status.pong_utime[i], status.pong_received_utime[i], status.utime,
                                 receipt.monotonic_us});
  }
}

void StatusReporter::publish(const Fill& fill) {
  const std::int64_t now_us = host_monotonic_us();
  changed_ = false;
  due_us_ = now_us + kPeriodUs;
  soonest_us_ = now_us + kShortestPeriodUs;

  StatusReport report;
  fill(report);
  service_status_t message{};
  message.service = service_;
  message.host = host_;
  message.pid = static_cast<std::int32_t>(getpid());
  message.version = PUCK_VERSION;
  message.state = static_cast<std::int8_t>(published_state());
  message.state_text = published_text();
  message.uptime_us = now_us - started_us_;
  for (StatusLatency& latency : report.latencies) {
    message.latency_name.push_back(std::move(latency.name));
    message.latency_p50_us.push_back(latency.p50_us);
    message.latency_p99_us.push_back(latency.p99_us);
    message.latency_max_us.push_back(latency.max_us);
    message.latency_samples.push_back(latency.samples);
  }
  if (pongs_.answer(message)) due_us_ = soonest_us_;
  fill_counters(message, std::move(report));
  // Before the bus reads its clock, so that a round trip is never too short.
  const std::int64_t sent_us = host_monotonic_us();
  bus_.publish(message);
  clocks_.ping({message.utime, sent_us});
}

// A message of two frames is lost with either frame, so counters are left out to fit one.
void StatusReporter::fill_counters(service_status_t& message, StatusReport report) const {
  set_counts(message);
  const std::size_t others =
      kLcmHeaderBytes + channel_name(Channel::kStatus, bus_.prefix()).size() + 1 +
      bus_.overhead_bytes() + static_cast<std::size_t>(message.getEncodedSize());
  std::size_t room = kFrameBytes - std::min(kFrameBytes, others);
  std::size_t wanted = 0;
  for (auto& [name, value] : report.counters) {
    name = one_line(std::move(name));
    wanted += counter_bytes(name);
  }
  if (wanted > room) room -= std::min(room, counter_bytes(kLeftOut));
  const auto add = [&](std::string name, std::int64_t value) {
    message.counter_name.push_back(std::move(name));
    message.counter_value.push_back(value);
  };
  std::int64_t left_out = std::ssize(report.counters);
  for (auto& [name, value] : report.counters) {
    if (counter_bytes(name) > room) continue;  // A shorter name may still fit.
    room -= counter_bytes(name);
    add(std::move(name), value);
    --left_out;
  }
  if (left_out > 0) add(kLeftOut, left_out);
}

}  // namespace puck
