#include "tests/intruder/raw_sender.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace puck {
namespace {

void append_number(Bytes& bytes, std::uint32_t value, int size) {
  for (int i = size - 1; i >= 0; --i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

}  // namespace

RawSender::RawSender(const LcmUrl& url, std::string prefix, int datagrams_per_s, std::uint64_t seed)
    : prefix_(std::move(prefix)),
      interval_(std::chrono::duration_cast<Clock::duration>(std::chrono::seconds(1)) /
                datagrams_per_s),
      seed_(seed),
      due_(Clock::now()),
      random_(seed) {
  if (url.in_memory) throw std::invalid_argument("there is nobody on memq:// but oneself");
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(url.port));
  inet_pton(AF_INET, url.group.c_str(), &to.sin_addr);
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto ttl = static_cast<std::uint8_t>(url.ttl);
  if (socket_ < 0 || setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl) != 0 ||
      connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
    const std::string why = std::strerror(errno);
    if (socket_ >= 0) close(socket_);
    throw std::runtime_error("no way to " + url.to_string() + ": " + why);
  }
}

RawSender::~RawSender() { close(socket_); }

void RawSender::send(std::span<const std::uint8_t> datagram) {
  std::this_thread::sleep_until(due_);
  // Datagrams missed in a pause of this process are not sent later.
  due_ = std::max(due_ + interval_, Clock::now() - std::chrono::milliseconds(10));
  if (::send(socket_, datagram.data(), datagram.size(), 0) < 0) return;
  ++datagrams_;
  bytes_ += static_cast<std::int64_t>(datagram.size());
}

void RawSender::send_message(std::string_view channel, std::span<const std::uint8_t> payload) {
  Bytes datagram = whole_header(number_++);
  append(datagram, channel);
  datagram.push_back(0);
  append(datagram, payload);
  send(datagram);
}

void RawSender::send_message(Channel channel, std::span<const std::uint8_t> payload) {
  send_message(name_of(channel), payload);
}

Bytes RawSender::random_bytes(std::size_t size) {
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random_());
  return bytes;
}

Bytes whole_header(std::uint32_t number) {
  Bytes bytes;
  append(bytes, "LC02");
  append_number(bytes, number, 4);
  return bytes;
}

Bytes fragment_header(const FragmentHeader& header) {
  Bytes bytes;
  append(bytes, "LC03");
  append_number(bytes, header.number, 4);
  append_number(bytes, header.message_size, 4);
  append_number(bytes, header.offset, 4);
  append_number(bytes, header.index, 2);
  append_number(bytes, header.fragments, 2);
  return bytes;
}

void append(Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void append(Bytes& bytes, std::span<const std::uint8_t> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace puck
