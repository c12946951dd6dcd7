#include "tools/doctor/wire_probe.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "common/messages/host_time.h"
#include "common/messaging/channels.h"
#include "common/messaging/datagram.h"
#include "common/messaging/ipv4.h"
#include "common/messaging/message_codec.h"
#include "common/messaging/session_id.h"
#include "tools/doctor/doctor_name.h"
#include "tools/doctor/udp_listener.h"

namespace puck {
namespace {

std::string own_host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? printable(name.data()) : "unknown";
}

/// Bound to a port only: an address would select the interface and bypass the route under test.
FileDescriptor sending_socket(const LcmUrl& url) {
  FileDescriptor sender(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_in any{};
  any.sin_family = AF_INET;
  if (!sender.is_open() ||
      bind(sender.number(), reinterpret_cast<const sockaddr*>(&any), sizeof any) != 0) {
    throw ListenError(std::string("no socket to send with (") + std::strerror(errno) + ")");
  }
  const auto hops = static_cast<unsigned char>(url.ttl);
  setsockopt(sender.number(), IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops);
  return sender;
}

int port_of(const FileDescriptor& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(socket.number(), reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

std::array<std::uint8_t, 8> bytes_of(std::int64_t number) {
  std::array<std::uint8_t, 8> bytes{};
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

}  // namespace

WireProbe::WireProbe(const WireProbeParams& params)
    : status_channel_(channel_name(Channel::kStatus, params.prefix)),
      // Under our prefix, but without subscribers.
      test_channel_(channel_beginning(params.prefix) + "DOCTOR"),
      session_(random_session()),
      group_(group_address(params.url)),
      socket_(sending_socket(params.url)),
      port_(port_of(socket_)),
      started_us_(host_monotonic_us()) {
  if (params.key_file.empty()) return;
  key_.emplace(params.key_file);
  sealer_.emplace(*key_);
}

void WireProbe::send_self_test() { send(test_channel_, bytes_of(session_)); }

bool WireProbe::is_self_test(std::span<const std::uint8_t> datagram) const {
  const Datagram parsed = parse_datagram(datagram);
  const auto* message = std::get_if<WholeMessage>(&parsed);
  return message != nullptr && message->channel == test_channel_ &&
         std::ranges::equal(message->payload, bytes_of(session_));
}

std::int64_t WireProbe::send_status(std::int8_t state) {
  service_status_t status{};
  status.utime = host_utime();
  status.session = session_;
  status.seq = next_status_seq_++;
  status.service = kDoctorName;
  status.host = own_host_name();
  status.pid = static_cast<std::int32_t>(getpid());
  status.version = PUCK_VERSION;
  status.state = state;
  status.uptime_us = host_monotonic_us() - started_us_;
  encode(status, payload_);
  if (sealer_) sealer_->seal(status_channel_, payload_);
  send(status_channel_, payload_);
  return status.utime;
}

void WireProbe::send(std::string_view channel, std::span<const std::uint8_t> payload) {
  datagram_.assign({'L', 'C', '0', '2'});
  for (int shift = 24; shift >= 0; shift -= 8) {
    datagram_.push_back(static_cast<std::uint8_t>(next_number_ >> shift));
  }
  ++next_number_;
  datagram_.insert(datagram_.end(), channel.begin(), channel.end());
  datagram_.push_back(0);
  datagram_.insert(datagram_.end(), payload.begin(), payload.end());
  sendto(socket_.number(), datagram_.data(), datagram_.size(), 0,
         reinterpret_cast<const sockaddr*>(&group_), sizeof group_);
}

}  // namespace puck
