#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace puck {

// Filters in the kernel that keep a datagram of LCM away from a socket before it costs a wake-up.
// Each replaces the one before it, and lets nothing through that is not named here. False, and the
// socket as it was, when the kernel refuses.

/// Messages in one datagram on these channels, by their full name.
bool filter_channels(int socket, const std::vector<std::string>& channels, bool with_fragments);

/// Messages in one datagram on channels whose name begins so: LEFT_PUCK_.
bool filter_beginning(int socket, std::string_view beginning, bool with_fragments);

/// Whatever the other two would never let through, cut off after 255 bytes.
bool filter_foreign(int socket, std::string_view beginning, bool with_fragments);

}  // namespace puck
