#include "common/messaging/udp_transport.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <variant>

#include <arpa/inet.h>
#include <lcm/lcm.h>
#include <poll.h>

#include "common/messages/host_time.h"
#include "common/messaging/datagram.h"
#include "common/messaging/ipv4.h"
#include "common/messaging/multicast_route.h"
#include "common/messaging/receive_filter.h"

namespace puck {
namespace {

using std::chrono::milliseconds;

// 32 MB: 0.8 s of EVENTS in 60 kB packets at 10 Mev/s.
constexpr std::size_t kQueuedDatagrams = 512;
constexpr int kForeignBufferBytes = 1 << 20;
constexpr std::size_t kForeignDatagrams = 32;
constexpr std::size_t kMostForeignKinds = 32;

// Longest time without reception after a network comes back.
constexpr milliseconds kNetworkPeriod{200};
constexpr milliseconds kForeignPeriod{10};
// Longest time that new datagrams wait in the socket during a call.
constexpr std::chrono::microseconds kFillPeriod{500};
// Largest channel name and message in one datagram.
constexpr std::size_t kLargestWhole = 65'499;

std::string describe_foreign(std::span<const std::uint8_t> bytes) {
  const Datagram datagram = parse_datagram(bytes);
  if (const auto* whole = std::get_if<WholeMessage>(&datagram)) {
    return "channel \"" + printable(whole->channel) + "\"";
  }
  if (std::holds_alternative<MessageFragment>(datagram)) {
    return "message fragments (refused: lcm.allow_fragments is false)";
  }
  const auto& bad = std::get<BadDatagram>(datagram);
  // Received datagrams are cut off here, perhaps within the channel name.
  return bad.has_magic ? "broken LCM datagrams" : "not LCM datagrams";
}

}  // namespace

std::string to_string(const Sender& sender) {
  if (sender.address == 0) return "this process";
  return dotted({htonl(sender.address)}) + ":" + std::to_string(sender.port);
}

void UdpTransport::LcmDeleter::operator()(lcm_t* lcm) const { lcm_destroy(lcm); }

UdpTransport::UdpTransport(const UdpTransportParams& params)
    : params_(params), queue_(kQueuedDatagrams), foreign_queue_(kForeignDatagrams) {}

UdpTransport::~UdpTransport() = default;

std::optional<std::string> UdpTransport::open() {
  if (auto problem = find_route_problem(params_.url)) return problem;
  lcm_.reset(lcm_create(params_.url.to_string().c_str()));
  if (!lcm_) return "LCM does not start on " + params_.url.to_string();
  if (auto problem = open_sockets(socket_, foreign_socket_)) return problem;
  attach_filters();
  network_due_ = Clock::now() + kNetworkPeriod;
  return std::nullopt;
}

std::optional<std::string> UdpTransport::open_sockets(ReceiveSocket& ours,
                                                      ReceiveSocket& foreign) const {
  if (auto problem = ours.open(params_.url, params_.url.recv_buf_size)) return problem;
  return foreign.open(params_.url, kForeignBufferBytes);
}

void UdpTransport::attach_filters() {
  if (!socket_.is_open()) return;
  const bool fragments = params_.allow_fragments;
  // If the kernel refuses a filter, reception works at a greater cost.
  if (listening_.all) {
    filter_beginning(socket_.descriptor(), listening_.beginning, fragments);
  } else {
    filter_channels(socket_.descriptor(), listening_.channels, fragments);
  }
  filter_foreign(foreign_socket_.descriptor(), listening_.beginning, fragments);
}

std::optional<std::string> UdpTransport::send(const std::string& channel,
                                              std::span<const std::uint8_t> payload) {
  if (!params_.allow_fragments && channel.size() + 1 + payload.size() > kLargestWhole) {
    return "is larger than a datagram, and lcm.allow_fragments is false";
  }
  const int status = lcm_publish(lcm_.get(), channel.c_str(), payload.data(),
                                 static_cast<unsigned>(payload.size()));
  if (status < 0) return std::strerror(errno);
  return std::nullopt;
}

void UdpTransport::listen(const Listening& listening) {
  listening_ = listening;
  attach_filters();
}

int UdpTransport::receive(std::chrono::microseconds timeout, std::chrono::microseconds longest,
                          const Receive& receive) {
  const auto begin = Clock::now();
  if (begin >= network_due_) look_after_network(begin);
  if (begin >= foreign_due_) count_foreign();
  if (queue_.is_empty()) {
    pollfd waiting{socket_.descriptor(), POLLIN, 0};
    const auto seconds = std::chrono::floor<std::chrono::seconds>(timeout);
    const timespec longest_wait{seconds.count(),
                                std::chrono::nanoseconds(timeout - seconds).count()};
    if (ppoll(&waiting, 1, &longest_wait, nullptr) <= 0) return 0;
    queue_.fill(socket_.descriptor());
  }
  int received = 0;
  auto filled = Clock::now();
  const auto end = filled + longest;
  while (!queue_.is_empty()) {
    hand_over(queue_.front(), receive);
    queue_.pop();
    ++received;
    const auto now = Clock::now();
    if (now >= end) break;
    if (queue_.is_empty() || now - filled < kFillPeriod) continue;
    queue_.fill(socket_.descriptor());
    filled = now;
  }
  return received;
}

void UdpTransport::look_after_network(Clock::time_point now) {
  network_due_ = now + kNetworkPeriod;
  if (!socket_.has_lost_its_group()) return;
  ReceiveSocket ours;
  ReceiveSocket foreign;
  // The old sockets stay until there is a network to join.
  if (open_sockets(ours, foreign)) return;
  // Datagrams left in the old socket are still handled.
  while (queue_.fill(socket_.descriptor()) > 0) continue;
  socket_ = std::move(ours);
  foreign_socket_ = std::move(foreign);
  attach_filters();
  ++counters_.rejoined;
}

void UdpTransport::count_foreign() {
  foreign_due_ = Clock::now() + kForeignPeriod;
  // Bounded in a flood: the kernel drops what its small buffer cannot hold.
  constexpr int kMostFills = 64;
  for (int i = 0; i < kMostFills; ++i) {
    if (foreign_queue_.fill(foreign_socket_.descriptor()) == 0) return;
    for (; !foreign_queue_.is_empty(); foreign_queue_.pop()) {
      const auto entry = foreign_queue_.front();
      count_foreign(entry.bytes, entry.sender);
    }
  }
}

void UdpTransport::count_foreign(std::span<const std::uint8_t> datagram, const Sender& sender) {
  ++counters_.foreign;
  const std::string what = describe_foreign(datagram);
  auto& kinds = counters_.foreign_traffic;
  const auto known = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const ForeignTraffic& kind) { return kind.what == what; });
  if (known != kinds.end()) {
    ++known->datagrams;
  } else if (kinds.size() < kMostForeignKinds) {
    kinds.push_back({what, sender, 1});
  }
}

