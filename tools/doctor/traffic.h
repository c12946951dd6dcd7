#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/datagram.h"
#include "puck/service_status_t.hpp"

namespace puck {

/// Where a datagram came from.
struct Source {
  std::string address;  ///< Dotted.
  int port = 0;

  auto operator<=>(const Source&) const = default;
};

/// A datagram on the bus's port.
struct ReceivedDatagram {
  Source source;
  std::optional<int> ttl;  ///< Hops that it had left when it came.
  std::int64_t utime = 0;  ///< When it came, CLOCK_REALTIME, µs.
  std::span<const std::uint8_t> bytes;
};

/// What one source sent. Everything in it that a stranger may choose is bounded.
struct SenderAccount {
  std::int64_t datagrams = 0;
  std::size_t largest_bytes = 0;
  std::optional<int> ttl;  ///< Of the newest.

  std::int64_t ours = 0;             ///< Valid messages on our channels under our prefix.
  std::int64_t malformed = 0;        ///< On our channels, but rejected.
  std::string last_malformed;        ///< Channel and why.
  std::int64_t sealed = 0;           ///< Sealed with a key, where we have none.
  std::int64_t unauthenticated = 0;  ///< Not sealed with the key that we have.
  std::string last_unauthenticated;
  std::int64_t other_prefix = 0;  ///< On our channels under another prefix.
  std::int64_t foreign = 0;       ///< LCM, but channels that are not ours.
  std::int64_t fragments = 0;     ///< Parts of messages too large for a datagram.
  std::int64_t not_lcm = 0;
  std::int64_t broken = 0;  ///< Begins as LCM does, but is none: liblcm may crash on such.
  std::string last_broken;

  std::set<std::string> channels;  ///< Printable; the first few.
};

/// A run of a service that spoke.
struct HeardService {
  Source source;
  service_status_t status;  ///< The newest; checked, so its text is printable.
  std::int64_t heard_utime = 0;
  /// Least of receipt minus `utime`: the time on the way, plus what the host's clock is behind.
  std::int64_t least_age_us = 0;
};

/// Takes the seal off a message on a channel: the plain message, or nothing and why it is not good.
using OpenSeal = std::function<std::optional<std::span<const std::uint8_t>>(
    std::string_view channel, std::span<const std::uint8_t> message, std::string& problem)>;
/// With a bus's key. Throws BusError where it cannot be used.
OpenSeal open_seals_with(const std::string& key_file);

/// Accounts for everything that comes to the bus's port. Takes any bytes; its memory is bounded
/// whatever comes. One thread.
class Traffic {
 public:
  static constexpr std::size_t kMaxSenders = 64;
  static constexpr std::size_t kMaxServices = 64;
  static constexpr std::size_t kMaxChannels = 16;  ///< Names kept of one sender.
  static constexpr std::size_t kMaxPrefixes = 8;

  /// `open_seal`: where the bus has a key.
  explicit Traffic(std::string prefix, OpenSeal open_seal = {})
      : prefix_(std::move(prefix)), open_seal_(std::move(open_seal)) {}

  /// The STATUS in it, if it holds a valid one of a service under our prefix.
  const HeardService* add(const ReceivedDatagram& datagram);

  const std::map<Source, SenderAccount>& senders() const { return senders_; }
  /// Under our prefix, by session.
  const std::map<std::int64_t, HeardService>& services() const { return services_; }
  /// Other prefixes under which services spoke; "" is none.
  const std::set<std::string>& other_prefixes() const { return other_prefixes_; }
  /// Whether messages came that are sealed with a key, where we have none.
  bool is_sealed() const { return is_sealed_; }
  /// Datagrams of senders beyond the first kMaxSenders.
  std::int64_t uncounted() const { return uncounted_; }

 private:
  const HeardService* add_message(const ReceivedDatagram& datagram, const WholeMessage& message,
                                  SenderAccount& sender);
  std::optional<std::span<const std::uint8_t>> take(Channel channel, const WholeMessage& message,
                                                    SenderAccount& sender);
  const HeardService* add_status(const ReceivedDatagram& datagram,
                                 std::span<const std::uint8_t> payload);

  std::string prefix_;
  OpenSeal open_seal_;
  bool is_sealed_ = false;
  std::map<Source, SenderAccount> senders_;
  std::map<std::int64_t, HeardService> services_;
  std::set<std::string> other_prefixes_;
  std::int64_t uncounted_ = 0;
};

}  // namespace puck
