#pragma once

#include <string>
#include <vector>

#include "common/yarp/name_server.h"
#include "common/yarp/text_connection.h"
#include "common/yarp/waiter.h"

namespace puck {

/// All addresses of a name server, to be tried in turn. Call it only at the start: it can neither
/// be interrupted nor have a timeout. Throws std::invalid_argument that begins with `key` when the
/// host is unknown.
std::vector<PortAddress> name_server_addresses(const std::string& host, int port,
                                               const std::string& key);

/// Queries the name server for the port `name`. Throws YarpError.
PortAddress find_port(TextConnection& name_server, const std::string& name, const Waiter& waiter,
                      Deadline deadline);

/// Whether `text` can stand as a name in the name server's lines: letters, digits and any of
/// `_-.:/`, up to 64.
bool is_port_name(const std::string& text);

}  // namespace puck
