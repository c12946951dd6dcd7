#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <lcm/lcm.h>

#include "common/messages/host_time.h"
#include "common/messaging/bus.h"

namespace puck {

/// A session on another machine, with a clock unlike ours: stamps its messages, publishes STATUS
/// and answers pings by that clock. One thread.
class SkewedMachine {
 public:
  /// Its clock is ahead of this host's by `ahead_us`. Throws std::runtime_error without a route to
  /// the network.
  SkewedMachine(const std::string& url, std::int64_t session, std::int64_t ahead_us,
                std::string service = "puck-elsewhere")
      : service_(std::move(service)),
        session_(session),
        ahead_us_(ahead_us),
        lcm_(lcm_create(url.c_str()), &lcm_destroy),
        bus_({.url = url}) {
    bus_.subscribe<service_status_t>([this](const service_status_t& status, const Receipt& at) {
      if (status.session == session_) return;
      heard_[status.session] = {status.utime, at.utime};
      if (heard_.size() > kMostAnswered) heard_.erase(longest_silent());
    });
    if (!lcm_ || !bus_.start({}, [](const std::string&) {})) {
      throw std::runtime_error("no way to the network");
    }
  }

  std::int64_t session() const { return session_; }
  std::int64_t utime() const { return host_utime() + ahead_us_; }
  /// Whether it answers the STATUS of others.
  void answer(bool answers) { answers_ = answers; }

  /// Stamps and sends, `age_us` after the stated publication time.
  template <typename Message>
  void publish(Message message, std::int64_t age_us = 0) {
    message.utime = utime() - age_us;
    message.session = session_;
    message.seq = next_seq_[kChannelOf<Message>]++;
    encode(message, buffer_);
    lcm_publish(lcm_.get(), channel_name(kChannelOf<Message>, "").c_str(), buffer_.data(),
                static_cast<unsigned>(buffer_.size()));
  }

  /// Handles received messages, and publishes its STATUS every 20 ms.
  void serve() {
    bus_.handle(std::chrono::milliseconds(0));
    if (host_monotonic_us() < status_due_us_) return;
    status_due_us_ = host_monotonic_us() + 20'000;
    service_status_t status{};
    status.service = service_;
    status.host = "elsewhere";
    status.pid = 1;
    status.state = service_status_t::STATE_RUNNING;
    for (const auto& [session, times] : heard_) {
      if (!answers_) break;
      status.pong_session.push_back(session);
      status.pong_utime.push_back(times.sent_utime);
      status.pong_received_utime.push_back(times.received_utime + ahead_us_);
    }
    publish(status);
  }

 private:
  struct Times {
    std::int64_t sent_utime = 0;
    std::int64_t received_utime = 0;  // by our clock
  };
  using Heard = std::map<std::int64_t, Times>;  // by session

  // Below the limit of a STATUS message: receivers reject one with too many.
  static constexpr std::size_t kMostAnswered = 16;

  Heard::iterator longest_silent() {
    return std::min_element(heard_.begin(), heard_.end(), [](const auto& a, const auto& b) {
      return a.second.received_utime < b.second.received_utime;
    });
  }

  std::string service_;
  std::int64_t session_;
  std::int64_t ahead_us_;
  bool answers_ = true;
  std::unique_ptr<lcm_t, void (*)(lcm_t*)> lcm_;
  Bus bus_;
  Heard heard_;
  std::map<Channel, std::int64_t> next_seq_;
  std::int64_t status_due_us_ = 0;  // CLOCK_MONOTONIC
  std::vector<std::uint8_t> buffer_;
};

}  // namespace puck
