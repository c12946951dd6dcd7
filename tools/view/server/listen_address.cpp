#include "tools/view/server/listen_address.h"

#include <charconv>
#include <stdexcept>

#include <arpa/inet.h>

namespace puck {
namespace {

constexpr std::uint32_t kLoopbackNet = 127;

bool is_ipv4(const std::string& text, in_addr& address) {
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}
bool is_ipv6(const std::string& text, in6_addr& address) {
  return inet_pton(AF_INET6, text.c_str(), &address) == 1;
}

[[noreturn]] void refuse(const std::string& text) {
  throw std::invalid_argument("--listen " + text +
                              ": expected ADDRESS:PORT, such as 127.0.0.1:8080 for this machine, "
                              "0.0.0.0:8080 for all, or [::1]:8080");
}

}  // namespace

bool ListenAddress::is_loopback() const {
  in_addr v4{};
  if (is_ipv4(address, v4)) return ntohl(v4.s_addr) >> 24 == kLoopbackNet;
  in6_addr v6{};
  return is_ipv6(address, v6) && IN6_IS_ADDR_LOOPBACK(&v6) != 0;
}

ListenAddress parse_listen_address(const std::string& text) {
  ListenAddress parsed;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos) {
    parsed.address = text.substr(0, colon);
    in_addr v4{};
    in6_addr v6{};
    const bool bracketed = parsed.address.starts_with('[') && parsed.address.ends_with(']');
    if (bracketed) parsed.address = parsed.address.substr(1, parsed.address.size() - 2);
    if (parsed.address == "localhost") parsed.address = "127.0.0.1";
    if (bracketed ? !is_ipv6(parsed.address, v6) : !is_ipv4(parsed.address, v4)) refuse(text);
  }
  const char* begin = text.data() + (colon == std::string::npos ? 0 : colon + 1);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, parsed.port);
  if (error != std::errc{} || rest != end) refuse(text);
  return parsed;
}

std::string to_string(const ListenAddress& address) {
  const bool v6 = address.address.find(':') != std::string::npos;
  return (v6 ? '[' + address.address + ']' : address.address) + ':' + std::to_string(address.port);
}

}  // namespace puck
