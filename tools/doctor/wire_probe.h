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
  std::string key_file;  ///< STATUS is sealed with it; empty: with nothing.
};

/// Sends what the doctor has to say on the bus: valid LCM, on a channel that nobody subscribes to
/// and as a STATUS like any other, so that nothing that runs is disturbed. One thread.
class WireProbe {
 public:
  /// Throws ListenError, or BusError where the key cannot be used.
  explicit WireProbe(const WireProbeParams& params);
  WireProbe(const WireProbe&) = delete;
  WireProbe& operator=(const WireProbe&) = delete;

  /// Random: tells our datagrams from those of another doctor.
  std::int64_t session() const { return session_; }
  /// Where our datagrams come from on this host.
  int port() const { return port_; }

  /// What cannot be sent does not come back, which is what is counted.
  void send_self_test();
  bool is_self_test(std::span<const std::uint8_t> datagram) const;

  /// Its `utime`: the services answer it with pongs.
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
