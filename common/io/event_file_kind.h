#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace puck {

enum class EventFileKind { kRaw, kText };

/// What kind of event file begins with `head`: told from that, else from the path's ending, else
/// from `from` ("evt2", "evt3", "text" or empty). Throws EventFileError for a kind that cannot be
/// read, with what it seems to be.
EventFileKind event_file_kind(const std::filesystem::path& path, std::string_view head,
                              std::string_view from);

}  // namespace puck
