#include "common/yarp/name_server.h"

#include <array>
#include <charconv>
#include <sstream>

#include <arpa/inet.h>

#include "common/yarp/yarp_error.h"

namespace puck {

PortAddress parse_registration(std::string_view line, std::string_view name) {
  std::array<std::string, 9> words;
  std::istringstream text{std::string(line)};
  for (std::string& word : words) text >> word;
  std::string further;
  const bool is_registration = text && !(text >> further) && words[0] == "registration" &&
                               words[1] == "name" && words[3] == "ip" && words[5] == "port" &&
                               words[7] == "type";
  if (!is_registration || words[2] != name) {
    throw YarpError("the name server answered " + in_quotes(line) + " to a query for " +
                    std::string(name));
  }
  if (words[8] != "tcp") {
    throw YarpError(std::string(name) + " is registered for " + in_quotes(words[8]) + ", not tcp");
  }
  PortAddress address{words[4]};
  in_addr dotted{};
  const std::string& port = words[6];
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (inet_pton(AF_INET, address.ip.c_str(), &dotted) != 1 || error != std::errc{} ||
      end != port.data() + port.size() || address.port == 0) {
    throw YarpError(std::string(name) + " is registered at " + in_quotes(words[4]) + " port " +
                    in_quotes(port) + ", which is not an address");
  }
  return address;
}

}  // namespace puck
