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

/// Origin of a datagram.
struct Source {
  std::string address;  ///< IPv4, dotted decimal.
  int port = 0;

  auto operator<=>(const Source&) const = default;
};

/// A datagram on the bus's port.
struct ReceivedDatagram {
  Source source;
  std::optional<int> ttl;  ///< Remaining hops on arrival.
  std::int64_t utime = 0;  ///< Arrival, CLOCK_REALTIME, µs.
  std::span<const std::uint8_t> bytes;
};

/// The datagrams of one source. All values that a foreign sender can choose are bounded.
struct SenderAccount {
  std::int64_t datagrams = 0;
  std::size_t largest_bytes = 0;
  std::optional<int> ttl;  ///< Of the newest datagram.

  std::int64_t ours = 0;             ///< Valid messages on PUCK channels under our prefix.
  std::int64_t malformed = 0;        ///< Rejected messages on PUCK channels.
  std::string last_malformed;        ///< Channel and reason.
  std::int64_t sealed = 0;           ///< Sealed messages, if we have no key.
  std::int64_t unauthenticated = 0;  ///< Messages not sealed with our key.
  std::string last_unauthenticated;
  std::int64_t other_prefix = 0;  ///< On PUCK channels under another prefix.
  std::int64_t foreign = 0;       ///< LCM messages on other channels.
  std::int64_t fragments = 0;     ///< Parts of messages larger than a datagram.
  std::int64_t not_lcm = 0;
  std::int64_t broken = 0;  ///< Malformed LCM datagrams, which can crash liblcm.
  std::string last_broken;

  std::set<std::string> channels;  ///< Printable; the first few.
};

/// A run of a service that sent STATUS.
struct HeardService {
  Source source;
  service_status_t status;  ///< The newest; validated, so its text is printable.
  std::int64_t heard_utime = 0;
  /// Minimum of receipt minus `utime`: latency plus how far the host's clock is behind ours.
  std::int64_t least_age_us = 0;
};

/// Opens a sealed message of a channel: the plain message, or nothing and the reason.
using OpenSeal = std::function<std::optional<std::span<const std::uint8_t>>(
    std::string_view channel, std::span<const std::uint8_t> message, std::string& problem)>;
/// With a bus's key. Throws BusError if the key is unusable.
OpenSeal open_seals_with(const std::string& key_file);

/// Counts all datagrams to the bus's port. Accepts any bytes in bounded memory. One thread.
class Traffic {
 public:
  static constexpr std::size_t kMaxSenders = 64;
  static constexpr std::size_t kMaxServices = 64;
  static constexpr std::size_t kMaxChannels = 16;  ///< Names kept for each sender.
  static constexpr std::size_t kMaxPrefixes = 8;

  /// `open_seal`: if the bus has a key.
  explicit Traffic(std::string prefix, OpenSeal open_seal = {})
      : prefix_(std::move(prefix)), open_seal_(std::move(open_seal)) {}

  /// Returns the service of a valid STATUS under our prefix, else null.
  const HeardService* add(const ReceivedDatagram& datagram);

  const std::map<Source, SenderAccount>& senders() const { return senders_; }
  /// Under our prefix, by session.
  const std::map<std::int64_t, HeardService>& services() const { return services_; }
  /// Other prefixes of services; "" is no prefix.
  const std::set<std::string>& other_prefixes() const { return other_prefixes_; }
  /// Whether sealed messages arrived although we have no key.
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
