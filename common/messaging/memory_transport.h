#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>

#include "common/messaging/transport.h"

namespace puck {

/// Returns messages to the object that sent them, for tests without a network. Send from any
/// thread.
class MemoryTransport : public Transport {
 public:
  std::optional<std::string> send(const std::string& channel,
                                  std::span<const std::uint8_t> payload) override;
  void listen(const Listening& listening) override;
  int receive(std::chrono::microseconds timeout, std::chrono::microseconds longest,
              const Receive& receive) override;
  const TransportCounters& counters() const override { return counters_; }

 private:
  struct Waiting {
    std::string channel;
    std::vector<std::uint8_t> payload;
    std::int64_t utime = 0;
    std::int64_t monotonic_us = 0;
    bool more_waiting = false;  // set when it is taken
  };

  std::optional<Waiting> take(std::chrono::microseconds timeout);

  // Guards all members below except the counters.
  std::mutex mutex_;
  std::condition_variable came_;
  Listening listening_;
  std::deque<Waiting> waiting_;
  std::size_t waiting_bytes_ = 0;

  TransportCounters counters_;  // always 0: there are no other senders
};

}  // namespace puck
