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
  std::string prefix{};  ///< Key lcm.prefix: with LEFT, channels are called LEFT_PUCK_…
  /// Key lcm.allow_fragments: send and accept messages of several datagrams. No PUCK message needs
  /// it, and one lost datagram then loses the whole message.
  bool allow_fragments = false;
  /// Key lcm.key_file: secret key. All messages are sealed with it, and others are dropped. Empty:
  /// no key.
  std::string key_file{};
};

/// Counters of one channel since the Bus was made.
struct ChannelCounters {
  std::string channel;
  LossCounters arrivals;              ///< Of valid messages.
  std::int64_t received_bytes = 0;    ///< Of all messages, valid or not.
  std::int64_t rejected = 0;          ///< Malformed messages, dropped.
  std::int64_t oversize = 0;          ///< Messages too large for their type, dropped unread.
  std::int64_t unauthenticated = 0;   ///< Messages not sealed with our key, dropped unread.
  std::string last_rejection;         ///< Reason and sender of the newest message dropped.
  std::int64_t handler_failures = 0;  ///< Messages whose handler threw an exception.
  std::string last_handler_failure;
  std::int64_t published = 0;         ///< Numbered messages, sent or not.
  std::int64_t publish_failures = 0;  ///< Messages numbered but not sent.
  std::string last_publish_failure;
};

/// The only user of LCM. Checks every received message completely before a handler gets it, adds
/// session and number to published messages, and counts losses. Joins the network again after an
/// interruption. Neither copied nor moved.
///
/// A Message is one of LCM's types or, with conversions.h, one of common/messages.
///
/// Subscribe first, then start(), then call handle() in a loop on one thread. Handlers run on this
/// thread; they may publish but not subscribe.
class Bus {
 public:
  /// Throws BusError, with one line of text, for a malformed URL or prefix. Opens nothing yet.
  explicit Bus(const BusParams& params);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// Waits for a network, then joins. Meanwhile calls `on_waiting` with the reason, at once and
  /// then every 5 s. Returns false after a stop request.
  bool start(std::stop_token stop, const std::function<void(const std::string&)>& on_waiting);

  /// Calls `handler` with every valid message of this type under the prefix. Exceptions of a
  /// handler are counted. Handlers of one type are called in the order of their subscription.
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
  /// Calls `handler` with every message on every channel under the prefix, unchecked and with
  /// arrival kNewest, for logging. The views are valid during the call.
  void subscribe_all(RawHandler handler);

  /// Fills in utime, session, seq and array lengths, and sends. Returns false, and counts, if the
  /// message breaks a rule of its type or could not be sent; for receivers its number is then lost.
  /// Safe from any thread.
  template <typename Message>
  bool publish(Message& message) {
    return send(kChannelOf<Message>, [&](MessageHeader header, std::vector<std::uint8_t>& buffer) {
      message.utime = header.utime;
      message.session = header.session;
      message.seq = header.seq;
      encode(message, buffer);
    });
  }

  /// Waits up to `timeout` for a message, then handles all waiting ones, for up to `longest`.
  /// Returns their number. A signal ends the wait. One thread.
  int handle(std::chrono::microseconds timeout,
             std::chrono::microseconds longest = std::chrono::milliseconds(50));

  /// Random, never 0: identifies this run on the wire. Safe from any thread.
  std::int64_t session() const;
  /// Publishes from now on as another run: a new session, and numbers from 0 on every channel. Call
  /// it on the thread of handle(). Receivers follow it once the previous session has been silent
  /// for SinglePublisher::kSilentAfterUs.
  void begin_session();
  const std::string& prefix() const;
  const LcmUrl& url() const;
  /// Whether there is a key, so that only messages sealed with it are accepted.
  bool is_authenticated() const;
  /// Bytes of a datagram besides the channel name and the message.
  std::size_t overhead_bytes() const;

  /// Counters of one channel; zeros without a subscription or a published message. Safe from any
  /// thread.
  ChannelCounters counters(Channel channel) const;
  template <typename Message>
  ChannelCounters counters() const {
    return counters(kChannelOf<Message>);
  }
  /// Unauthenticated messages on unknown channels under the prefix; counts nothing else. Safe from
  /// any thread.
  ChannelCounters unknown_channels() const;
  /// Counters of datagrams that belong to no PUCK channel. Safe from any thread.
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
