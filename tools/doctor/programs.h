#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "tools/doctor/facts.h"

namespace puck {

/// The programs that hold these sockets open, by the sockets' inodes, as far as this user may see.
std::map<std::uint64_t, Program> find_programs(const std::set<std::uint64_t>& socket_inodes);

}  // namespace puck
