#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <netinet/in.h>

#include "common/messaging/lcm_url.h"
#include "common/messaging/message_seal.h"
#include "common/messaging/shared_key.h"
#include "common/posix/file_descriptor.h"
#include "puck/service_status_t.hpp"

namespace puck {

struct WireProbeParams {
  LcmUrl url;
  std::string prefix;
  std::string key_file;  ///< Seals STATUS; empty: not sealed.
};

/// Sends the doctor's messages: valid LCM on a channel without subscribers, and an ordinary STATUS,
/// so that no running service is disturbed. One thread.
class WireProbe {
 public:
  /// Throws ListenError, or BusError if the key is unusable.
  explicit WireProbe(const WireProbeParams& params);
  WireProbe(const WireProbe&) = delete;
  WireProbe& operator=(const WireProbe&) = delete;

  /// Random: distinguishes our datagrams from another doctor's.
  std::int64_t session() const { return session_; }
  /// Source port of our datagrams on this host.
  int port() const { return port_; }

  /// Ignores send errors: the test counts the datagrams that come back.
  void send_self_test();
  bool is_self_test(std::span<const std::uint8_t> datagram) const;

  /// Returns its `utime`, which the services answer with pongs.
  std::int64_t send_status(std::int8_t state);

 private:
  void send(std::string_view channel, std::span<const std::uint8_t> payload);

  std::string status_channel_;
  std::string test_channel_;
  std::int64_t session_;
  sockaddr_in group_;
  FileDescriptor socket_;
  int port_;
  std::uint32_t next_number_ = 0;
  std::int64_t next_status_seq_ = 0;
  std::int64_t started_us_;  // CLOCK_MONOTONIC
  std::optional<SharedKey> key_;
  std::optional<MessageSealer> sealer_;  // Refers to the key.
  std::vector<std::uint8_t> payload_;
  std::vector<std::uint8_t> datagram_;
};

}  // namespace puck
