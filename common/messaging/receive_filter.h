#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace puck {

/// The sockets of this process that UDP datagrams for `port` come to.
std::vector<int> udp_sockets_at(std::uint16_t port);

/// Lets only those datagrams through to a socket of LCM that hold a whole message on one of these
/// channels. A multicast reaches every process; one that has no use for it is not even woken up.
/// Takes the place of the socket's filter before. False when the system does not have it.
bool filter_channels(int socket, const std::vector<std::string>& channels);

/// Lets everything through again.
void remove_filter(int socket);

}  // namespace puck
