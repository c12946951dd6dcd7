#pragma once

#include <chrono>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/lcm_url.h"

namespace puck {

using Bytes = std::vector<std::uint8_t>;

/// Sends arbitrary datagrams to the group of a bus, at a limited rate. One thread.
class RawSender {
 public:
  /// Throws std::runtime_error without a socket, std::invalid_argument for a bus in memory.
  RawSender(const LcmUrl& url, std::string prefix, int datagrams_per_s, std::uint64_t seed);
  ~RawSender();
  RawSender(const RawSender&) = delete;
  RawSender& operator=(const RawSender&) = delete;

  /// Waits until it is due.
  void send(std::span<const std::uint8_t> datagram);
  /// As LCM sends a message that fits one datagram.
  void send_message(std::string_view channel, std::span<const std::uint8_t> payload);
  void send_message(Channel channel, std::span<const std::uint8_t> payload);

  std::string name_of(Channel channel) const { return channel_name(channel, prefix_); }
  const std::string& prefix() const { return prefix_; }
  std::uint64_t seed() const { return seed_; }
  std::mt19937_64& random() { return random_; }
  std::size_t random_below(std::size_t limit) { return random_() % limit; }
  Bytes random_bytes(std::size_t size);

  std::int64_t datagrams() const { return datagrams_; }
  std::int64_t bytes() const { return bytes_; }

 private:
  using Clock = std::chrono::steady_clock;

  int socket_ = -1;
  const std::string prefix_;
  const Clock::duration interval_;
  const std::uint64_t seed_;
  Clock::time_point due_;
  std::mt19937_64 random_;
  std::uint32_t number_ = 0;
  std::int64_t datagrams_ = 0;
  std::int64_t bytes_ = 0;
};

/// Beginning of an LCM message in one datagram, and in several.
Bytes whole_header(std::uint32_t number);
struct FragmentHeader {
  std::uint32_t number = 0;
  std::uint32_t message_size = 0;
  std::uint32_t offset = 0;
  std::uint16_t index = 0;
  std::uint16_t fragments = 0;
};
Bytes fragment_header(const FragmentHeader& header);

void append(Bytes& bytes, std::string_view text);
void append(Bytes& bytes, std::span<const std::uint8_t> more);

}  // namespace puck
