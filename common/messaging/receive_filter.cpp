#include "common/messaging/receive_filter.h"

#include <cstddef>
#include <cstdint>

#include <linux/filter.h>
#include <sys/socket.h>

namespace puck {
namespace {

// A filter sees the UDP header, then LCM's: a magic word, a number, the channel name with its NUL.
constexpr std::uint32_t kUdpHeaderBytes = 8;
constexpr std::uint32_t kMagicAt = kUdpHeaderBytes;
constexpr std::uint32_t kChannelAt = kMagicAt + 8;
constexpr std::uint32_t kWholeMessage = 0x4c433032;  // "LC02"
constexpr std::uint32_t kFragment = 0x4c433033;      // "LC03"

constexpr std::uint32_t kDrop = 0;
constexpr std::uint32_t kKeepAll = 0xffffffff;
constexpr std::uint32_t kKeepSome = kUdpHeaderBytes + 255;

using Program = std::vector<sock_filter>;

sock_filter statement(int code, std::uint32_t value) {
  return {static_cast<std::uint16_t>(code), 0, 0, value};
}

sock_filter leave_with(std::uint32_t verdict) { return statement(BPF_RET | BPF_K, verdict); }

sock_filter jump(std::uint32_t value, std::size_t if_equal, std::size_t if_not) {
  return {static_cast<std::uint16_t>(BPF_JMP | BPF_JEQ | BPF_K),
          static_cast<std::uint8_t>(if_equal), static_cast<std::uint8_t>(if_not), value};
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

// Continues if the datagram is long enough for the loads that follow: a load beyond the end drops
// it.
void add_length_check(std::size_t channel_bytes, std::uint32_t otherwise, Program& program) {
  program.push_back(statement(BPF_LD | BPF_W | BPF_LEN, 0));
  program.push_back({static_cast<std::uint16_t>(BPF_JMP | BPF_JGE | BPF_K), 1, 0,
                     kChannelAt + static_cast<std::uint32_t>(channel_bytes)});
  program.push_back(leave_with(otherwise));
}

// Returns the verdict if the channel begins with these bytes; else continues.
void add_name(std::string_view bytes, std::uint32_t verdict, Program& program) {
  // Compares four bytes at once, then single bytes.
  std::size_t left = 2 * (bytes.size() / 4 + bytes.size() % 4) + 1;
  for (std::size_t at = 0; at < bytes.size();) {
    const bool is_word = bytes.size() - at >= 4;
    const std::size_t size = is_word ? 4 : 1;
    program.push_back(statement(BPF_LD | (is_word ? BPF_W : BPF_B) | BPF_ABS,
                                kChannelAt + static_cast<std::uint32_t>(at)));
    left -= 2;
    program.push_back(jump(big_endian(bytes.substr(at, size)), 0, left));
    at += size;
  }
  program.push_back(leave_with(verdict));
}

// Continues with whole messages; returns a verdict for fragments, and one for other datagrams.
void add_magic_check(std::uint32_t of_fragments, std::uint32_t otherwise, Program& program) {
  program.push_back(statement(BPF_LD | BPF_W | BPF_ABS, kMagicAt));
  program.push_back(jump(kWholeMessage, 3, 0));
  program.push_back(jump(kFragment, 0, 1));
  program.push_back(leave_with(of_fragments));
  program.push_back(leave_with(otherwise));
}

bool attach(int socket, Program& program) {
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) == 0;
}

}  // namespace

bool filter_channels(int socket, const std::vector<std::string>& channels, bool with_fragments) {
  Program program;
  add_magic_check(with_fragments ? kKeepAll : kDrop, kDrop, program);
  for (const std::string& channel : channels) {
    add_name({channel.c_str(), channel.size() + 1}, kKeepAll, program);
  }
  program.push_back(leave_with(kDrop));
  return attach(socket, program);
}

bool filter_beginning(int socket, std::string_view beginning, bool with_fragments) {
  Program program;
  add_magic_check(with_fragments ? kKeepAll : kDrop, kDrop, program);
  add_name(beginning, kKeepAll, program);
  program.push_back(leave_with(kDrop));
  return attach(socket, program);
}

bool filter_foreign(int socket, std::string_view beginning, bool with_fragments) {
  Program program;
  add_length_check(beginning.size(), kKeepSome, program);
  add_magic_check(with_fragments ? kDrop : kKeepSome, kKeepSome, program);
  add_name(beginning, kDrop, program);
  program.push_back(leave_with(kKeepSome));
  return attach(socket, program);
}

}  // namespace puck
