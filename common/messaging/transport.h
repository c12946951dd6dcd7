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

/// Who sent a datagram, as the network says. Nobody proves it: only a key does.
struct Sender {
  std::uint32_t address = 0;  ///< IPv4, host byte order; 0: this process.
  std::uint16_t port = 0;

  bool operator==(const Sender&) const = default;
};

/// `172.18.0.3:40000`, or `this process`.
std::string to_string(const Sender& sender);

/// A message as it came: the name of its channel is well formed, nothing else is known of it. Valid
/// during the call that hands it over.
struct ArrivedMessage {
  std::string_view channel;
  std::span<const std::uint8_t> payload;
  Sender sender;
  std::int64_t utime = 0;         ///< When the kernel had it, CLOCK_REALTIME, µs.
  std::int64_t monotonic_us = 0;  ///< The same by CLOCK_MONOTONIC.
  bool more_waiting = false;      ///< Others that have come wait behind it.
};

/// What shall be heard. All else costs nothing but a look at its first bytes.
struct Listening {
  std::string beginning;              ///< Ours are the channels that begin so: LEFT_PUCK_.
  bool all = false;                   ///< All of ours; else only `channels`.
  std::vector<std::string> channels;  ///< Full names.
};

/// Somebody else at our group and port, who did not mean us.
struct ForeignTraffic {
  std::string what;  ///< `channel "RIGHT_PUCK_EVENTS"`, `not LCM datagrams`, …
  Sender sender;     ///< The first that was seen with it.
  std::int64_t datagrams = 0;
};

struct TransportCounters {
  std::int64_t malformed = 0;  ///< Addressed to us, but not even a message.
  std::string last_malformed;
  /// Not for us, or in fragments that are refused. Of a flood of them, as many as were looked at.
  std::int64_t foreign = 0;
  std::vector<ForeignTraffic> foreign_traffic;  ///< The first 32 kinds.
  std::int64_t rejoined = 0;                    ///< Came back to a network that had gone.
};

/// Carries messages as bytes. Neither knows nor checks what they mean. One thread receives, one at
/// a time sends.
class Transport {
 public:
  using Receive = std::function<void(const ArrivedMessage&)>;

  virtual ~Transport() = default;

  /// Nothing when it was sent, else why not.
  virtual std::optional<std::string> send(const std::string& channel,
                                          std::span<const std::uint8_t> payload) = 0;

  virtual void listen(const Listening& listening) = 0;

  /// Waits up to `timeout` for a message, then hands over all that are there, for up to `longest`.
  /// Returns how many. `receive` must not throw.
  virtual int receive(std::chrono::microseconds timeout, std::chrono::microseconds longest,
                      const Receive& receive) = 0;

  /// Receiving thread only.
  virtual const TransportCounters& counters() const = 0;
};

}  // namespace puck
