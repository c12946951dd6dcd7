#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace puck {

enum class EventFileKind : std::uint8_t {
  kRaw,
  kDat,
  kEventStream,
  kAedat2,
  kAedat4,
  kHdf5,
  kText,
  kYarpLog,
};

/// As in messages: "a Prophesee DAT file".
const char* name_of(EventFileKind kind);

/// Values of `from`, the format of a file whose content does not tell it; empty: unknown.
inline constexpr std::array<std::string_view, 7> kEventFormats{"",     "evt2", "evt21", "evt3",
                                                               "evt4", "text", "yarp"};

/// The kind of a file or stream called `name` that begins with `head`: by its content; where that
/// cannot tell, by `from` (one of kEventFormats). `is_all`: no more bytes come, or as many as a
/// caller wants to wait for; else `std::nullopt` while more are needed. Throws EventFileError for a
/// kind that cannot be read, and names the kind that it seems to be.
std::optional<EventFileKind> event_file_kind(const std::string& name, std::string_view head,
                                             bool is_all, std::string_view from);

}  // namespace puck
