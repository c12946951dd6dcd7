#pragma once

#include <optional>
#include <string>

namespace puck {

/// LCM's usual group and port, this host only, with a socket buffer that takes bursts.
inline constexpr const char* kDefaultLcmUrl =
    "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304";

/// A checked LCM URL: `udpm://[GROUP][:PORT][?ttl=N&recv_buf_size=N]`, or `memq://` for tests.
struct LcmUrl {
  bool in_memory = false;  ///< memq://: messages stay within one Bus.
  std::string group = "239.255.76.67";
  int port = 7667;
  int ttl = 0;                       ///< Hops: 0: this host, 1: its local network.
  std::optional<int> recv_buf_size;  ///< Requested size, bytes; empty: the kernel's default.

  /// URL in LCM's own form.
  std::string to_string() const;
};

/// Throws BusError also for a URL that LCM would misread or silently ignore.
LcmUrl parse_lcm_url(const std::string& url);

}  // namespace puck
