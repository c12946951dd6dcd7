#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace puck {

enum class EventFileKind : std::uint8_t { kRaw, kText, kYarpLog, kAedat4, kHdf5 };

/// Values of `from`, the format of a file that does not state it: `evt2`, `evt3`, `text`, `yarp`;
/// empty: unknown.
inline constexpr std::array<std::string_view, 5> kEventFormats{"", "evt2", "evt3", "text", "yarp"};

/// The kind of an event file that begins with `head`: from its header, else from the path's ending,
/// else from `from` (one of kEventFormats). Throws EventFileError for a kind that cannot be read,
/// and names the kind that it seems to be.
EventFileKind event_file_kind(const std::filesystem::path& path, std::string_view head,
                              std::string_view from);

}  // namespace puck
