#include "common/messaging/memory_transport.h"

#include <algorithm>

#include "common/messages/host_time.h"

namespace puck {
namespace {

using Clock = std::chrono::steady_clock;

// Ample for a test that pauses for a moment.
constexpr std::size_t kMostWaitingBytes = std::size_t{256} << 20;

bool is_heard(const Listening& listening, const std::string& channel) {
  if (listening.all) return channel.starts_with(listening.beginning);
  return std::find(listening.channels.begin(), listening.channels.end(), channel) !=
         listening.channels.end();
}

}  // namespace

std::optional<std::string> MemoryTransport::send(const std::string& channel,
                                                 std::span<const std::uint8_t> payload) {
  {
    const std::lock_guard lock(mutex_);
    if (!is_heard(listening_, channel)) return std::nullopt;
    // A full queue loses messages, like a network.
    if (waiting_bytes_ + payload.size() > kMostWaitingBytes) return std::nullopt;
    waiting_bytes_ += payload.size();
    waiting_.push_back(
        {channel, {payload.begin(), payload.end()}, host_utime(), host_monotonic_us(), false});
  }
  came_.notify_one();
  return std::nullopt;
}

void MemoryTransport::listen(const Listening& listening) {
  const std::lock_guard lock(mutex_);
  listening_ = listening;
}

int MemoryTransport::receive(std::chrono::microseconds timeout, std::chrono::microseconds longest,
                             const Receive& receive) {
  int received = 0;
  auto end = Clock::time_point::max();
  while (const auto message = take(timeout)) {
    receive({message->channel,
             message->payload,
             {},
             message->utime,
             message->monotonic_us,
             message->more_waiting});
    if (received++ == 0) end = Clock::now() + longest;
    if (Clock::now() >= end) break;
    timeout = {};
  }
  return received;
}

std::optional<MemoryTransport::Waiting> MemoryTransport::take(std::chrono::microseconds timeout) {
  std::unique_lock lock(mutex_);
  if (!came_.wait_for(lock, timeout, [this] { return !waiting_.empty(); })) return std::nullopt;
  Waiting message = std::move(waiting_.front());
  waiting_.pop_front();
  waiting_bytes_ -= message.payload.size();
  message.more_waiting = !waiting_.empty();
  return message;
}

}  // namespace puck
