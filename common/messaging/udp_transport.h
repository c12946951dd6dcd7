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
  bool allow_fragments = false;  ///< Take messages that came in several datagrams.
};

/// LCM's protocol over UDP multicast. liblcm sends; receiving is our own, since liblcm's receiver
/// trusts what it gets (two datagrams kill it), wakes a thread more for every message, loses the
/// newest when its queue is full, and stays deaf after its network was away.
///
/// Two sockets: one for what is ours, and a small one that wakes nobody and collects what is not,
/// so that strangers are counted without slowing anything down.
class UdpTransport : public Transport {
 public:
  explicit UdpTransport(const UdpTransportParams& params);
  ~UdpTransport() override;
  UdpTransport(const UdpTransport&) = delete;
  UdpTransport& operator=(const UdpTransport&) = delete;

  /// Joins the group. Nothing when it worked, else what there is to wait for.
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
