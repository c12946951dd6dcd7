#include "common/messaging/receive_filter.h"

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include <arpa/inet.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace puck {
namespace {

// A filter sees the UDP header first, then LCM's: a magic word, a number, the channel with its
// final zero.
constexpr std::uint32_t kMagicAt = 8;
constexpr std::uint32_t kChannelAt = kMagicAt + 8;
constexpr std::uint32_t kWholeMessage = 0x4c433032;  // "LC02"
constexpr std::uint32_t kDrop = 0;
constexpr std::uint32_t kKeepAll = 0xffffffff;

sock_filter statement(int code, std::uint32_t value) {
  return {static_cast<std::uint16_t>(code), 0, 0, value};
}

sock_filter jump_unless_equal(std::uint32_t value, std::size_t instructions) {
  return {static_cast<std::uint16_t>(BPF_JMP | BPF_JEQ | BPF_K), 0,
          static_cast<std::uint8_t>(instructions), value};
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

// Keeps the datagram when its channel has this name; else goes on behind this.
void add_channel(const std::string& name, std::vector<sock_filter>& program) {
  const std::string_view bytes(name.c_str(), name.size() + 1);
  // Four at once, then one by one.
  std::size_t left = 2 * (bytes.size() / 4 + bytes.size() % 4) + 1;
  for (std::size_t at = 0; at < bytes.size();) {
    const bool is_word = bytes.size() - at >= 4;
    const std::size_t size = is_word ? 4 : 1;
    program.push_back(statement(BPF_LD | (is_word ? BPF_W : BPF_B) | BPF_ABS,
                                kChannelAt + static_cast<std::uint32_t>(at)));
    left -= 2;
    program.push_back(jump_unless_equal(big_endian(bytes.substr(at, size)), left));
    at += size;
  }
  program.push_back(statement(BPF_RET | BPF_K, kKeepAll));
}

bool is_udp_at(int socket, std::uint16_t port) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) {
    return false;
  }
  sockaddr_in address{};
  size = sizeof address;
  return getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
         address.sin_family == AF_INET && ntohs(address.sin_port) == port;
}

}  // namespace

std::vector<int> udp_sockets_at(std::uint16_t port) {
  std::vector<int> sockets;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const int descriptor = std::atoi(entry.path().filename().c_str());
    if (is_udp_at(descriptor, port)) sockets.push_back(descriptor);
  }
  return sockets;
}

bool filter_channels(int socket, const std::vector<std::string>& channels) {
  std::vector<sock_filter> program{statement(BPF_LD | BPF_W | BPF_ABS, kMagicAt),
                                   {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, kWholeMessage},
                                   statement(BPF_RET | BPF_K, kDrop)};
  for (const std::string& channel : channels) add_channel(channel, program);
  program.push_back(statement(BPF_RET | BPF_K, kDrop));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
}

void remove_filter(int socket) {
  const int unused = 0;
  setsockopt(socket, SOL_SOCKET, SO_DETACH_FILTER, &unused, sizeof unused);
}

}  // namespace puck
