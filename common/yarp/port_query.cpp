#include "common/yarp/port_query.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <stdexcept>

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>

#include "common/yarp/yarp_error.h"

namespace puck {

std::vector<PortAddress> name_server_addresses(const std::string& host, int port,
                                               const std::string& key) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(host.c_str(), nullptr, &hints, &found);
  if (error != 0) {
    throw std::invalid_argument(key + " \"" + host + "\" cannot be found: " + gai_strerror(error));
  }
  std::vector<PortAddress> addresses;
  for (const addrinfo* each = found; each != nullptr; each = each->ai_next) {
    std::array<char, INET_ADDRSTRLEN> dotted{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(each->ai_addr);
    inet_ntop(AF_INET, &address->sin_addr, dotted.data(), dotted.size());
    addresses.push_back({dotted.data(), static_cast<std::uint16_t>(port)});
  }
  freeaddrinfo(found);
  return addresses;
}

PortAddress find_port(TextConnection& name_server, const std::string& name, const Waiter& waiter,
                      Deadline deadline) {
  // Other versions may add lines to an answer.
  constexpr int kMostLines = 8;
  name_server.send("query " + name, waiter, deadline);
  std::optional<PortAddress> address;
  for (int i = 0; i < kMostLines; ++i) {
    const std::string line = name_server.receive(waiter, deadline);
    if (line == kEndOfAnswer) {
      if (!address) throw YarpError("there is no port " + name + ": is the robot running?");
      return *address;
    }
    if (!address) address = parse_registration(line, name);
  }
  throw YarpError("its answer to a query for " + name + " has no end");
}

bool is_port_name(const std::string& text) {
  constexpr std::size_t kLongest = 64;
  const auto is_fine = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.' || c == '/' || c == ':';
  };
  return !text.empty() && text.size() <= kLongest && std::all_of(text.begin(), text.end(), is_fine);
}

}  // namespace puck
