#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace puck {

enum class EventFileKind : std::uint8_t { kRaw, kText, kYarpLog };

/// What `from` may be, to say how a file is to be read that does not say so itself: `evt2`, `evt3`,
/// `text`, `yarp`; empty where nothing is said.
inline constexpr std::array<std::string_view, 5> kEventFormats{"", "evt2", "evt3", "text", "yarp"};

/// What kind of event file begins with `head`: told from that, else from the path's ending, else
/// from `from` (one of kEventFormats). Throws EventFileError for a kind that cannot be read, with
/// what it seems to be.
EventFileKind event_file_kind(const std::filesystem::path& path, std::string_view head,
                              std::string_view from);

}  // namespace puck
