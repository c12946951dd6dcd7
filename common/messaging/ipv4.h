#pragma once

#include <string>

#include <netinet/in.h>

#include "common/messaging/lcm_url.h"

namespace puck {

/// `239.255.76.67`.
std::string dotted(const in_addr& address);

/// The group and port of a URL over UDP.
sockaddr_in group_address(const LcmUrl& url);

}  // namespace puck
