#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

/// Sender of a datagram according to the network. Not authenticated: that takes a key.
struct Sender {
  std::uint32_t address = 0;  ///< IPv4, host byte order; 0: this process.
  std::uint16_t port = 0;

  bool operator==(const Sender&) const = default;
};

/// `172.18.0.3:40000`, or `this process`.
std::string to_string(const Sender& sender);

/// A received message: its channel name is well formed, all else is unchecked. Valid during the
/// call that passes it.
struct ArrivedMessage {
  std::string_view channel;
  std::span<const std::uint8_t> payload;
  Sender sender;
  std::int64_t utime = 0;         ///< The kernel's time of receipt, CLOCK_REALTIME, µs.
  std::int64_t monotonic_us = 0;  ///< The same by CLOCK_MONOTONIC.
  bool more_waiting = false;      ///< Other received messages wait behind it.
};

/// The messages to receive. Others cost only a look at their first bytes.
struct Listening {
  std::string beginning;              ///< Beginning of our channel names: LEFT_PUCK_.
  bool all = false;                   ///< All of our channels; else only `channels`.
  std::vector<std::string> channels;  ///< Full names.
};

/// A kind of foreign datagrams on our group and port.
struct ForeignTraffic {
  std::string what;  ///< `channel "RIGHT_PUCK_EVENTS"`, `not LCM datagrams`, …
  Sender sender;     ///< The first sender of this kind.
  std::int64_t datagrams = 0;
};

struct TransportCounters {
  std::int64_t malformed = 0;  ///< Datagrams on our channels without a valid message.
  std::string last_malformed;
  /// Foreign datagrams, and fragments while refused. In a flood only those that were read.
  std::int64_t foreign = 0;
  std::vector<ForeignTraffic> foreign_traffic;  ///< The first 32 kinds.
  std::int64_t rejoined = 0;                    ///< Times that a lost network was joined again.
};

/// Transports messages as bytes, without knowing their meaning. One thread receives, one at a time
/// sends.
class Transport {
 public:
  using Receive = std::function<void(const ArrivedMessage&)>;

  virtual ~Transport() = default;

  /// Nothing on success, else the reason.
  virtual std::optional<std::string> send(const std::string& channel,
                                          std::span<const std::uint8_t> payload) = 0;

  virtual void listen(const Listening& listening) = 0;

  /// Waits up to `timeout` for a message, then passes on all waiting ones, for up to `longest`.
  /// Returns their number. `receive` must not throw.
  virtual int receive(std::chrono::microseconds timeout, std::chrono::microseconds longest,
                      const Receive& receive) = 0;

  /// Receiving thread only.
  virtual const TransportCounters& counters() const = 0;
};

}  // namespace puck
