#pragma once

#include <chrono>
#include <memory>

#include "common/messaging/datagram_queue.h"
#include "common/messaging/fragment_assembly.h"
#include "common/messaging/lcm_url.h"
#include "common/messaging/receive_socket.h"
#include "common/messaging/transport.h"

struct _lcm_t;

namespace puck {

struct UdpTransportParams {
  LcmUrl url;
  bool allow_fragments = false;  ///< Accept messages of several datagrams.
};

/// LCM's protocol over UDP multicast. liblcm only sends. Its receiver is replaced because it trusts
/// the bytes (two datagrams crash it), wakes another thread for every message, loses the newest
/// ones when its queue is full, and never receives again after a network failure.
///
/// Two sockets: one for our channels, and a small one for foreign datagrams, which wakes no thread,
/// so that they are counted without a delay.
class UdpTransport : public Transport {
 public:
  explicit UdpTransport(const UdpTransportParams& params);
  ~UdpTransport() override;
  UdpTransport(const UdpTransport&) = delete;
  UdpTransport& operator=(const UdpTransport&) = delete;

  /// Joins the group. Returns nothing on success, else the reason to wait.
  std::optional<std::string> open();

  std::optional<std::string> send(const std::string& channel,
                                  std::span<const std::uint8_t> payload) override;
  void listen(const Listening& listening) override;
  int receive(std::chrono::microseconds timeout, std::chrono::microseconds longest,
              const Receive& receive) override;
  const TransportCounters& counters() const override { return counters_; }

 private:
  using Clock = std::chrono::steady_clock;

  struct LcmDeleter {
    void operator()(_lcm_t* lcm) const;
  };

  std::optional<std::string> open_sockets(ReceiveSocket& ours, ReceiveSocket& foreign) const;
  void attach_filters();
  void look_after_network(Clock::time_point now);
  void count_foreign();
  void count_foreign(std::span<const std::uint8_t> datagram, const Sender& sender);
  void hand_over(const DatagramQueue::Entry& entry, const Receive& receive);
  void count_malformed(const Sender& sender, const std::string& what);

  const UdpTransportParams params_;
  Listening listening_;
  std::unique_ptr<_lcm_t, LcmDeleter> lcm_;  // Only sends, so it has no thread.
  ReceiveSocket socket_;
  ReceiveSocket foreign_socket_;
  DatagramQueue queue_;
  DatagramQueue foreign_queue_;
  FragmentAssembly assembly_;
  Clock::time_point network_due_;
  Clock::time_point foreign_due_;
  TransportCounters counters_;
};

}  // namespace puck
