#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "tools/doctor/facts.h"

namespace puck {

/// Programs with these sockets, by inode; only those that this user may see.
std::map<std::uint64_t, Program> find_programs(const std::set<std::uint64_t>& socket_inodes);

}  // namespace puck
