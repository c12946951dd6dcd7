#include "common/messaging/ipv4.h"

#include <array>
#include <cstdint>

#include <arpa/inet.h>

namespace puck {

std::string dotted(const in_addr& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &address, text.data(), text.size());
  return text.data();
}

sockaddr_in group_address(const LcmUrl& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(url.port));
  inet_pton(AF_INET, url.group.c_str(), &address.sin_addr);
  return address;
}

}  // namespace puck