void UdpTransport::hand_over(const DatagramQueue::Entry& entry, const Receive& receive) {
  // Converts the kernel's time stamp to the clock for ages. A step of the real-time clock meanwhile
  // must not change an age.
  constexpr std::int64_t kLongestQueue_us = 60'000'000;
  const std::int64_t utime = host_utime();
  std::int64_t queued_us = utime - entry.utime;
  if (entry.utime == 0 || queued_us < 0 || queued_us > kLongestQueue_us) queued_us = 0;
  ArrivedMessage message{{},
                         {},
                         entry.sender,
                         utime - queued_us,
                         host_monotonic_us() - queued_us,
                         queue_.has_second()};

  const Datagram datagram = parse_datagram(entry.bytes);
  if (const auto* whole = std::get_if<WholeMessage>(&datagram)) {
    message.channel = whole->channel;
    message.payload = whole->payload;
    receive(message);
  } else if (const auto* fragment = std::get_if<MessageFragment>(&datagram)) {
    if (!params_.allow_fragments) return count_foreign(entry.bytes, entry.sender);
    std::optional<std::string> problem;
    const auto assembled = assembly_.add(entry.sender, *fragment, problem);
    if (problem) return count_malformed(entry.sender, *problem);
    if (!assembled) return;
    message.channel = assembled->channel;
    message.payload = assembled->payload;
    receive(message);
  } else {
    count_malformed(entry.sender, std::string(std::get<BadDatagram>(datagram).why));
  }
}

void UdpTransport::count_malformed(const Sender& sender, const std::string& what) {
  ++counters_.malformed;
  counters_.last_malformed = "a datagram from " + to_string(sender) + " " + what;
}

}  // namespace puck
