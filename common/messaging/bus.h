#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "common/messaging/bus_error.h"
#include "common/messaging/channels.h"
#include "common/messaging/lcm_url.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/receipt.h"
#include "common/messaging/transport.h"

namespace puck {

struct BusParams {
  std::string url = kDefaultLcmUrl;  ///< Key lcm.url.
  std::string prefix{};              ///< Key lcm.prefix: LEFT makes every channel LEFT_PUCK_…
  /// Key lcm.allow_fragments: send and take messages that need several datagrams. None of ours
  /// does, and the loss of one datagram is then the loss of many.
  bool allow_fragments = false;
  /// Key lcm.key_file: a secret; then everything sent is sealed with it, and what is not sealed
  /// with it is not heard. Empty: none.
  std::string key_file{};
};

/// What came and went on one channel since the Bus was made.
struct ChannelCounters {
  std::string channel;
  LossCounters arrivals;              ///< Of the valid messages.
  std::int64_t received_bytes = 0;    ///< All bytes that came, valid or not.
  std::int64_t rejected = 0;          ///< Malformed, dropped.
  std::int64_t oversize = 0;          ///< Larger than its type can be, dropped unread.
  std::int64_t unauthenticated = 0;   ///< Not sealed with the key that is needed, dropped unread.
  std::string last_rejection;         ///< Why the newest of these was dropped, and who sent it.
  std::int64_t handler_failures = 0;  ///< A handler threw: that message was not dealt with.
  std::string last_handler_failure;
  std::int64_t published = 0;         ///< Messages numbered, sent or not.
  std::int64_t publish_failures = 0;  ///< Of these: not sent.
  std::string last_publish_failure;
};

/// The one place that talks LCM. Subscribes to messages that are checked whole before any handler
/// sees them, publishes messages that carry session and number, and counts what is lost. Hears
/// again by itself when the network was away. Neither copied nor moved.
///
/// Subscribe first, then start(), then one thread calls handle() in a loop; handlers run on it and
/// may publish but not subscribe.
class Bus {
 public:
  /// Throws BusError with one clear line for a malformed URL or prefix. Opens nothing yet.
  explicit Bus(const BusParams& params);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Waits for a way to the network, then joins. While it waits it calls `on_waiting` with the
  /// reason, at once and then every 5 s. False when a stop was requested meanwhile.
  bool start(std::stop_token stop, const std::function<void(const std::string&)>& on_waiting);

  /// Every valid message of this type under the prefix goes to `handler`. What it throws is
  /// counted. Several handlers of one type are called in the order in which they subscribed.
  template <typename Message>
  void subscribe(std::function<void(const Message&, const Receipt&)> handler) {
    add_handler(kChannelOf<Message>,
                [handler = std::move(handler)](std::span<const std::uint8_t> bytes,
                                               const Receipt& receipt) {
                  Message message;
                  decode_checked(bytes, message);
                  handler(message, receipt);
                });
  }

  using RawHandler = std::function<void(std::string_view channel,
                                        std::span<const std::uint8_t> bytes, const Receipt&)>;
  /// Every message on every channel under the prefix, unchecked and with arrival kNewest: for
  /// logging. The views live as long as the call.
  void subscribe_all(RawHandler handler);

  /// Fills in utime, session and seq, and the lengths of arrays, and sends. False, and counted,
  /// when the message breaks a rule of its type or could not be sent; its number is then missing
  /// for the receivers, as a lost one is. Safe from any thread.
  template <typename Message>
  bool publish(Message& message) {
    return send(kChannelOf<Message>, [&](MessageHeader header, std::vector<std::uint8_t>& buffer) {
      message.utime = header.utime;
      message.session = header.session;
      message.seq = header.seq;
      encode(message, buffer);
    });
  }

  /// Waits up to `timeout` for a message, then handles all that are there, for up to `longest`.
  /// Returns how many. Returns early when a signal comes. One thread.
  int handle(std::chrono::microseconds timeout,
             std::chrono::microseconds longest = std::chrono::milliseconds(50));

  /// Random, never 0: the id of this run on the wire.
  std::int64_t session() const;
  const std::string& prefix() const;
  const LcmUrl& url() const;
  /// Whether there is a key, so that only those who have it are heard.
  bool is_authenticated() const;
  /// What a message takes in its datagram besides its channel and itself.
  std::size_t overhead_bytes() const;

  /// Of one channel; all zeros where there is no subscription and nothing was published. Safe from
  /// any thread.
  ChannelCounters counters(Channel channel) const;
  template <typename Message>
  ChannelCounters counters() const {
    return counters(kChannelOf<Message>);
  }
  /// Of messages on channels under the prefix that are none of ours: only those without the key
  /// that is needed are counted. Safe from any thread.
  ChannelCounters unknown_channels() const;
  /// Of what belongs to no channel of ours. Safe from any thread.
  TransportCounters network_counters() const;

 private:
  using CheckedHandler = std::function<void(std::span<const std::uint8_t> bytes, const Receipt&)>;
  using Encoder = std::function<void(MessageHeader, std::vector<std::uint8_t>& buffer)>;

  void add_handler(Channel channel, CheckedHandler handler);
  bool send(Channel channel, const Encoder& encode_with);

  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace puck
