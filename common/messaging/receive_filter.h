#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace puck {

// Kernel filters that drop LCM datagrams before they wake the receiver. Each replaces the previous
// filter and passes only what its comment names. They return false, with the socket unchanged, if
// the kernel refuses.

/// Unfragmented messages on these channels (full names).
bool filter_channels(int socket, const std::vector<std::string>& channels, bool with_fragments);

/// Unfragmented messages on channels with this beginning: LEFT_PUCK_.
bool filter_beginning(int socket, std::string_view beginning, bool with_fragments);

/// All datagrams that the other two never pass, cut off after 255 bytes.
bool filter_foreign(int socket, std::string_view beginning, bool with_fragments);

}  // namespace puck
